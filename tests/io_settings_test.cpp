// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/presets.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"
#include "io/yaml.hpp"
#include "io_test_files.hpp"

namespace lego_loam_sc {
namespace {

constexpr const char* kMethod = "lego-loam-sc";

std::string settings_error(const TemporaryFolder& folder, const std::string& yaml) {
  const auto file = folder.write("a.yaml", yaml);
  return error_of([&] { load_settings(kMethod, file, {}); });
}

TEST(SettingsYaml, TheDefaultMethodIsTheDefaults) {
  EXPECT_EQ(to_yaml(load_settings(kMethod, {}, {})), to_yaml(Settings{}));
}

TEST(SettingsYaml, AllMethodsLoad) {
  for (const std::string& name : preset_names("methods"))
    EXPECT_FALSE(validate(load_settings(name, {}, {}))) << name;
}

TEST(SettingsYaml, AMethodDiffersFromItsBaseInWhatItNames) {
  const Settings paper = load_settings("lego-loam-sc-paper", {}, {});
  const Settings loam = load_settings("loam", {}, {});
  EXPECT_EQ(loam.features.edges_large, paper.features.edges_large);
  EXPECT_NE(loam.features.edges_large, Settings{}.features.edges_large);
  EXPECT_TRUE(paper.odometry.two_step);
  EXPECT_FALSE(loam.odometry.two_step);
}

TEST(SettingsYaml, WhatIsPrintedLoadsToTheSameSettings) {
  const TemporaryFolder folder;
  Settings settings;
  settings.segmentation.enabled = !settings.segmentation.enabled;
  settings.features.neighbours = 7;
  settings.mapping.radius = 1.0 / 0.011;
  settings.loop.spacing = 1e-7;
  settings.loop.scan_context.threshold = 0.1 + 0.2;
  settings.graph.degenerate_inflation = 123456.789;
  const std::string text = to_yaml(settings);
  const Settings loaded = load_settings(kMethod, folder.write("a.yaml", text), {});
  EXPECT_EQ(loaded.segmentation.enabled, settings.segmentation.enabled);
  EXPECT_EQ(loaded.features.neighbours, 7);
  EXPECT_EQ(loaded.mapping.radius, settings.mapping.radius);
  EXPECT_EQ(loaded.loop.spacing, settings.loop.spacing);
  EXPECT_EQ(loaded.loop.scan_context.threshold, settings.loop.scan_context.threshold);
  EXPECT_EQ(to_yaml(loaded), text);
}

TEST(SettingsYaml, AssignmentsComeAfterTheFile) {
  const TemporaryFolder folder;
  const auto file = folder.write("a.yaml", "loop: {scan_context: {threshold: 0.3, rings: 10}}\n");
  const Settings settings = load_settings(kMethod, file, {"loop.scan_context.threshold=0.2"});
  EXPECT_EQ(settings.loop.scan_context.threshold, 0.2);
  EXPECT_EQ(settings.loop.scan_context.rings, 10);
}

TEST(SettingsYaml, AnUnknownKeyNamesFileLineAndTheNearestKey) {
  const TemporaryFolder folder;
  const std::string message =
      settings_error(folder, "# comment\nloop:\n  scan_context:\n    treshold: 0.3\n");
  EXPECT_EQ(message, (folder.path() / "a.yaml").string() +
                         ", line 4: there is no loop.scan_context.treshold; the nearest is "
                         "loop.scan_context.threshold");
  const std::string leaf = error_of([] { load_settings(kMethod, {}, {"max_radius=3"}); });
  EXPECT_NE(leaf.find("the nearest is loop.scan_context.max_radius"), leaf.npos);
}

TEST(SettingsYaml, ABadValueNamesLineKeyAndWhatIsAllowed) {
  const TemporaryFolder folder;
  const auto expect = [&](const std::string& yaml, const std::string& words) {
    const std::string message = settings_error(folder, yaml);
    EXPECT_NE(message.find("line 1: "), message.npos) << message;
    EXPECT_NE(message.find(words), message.npos) << message;
  };
  expect("loop: {scan_context: {threshold: 3}}", "threshold is 3, it must be a number between 0");
  expect("loop: {scan_context: {threshold: .nan}}", "a number between 0 and 1");
  expect("loop: {scan_context: {threshold: [0.1]}}", "threshold is [0.1]");
  expect("features: {neighbours: 5.5}", "neighbours is 5.5, it must be an integer between");
  expect("segmentation: {enabled: on}", "enabled is on, it must be true or false");
  expect("segmentation: {enabled: }", "value is missing");
  expect("segmentation:", "value is missing");
  expect("features: {neighbours: 5, neighbours: 6}", "features.neighbours occurs twice");
  expect("features: {neighbours: {a: 5}}", "there is no features.neighbours.a");
  expect("features: 5", "there is no features");
  expect("[1, 2]", "a list is not expected");
  expect("just words", "lines of \"key: value\"");
  expect("features: {neighbours: 5", "");
  expect("{a: &x 1, b: *x}", "aliases are not allowed");
}

TEST(SettingsYaml, UnknownMethodsAndMalformedAssignmentsAreErrors) {
  const std::string method = error_of([] { load_settings("lego-loam-cs", {}, {}); });
  EXPECT_NE(method.find("there is no method lego-loam-cs; the presets are"), method.npos);
  for (const char* assignment : {"loop.spacing", "=3", "loop.spacing="})
    EXPECT_THROW(load_settings(kMethod, {}, {assignment}), InputError) << assignment;
}

TEST(Yaml, SurvivesDamage) {
  read_damaged(
      "loop: {scan_context: {threshold: 0.3}}\nbeams: [1, 2]\nodometry:\n  on: true # end\n",
      [](const std::string& text) { parse_yaml(text, "a.yaml"); });
}

TEST(SensorYaml, AllPresetsLoadAndSurviveBeingPrinted) {
  const TemporaryFolder folder;
  const std::vector<std::string> names = preset_names("sensors");
  EXPECT_EQ(names,
            (std::vector<std::string>{
                "hdl32e",  "hdl64e", "helios16p",   "kitti",  "os0-128",   "os0-32",   "os0-64",
                "os1-128", "os1-32", "os1-64-gen1", "os1-64", "pandar40p", "pandar64", "rs16",
                "rs32",    "ruby",   "vlp16",       "vlp32c", "vls128",    "xt16",     "xt32"}));
  for (const std::string& name : names) {
    const SensorModel sensor = load_sensor(name);
    EXPECT_EQ(sensor.name, name);
    EXPECT_FALSE(validate(sensor)) << name;
    const SensorModel again = load_sensor(folder.write(name + ".yaml", to_yaml(sensor)).string());
    EXPECT_EQ(again.elevation_deg, sensor.elevation_deg);
    EXPECT_EQ(to_yaml(again), to_yaml(sensor));
  }
}

TEST(SensorYaml, PresetsHaveTheBeamsOfTheirSensors) {
  const SensorModel vlp16 = load_sensor("vlp16");
  ASSERT_EQ(vlp16.rows(), 16);
  for (int row = 0; row < 16; ++row) EXPECT_EQ(vlp16.elevation_deg[row], -15 + 2 * row);
  const SensorModel hdl32e = load_sensor("hdl32e");
  ASSERT_EQ(hdl32e.rows(), 32);
  EXPECT_EQ(hdl32e.elevation_deg.back(), 10.67);
  EXPECT_NEAR(hdl32e.elevation_deg[1], -30.67 + 41.34 / 31, 1e-9);
  EXPECT_EQ(load_sensor("hdl64e").rows(), 64);
  const SensorModel kitti = load_sensor("kitti");
  EXPECT_EQ(kitti.rows(), 64);
  EXPECT_TRUE(kitti.motion_compensated);
  EXPECT_EQ(kitti.elevation_correction_deg, 0.205);
  const auto rows_of = [](const char* name, double lowest, double highest) {
    const SensorModel sensor = load_sensor(name);
    EXPECT_EQ(sensor.elevation_deg.front(), lowest) << name;
    EXPECT_EQ(sensor.elevation_deg.back(), highest) << name;
    return sensor.rows();
  };
  EXPECT_EQ(rows_of("vlp32c", -25, 15), 32);
  EXPECT_EQ(rows_of("vls128", -25, 15), 128);
  EXPECT_EQ(rows_of("rs32", -25, 15), 32);
  EXPECT_EQ(rows_of("ruby", -25, 15), 128);
  EXPECT_EQ(rows_of("pandar40p", -25, 15), 40);
  EXPECT_EQ(rows_of("pandar64", -24.897, 14.882), 64);
  EXPECT_EQ(rows_of("os0-128", -45, 45), 128);
  EXPECT_EQ(rows_of("os1-32", -21.2, 21.2), 32);
  EXPECT_EQ(rows_of("xt32", -16, 15), 32);
}

TEST(SensorYaml, UnknownNamesGetTheListAndTheNearest) {
  const std::string message = error_of([] { load_sensor("vpl16"); });
  EXPECT_TRUE(message.starts_with(
      "there is no sensor and no file vpl16; the presets are hdl32e, hdl64e, helios16p, kitti, "))
      << message;
  EXPECT_TRUE(message.ends_with(" vlp32c, vls128, xt16, xt32 (vlp16 is the nearest)")) << message;
}

TEST(SensorYaml, RefusesWrongBeams) {
  const TemporaryFolder folder;
  const auto message = [&](const std::string& yaml) {
    return error_of([&] { load_sensor(folder.write("a.yaml", yaml).string()); });
  };
  EXPECT_NE(message("elevation_deg: [1, 0]").find("must ascend"), std::string::npos);
  EXPECT_NE(message("elevation_deg: [1, x]").find("a list of numbers"), std::string::npos);
  EXPECT_NE(message("columns: 900").find("give either"), std::string::npos);
  EXPECT_NE(message("beams: 16").find("give either"), std::string::npos);
  EXPECT_NE(message("elevation_deg: [1]\nbeams: 16").find("give either"), std::string::npos);
  EXPECT_NE(message("elevation_deg: [1]\ncolums: 9")
                .find("line 2: there is no colums; the nearest "
                      "is columns"),
            std::string::npos);
}

}  // namespace
}  // namespace lego_loam_sc
