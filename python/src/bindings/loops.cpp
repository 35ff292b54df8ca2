// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/eigen/dense.h>

#include <lego_loam_sc/loop/scan_context.hpp>
#include <lego_loam_sc/slam/match_scans.hpp>

#include "module.hpp"
#include "scans.hpp"

namespace lego_loam_sc::python {
namespace {

using namespace nb::literals;

void bind_scan_context(nb::module_& module) {
  nb::class_<ScanContextMatch>(module, "ScanContextMatch", "Equations (5) and (6).")
      .def_ro("distance", &ScanContextMatch::distance, "D, in [0, 1]")
      .def_ro("shift", &ScanContextMatch::shift, "n*, columns")
      .def_ro("yaw", &ScanContextMatch::yaw, "rad, T_candidate_query turns by R_z(yaw)");

  nb::class_<ScanContext>(module, "ScanContext",
                          "A place seen from above in polar bins: equations (2), (3) and (7).\n"
                          "points (n, 3) in the LiDAR frame, z up; sensor_height above the ground.")
      .def(
          "__init__",
          [](ScanContext* context, const Points& points, double sensor_height,
             const ScanContextSettings& settings) {
            new (context)
                ScanContext(make_scan_context(to_points(points), sensor_height, settings));
          },
          nb::sig("def __init__(self, points: numpy.typing.NDArray[numpy.number], "
                  "sensor_height: float = 0.0, settings: ScanContextSettings = ...) -> None"),
          "points"_a, "sensor_height"_a = 0.0, "settings"_a = ScanContextSettings{})
      .def_ro("rings", &ScanContext::rings)
      .def_ro("sectors", &ScanContext::sectors)
      .def_prop_ro(
          "columns",
          [](const ScanContext& context) {
            return View<float, -1, -1>(context.columns.data(),
                                       {static_cast<std::size_t>(context.sectors),
                                        static_cast<std::size_t>(context.rings)});
          },
          "(sectors, rings): each column of heights divided by its length")
      .def_prop_ro(
          "ring_key",
          [](const ScanContext& context) {
            return View<float, -1>(context.ring_key.data(), {context.ring_key.size()});
          },
          "(rings,): K of equation (7)")
      .def(
          "compare",
          [](const ScanContext& query, const ScanContext& candidate) {
            if (query.rings != candidate.rings || query.sectors != candidate.sectors)
              throw std::invalid_argument(
                  "the two scan contexts differ in rings or sectors; make both with the same "
                  "settings");
            return compare(query, candidate);
          },
          "candidate"_a, "Compares at all shifts.");
}

void bind_match(nb::module_& module) {
  nb::enum_<Verdict> verdict(module, "Verdict", "Why a loop candidate was accepted or refused.");
  for (int k = 0; k <= static_cast<int>(Verdict::contradicted); ++k) {
    const auto value = static_cast<Verdict>(k);
    verdict.value(to_string(value).data(), value);
  }
  nb::class_<LoopVerification>(module, "LoopVerification", "Paper 2.3 (6).")
      .def_ro("verdict", &LoopVerification::verdict)
      .def_prop_ro("accepted",
                   [](const LoopVerification& v) { return v.verdict == Verdict::accepted; })
      .def_prop_ro("T_match_query",
                   [](const LoopVerification& v) { return v.T_match_query.matrix(); })
      .def_ro("overlap", &LoopVerification::overlap, "share of the query's points on the local map")
      .def_ro("rmse", &LoopVerification::rmse, "m, ICP score: residual of the inliers")
      .def_ro("covariance", &LoopVerification::covariance,
              "of translation (m), then rotation (rad), in the axes of the match");
  nb::class_<ScanMatch>(module, "ScanMatch", "Two scans compared as a loop candidate.")
      .def_ro("scan_context", &ScanMatch::scan_context)
      .def_ro("verification", &ScanMatch::verification, "T_match_query maps points of b into a");
  module.def("match", &match_scans, "a"_a, "b"_a, "sensor"_a, "settings"_a = Settings{},
             nb::call_guard<nb::gil_scoped_release>(),
             "Treats scan b as the query and scan a as the match. Points are not de-skewed.");
}

}  // namespace

void bind_loops(nb::module_& module) {
  bind_scan_context(module);
  bind_match(module);
}

}  // namespace lego_loam_sc::python
