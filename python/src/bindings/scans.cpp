// SPDX-License-Identifier: BSD-3-Clause
#include "scans.hpp"

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/unique_ptr.h>

#include <cmath>
#include <lego_loam_sc/io/scan_source.hpp>
#include <lego_loam_sc/io/sensor_presets.hpp>
#include <limits>
#include <stdexcept>
#include <string>

#include "module.hpp"

namespace lego_loam_sc::python {
namespace {

using namespace nb::literals;

// One entry for each point, converted one by one; nothing when there is no array.
template <class Number, class From, class Convert>
std::vector<Number> column(const std::optional<Numbers<From>>& array, std::size_t count,
                           const char* name, Convert convert) {
  std::vector<Number> numbers;
  if (!array) return numbers;
  if (array->shape(0) != count)
    throw std::invalid_argument(std::string(name) + " has " + std::to_string(array->shape(0)) +
                                " entries for " + std::to_string(count) + " points");
  numbers.reserve(count);
  const auto view = array->template view<nb::ndim<1>>();
  for (std::size_t i = 0; i < count; ++i) numbers.push_back(convert(view(i)));
  return numbers;
}

std::int64_t to_stamp(double seconds) {
  if (!(std::abs(seconds) < 9e9))
    throw std::invalid_argument("stamp must be a number of seconds, it is " +
                                std::to_string(seconds));
  return nanoseconds(seconds);
}

std::int32_t to_offset(double seconds) {
  if (std::isnan(seconds)) return 0;  // a point without return
  if (!(std::abs(seconds) <= 2.0))
    throw std::invalid_argument(
        "offsets must be seconds after the stamp, between -2 and 2, one is " +
        std::to_string(seconds));
  return static_cast<std::int32_t>(nanoseconds(seconds));
}

std::uint16_t to_ring(std::int64_t ring) {
  if (ring < 0 || ring > std::numeric_limits<std::uint16_t>::max())
    throw std::invalid_argument("rings must be between 0 and 65535, one is " +
                                std::to_string(ring));
  return static_cast<std::uint16_t>(ring);
}

// An array that a scan may lack.
template <class Number>
std::optional<View<Number, -1>> optional_view(const std::vector<Number>& numbers) {
  if (numbers.empty()) return std::nullopt;
  return View<Number, -1>(numbers.data(), {numbers.size()});
}

}  // namespace

std::vector<Eigen::Vector3f> to_points(const Points& points) {
  const auto view = points.view<nb::ndim<2>>();
  std::vector<Eigen::Vector3f> result;
  result.reserve(points.shape(0));
  for (std::size_t i = 0; i < points.shape(0); ++i)
    result.emplace_back(view(i, 0), view(i, 1), view(i, 2));
  return result;
}

Scan make_scan(const Points& points, double stamp, const std::optional<Numbers<double>>& offsets,
               const std::optional<Numbers<std::int64_t>>& rings,
               const std::optional<Numbers<float>>& intensity) {
  Scan scan;
  scan.stamp_ns = to_stamp(stamp);
  scan.points = to_points(points);
  scan.offset_ns = column<std::int32_t>(offsets, scan.size(), "offsets", to_offset);
  scan.ring = column<std::uint16_t>(rings, scan.size(), "rings", to_ring);
  scan.intensity =
      column<float>(intensity, scan.size(), "intensity", [](float value) { return value; });
  return scan;
}

void bind_scans(nb::module_& module) {
  nb::class_<Scan>(
      module, "Scan",
      "One sweep: points (n, 3) in m in the LiDAR frame, x forward, y left, z up; NaN\n"
      "and zeros mean no return. stamp in s; offsets in s after it, rings in the\n"
      "sensor's numbering and intensity are optional, one for each point.")
      .def(
          "__init__",
          [](Scan* scan, const Points& points, double stamp,
             const std::optional<Numbers<double>>& offsets,
             const std::optional<Numbers<std::int64_t>>& rings,
             const std::optional<Numbers<float>>& intensity) {
            new (scan) Scan(make_scan(points, stamp, offsets, rings, intensity));
          },
          nb::sig("def __init__(self, points: numpy.typing.NDArray[numpy.number], *, stamp: float "
                  "= 0.0, "
                  "offsets: numpy.typing.NDArray[numpy.number] | None = None, "
                  "rings: numpy.typing.NDArray[numpy.number] | None = None, "
                  "intensity: numpy.typing.NDArray[numpy.number] | None = None) -> None"),
          "points"_a, nb::kw_only(), "stamp"_a = 0.0, "offsets"_a = nb::none(),
          "rings"_a = nb::none(), "intensity"_a = nb::none())
      .def("__len__", &Scan::size)
      .def_prop_ro("stamp", [](const Scan& scan) { return seconds(scan.stamp_ns); })
      .def_prop_ro(
          "points",
          [](const Scan& scan) { return View<float, -1, 3>(scan.points.data(), {scan.size(), 3}); })
      .def_prop_ro("intensity", [](const Scan& scan) { return optional_view(scan.intensity); })
      .def_prop_ro("rings", [](const Scan& scan) { return optional_view(scan.ring); })
      .def_prop_ro(
          "offsets",
          [](const Scan& scan) {
            std::vector<double> offsets;
            for (const std::int32_t offset_ns : scan.offset_ns)
              offsets.push_back(seconds(offset_ns));
            return offsets.empty() ? nb::object(nb::none())
                                   : nb::cast(to_numpy<double>(std::move(offsets)));
          },
          nb::sig("def offsets(self) -> numpy.typing.NDArray[numpy.float64] | None"));

  nb::class_<DatasetFacts>(module, "DatasetFacts", "What is known of scans besides the scans.")
      .def(nb::init<>());
  nb::class_<ScanSource>(module, "ScanSource", "Scans one after another: for scan in source.")
      .def_prop_ro("facts", &ScanSource::facts)
      .def_prop_ro("notes",
                   [](const ScanSource& source) {
                     nb::list notes;
                     for (const std::string& note : source.notes()) notes.append(note);
                     return notes;
                   })
      .def(
          "__iter__", [](nb::handle self) { return self; },
          nb::sig("def __iter__(self) -> ScanSource"))
      .def("__next__", [](ScanSource& source) {
        std::optional<Scan> scan;
        {
          nb::gil_scoped_release unlocked;
          scan = source.next();
        }
        if (!scan) throw nb::stop_iteration();
        return std::move(*scan);
      });
  module.def("open_scans", &open_scans, "path"_a,
             "A KITTI sequence folder, a folder of .bin, .pcd or .ply scans, one such scan, or a\n"
             "scan stream. Raises InputError that says what to do when it is none of these.");
  module.def("recognise_sensor", &recognise_sensor, "scan"_a, "facts"_a = DatasetFacts{},
             "The sensor that made a scan. Raises InputError when none of the presets fits.");
}

}  // namespace lego_loam_sc::python
