// SPDX-License-Identifier: BSD-3-Clause
#include "loop/search_pacing.hpp"

#include <algorithm>
#include <cmath>

#include "loop/redundancy.hpp"

namespace lego_loam_sc {
namespace {

// Each redundant loop doubles the search spacing, up to this, m, and up to as much again for every
// kWellTied loops that end near, at most so many times.
constexpr double kLongestSpacing = 0.3 * kSameVisit;
constexpr double kMostShares = 3.0;

}  // namespace

void SearchPacing::on_added(double travelled) {
  pause(travelled, spacing_);
}

void SearchPacing::on_redundant(double travelled, double loops_near) {
  pause(travelled, next_search_spacing(loops_near));
}

double SearchPacing::next_search_spacing(double loops_near) const {
  const double shares = std::min(std::floor(loops_near / kWellTied), kMostShares);
  const double longest = (1.0 + shares) * kLongestSpacing;
  return std::max(spacing_, std::min(2.0 * search_spacing_, longest));
}

void SearchPacing::pause(double travelled, double metres) {
  last_loop_ = travelled;
  search_spacing_ = metres;
  next_search_ = travelled + metres;
}

}  // namespace lego_loam_sc
