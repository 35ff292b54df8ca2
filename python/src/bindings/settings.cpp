// SPDX-License-Identifier: BSD-3-Clause
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <lego_loam_sc/io/settings_yaml.hpp>

#include "module.hpp"

namespace lego_loam_sc::python {
namespace {

using namespace nb::literals;

// Adds an attribute for each setting that the group declares itself, so that new ones follow.
template <class Group>
class FieldBinder {
 public:
  FieldBinder(nb::class_<Group>& type, const Group& example) : type_(type), example_(example) {}

  // After the value come the limits of a number, and last the comment.
  template <class Value, class... Limits>
  void operator()(const char* name, const Value& value, const Limits&... limits) {
    const auto offset =
        reinterpret_cast<const std::byte*>(&value) - reinterpret_cast<const std::byte*>(&example_);
    const auto at = [offset](const Group& group) {
      return reinterpret_cast<const Value*>(reinterpret_cast<const std::byte*>(&group) + offset);
    };
    const char* comment = (limits, ...);
    type_.def_prop_rw(
        name, [at](const Group& group) { return *at(group); },
        [at](Group& group, Value assigned) { *const_cast<Value*>(at(group)) = assigned; }, comment);
  }

 private:
  nb::class_<Group>& type_;
  const Group& example_;
};

template <class Group>
nb::class_<Group> bind_group(nb::module_& module, const char* name) {
  nb::class_<Group> type(module, name);
  type.def(nb::init<>());
  const Group example;
  visit_settings(example, FieldBinder<Group>(type, example));
  return type;
}

}  // namespace

void bind_settings(nb::module_& module) {
  bind_group<SegmentationSettings>(module, "SegmentationSettings");
  bind_group<FeatureSettings>(module, "FeatureSettings");
  bind_group<OdometrySettings>(module, "OdometrySettings");
  bind_group<MappingSettings>(module, "MappingSettings");
  bind_group<TrackingSettings>(module, "TrackingSettings");
  bind_group<KeyFrameSettings>(module, "KeyFrameSettings");
  bind_group<ScanContextSettings>(module, "ScanContextSettings");
  bind_group<RadiusSearchSettings>(module, "RadiusSearchSettings");
  bind_group<VerifierSettings>(module, "VerifierSettings");
  bind_group<LoopSettings>(module, "LoopSettings")
      .def_rw("scan_context", &LoopSettings::scan_context)
      .def_rw("radius_search", &LoopSettings::radius_search)
      .def_rw("verifier", &LoopSettings::verifier);
  bind_group<GraphSettings>(module, "GraphSettings");
  bind_group<OutputSettings>(module, "OutputSettings");
  bind_group<HealthSettings>(module, "HealthSettings");

  nb::class_<Settings>(
      module, "Settings",
      "The settings of the method lego-loam-sc, to be changed by attribute, such as\n"
      "settings.loop.scan_context.threshold = 0.3; Slam checks them.")
      .def(nb::init<>())
      .def_rw("segmentation", &Settings::segmentation)
      .def_rw("features", &Settings::features)
      .def_rw("odometry", &Settings::odometry)
      .def_rw("mapping", &Settings::mapping)
      .def_rw("tracking", &Settings::tracking)
      .def_rw("key_frames", &Settings::key_frames)
      .def_rw("loop", &Settings::loop)
      .def_rw("graph", &Settings::graph)
      .def_rw("output", &Settings::output)
      .def_rw("health", &Settings::health)
      .def("__str__", [](const Settings& settings) { return to_yaml(settings); });
  module.def(
      "load_settings",
      [](const std::string& method, const std::optional<std::filesystem::path>& file) {
        return load_settings(method, file, {});
      },
      "method"_a = "lego-loam-sc", "file"_a = nb::none(),
      "The settings of a method, changed by a YAML file.");
}

}  // namespace lego_loam_sc::python
