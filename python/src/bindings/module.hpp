// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nanobind/nanobind.h>

namespace lego_loam_sc::python {

namespace nb = nanobind;

void bind_sensor(nb::module_& module);
void bind_settings(nb::module_& module);
void bind_scans(nb::module_& module);
void bind_loops(nb::module_& module);
void bind_slam(nb::module_& module);

}  // namespace lego_loam_sc::python
