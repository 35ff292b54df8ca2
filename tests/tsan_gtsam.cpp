// SPDX-License-Identifier: BSD-3-Clause
// Part of the tests under ThreadSanitizer, of no others. GTSAM linearises the factors of a graph on
// the threads of TBB, and neither library is instrumented: what was done to a factor before seems
// to have no order with what TBB's threads do with it. So these two functions, found before GTSAM's
// own, tell the order that TBB keeps: all that came before a graph is linearised, its factors in no
// order among themselves, all that comes after.
#include <dlfcn.h>
#include <gtsam/linear/GaussianFactorGraph.h>
#include <gtsam/nonlinear/NonlinearFactor.h>
#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <sanitizer/tsan_interface.h>

namespace gtsam {
namespace {

// Their addresses stand for the two moments.
char before_the_factors;
char after_the_factors;

// A member function of libgtsam as a plain function, by its mangled name.
template <class Result, class Class>
auto gtsams_own(const char* name) {
  return reinterpret_cast<Result (*)(const Class*, const Values&)>(dlsym(RTLD_NEXT, name));
}

const auto linearize_graph =
    gtsams_own<boost::shared_ptr<GaussianFactorGraph>, NonlinearFactorGraph>(
        "_ZNK5gtsam20NonlinearFactorGraph9linearizeERKNS_6ValuesE");
const auto linearize_factor = gtsams_own<boost::shared_ptr<GaussianFactor>, NoiseModelFactor>(
    "_ZNK5gtsam16NoiseModelFactor9linearizeERKNS_6ValuesE");

}  // namespace

boost::shared_ptr<GaussianFactorGraph> NonlinearFactorGraph::linearize(const Values& point) const {
  __tsan_release(&before_the_factors);
  auto result = linearize_graph(this, point);
  __tsan_acquire(&after_the_factors);
  return result;
}

boost::shared_ptr<GaussianFactor> NoiseModelFactor::linearize(const Values& point) const {
  __tsan_acquire(&before_the_factors);
  auto result = linearize_factor(this, point);
  __tsan_release(&after_the_factors);
  return result;
}

}  // namespace gtsam
