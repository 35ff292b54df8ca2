// SPDX-License-Identifier: BSD-3-Clause
#include "module.hpp"

#include <lego_loam_sc/core/error.hpp>

namespace lego_loam_sc::python {

// In the order in which they need each other: a default argument must know its type.
NB_MODULE(_core, module) {
  module.doc() =
      "LeGO-LOAM-SC: LiDAR-only SLAM. Lengths in m, angles in rad, times in s; poses are "
      "4 x 4 matrices, T_a_b maps coordinates in b to coordinates in a.";
  nb::exception<InputError>(module, "InputError", PyExc_ValueError);
  bind_sensor(module);
  bind_settings(module);
  bind_scans(module);
  bind_loops(module);
  bind_slam(module);
}

}  // namespace lego_loam_sc::python
