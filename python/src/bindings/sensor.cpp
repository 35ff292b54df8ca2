// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <lego_loam_sc/io/sensor_yaml.hpp>

#include "module.hpp"

namespace lego_loam_sc::python {

using namespace nb::literals;

void bind_sensor(nb::module_& module) {
  using S = SensorModel;
  nb::class_<S>(
      module, "SensorModel",
      "The facts of one spinning LiDAR and its mounting. load_sensor(\"vlp16\") gives a preset.")
      .def(nb::init<>())
      .def_rw("name", &S::name)
      .def_rw("elevation_deg", &S::elevation_deg, "one per row, ascending; assign a whole list")
      .def_rw("columns", &S::columns, "columns of the range image over 360 degrees")
      .def_rw("min_range", &S::min_range, "m")
      .def_rw("max_range", &S::max_range, "m")
      .def_rw("range_noise", &S::range_noise, "m, one sigma")
      .def_rw("period", &S::period, "s for one turn")
      .def_rw("start_azimuth_deg", &S::start_azimuth_deg,
              "azimuth (counter-clockwise from x) where a sweep starts")
      .def_rw("clockwise", &S::clockwise, "seen from above")
      .def_rw("motion_compensated", &S::motion_compensated,
              "points are already moved to the stamp of their scan")
      .def_rw("times_from_azimuth", &S::times_from_azimuth,
              "raw sweeps without times: a point's azimuth tells its time")
      .def_rw("elevation_correction_deg", &S::elevation_correction_deg,
              "added to the elevation angle of every point")
      .def_rw("height", &S::height, "m above the ground, 0 = unknown, then estimated")
      .def_rw("mount_roll_deg", &S::mount_roll_deg)
      .def_rw("mount_pitch_deg", &S::mount_pitch_deg)
      .def("__str__", [](const S& sensor) { return to_yaml(sensor); });
  module.def("load_sensor", &load_sensor, "name_or_file"_a,
             "A preset (vlp16, rs16, hdl32e, hdl64e, kitti, ...) or a YAML file of the same form.");
}

}  // namespace lego_loam_sc::python
