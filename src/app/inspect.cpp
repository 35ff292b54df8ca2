// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <numeric>

#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/external_command.hpp"
#include "app/run_folder.hpp"
#include "app/scan_input.hpp"
#include "app/stage_files.hpp"
#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/text.hpp"
#include "io/settings_yaml.hpp"
#include "sensor/recognise_sensor.hpp"

namespace lego_loam_sc {
namespace {

struct Options : InputOptions {
  CommonOptions common;
  std::optional<std::filesystem::path> output;
};

ScanWithFacts read_scan(const Options& options) {
  ScanInput input(options, true);
  ScanSource& source = input.source();
  std::optional<Scan> scan = source.next();
  for (std::size_t k = 0; scan && k < options.first; ++k) scan = source.next();
  input.wait_for_reader();
  if (!scan)
    throw InputError(options.input + ": there is no scan " + std::to_string(options.first) +
                     " in it; choose another --first");
  return {std::move(*scan), source.facts()};
}

// "0.5 to 80.2"
template <class Values>
std::string span_of(const Values& values, int decimals, double factor = 1.0) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return to_fixed(factor * static_cast<double>(*least), decimals) + " to " +
         to_fixed(factor * static_cast<double>(*most), decimals);
}

std::string percent(std::size_t part, std::size_t whole) {
  return to_fixed(whole > 0 ? 100.0 * static_cast<double>(part) / static_cast<double>(whole) : 0.0,
                  1) +
         " %";
}

std::vector<Eigen::Vector3f> returns_of(const Scan& scan) {
  std::vector<Eigen::Vector3f> points;
  for (const Eigen::Vector3f& p : scan.points)
    if (is_return(p)) points.push_back(p);
  return points;
}

// The scan as it was read, without a sensor model.
std::string describe_scan(const Scan& scan) {
  const std::vector<Eigen::Vector3f> points = returns_of(scan);
  std::string text = "scan      " + std::to_string(scan.size()) + " points, " +
                     std::to_string(points.size()) + " with a return";
  if (points.empty()) return text + "\n";
  std::vector<double> range, elevation;
  for (const Eigen::Vector3f& p : points) {
    range.push_back(p.norm());
    elevation.push_back(degrees(std::atan2(p.z(), p.head<2>().norm())));
  }
  text += " at " + span_of(range, 1) + " m, " + span_of(elevation, 1) + " deg\nfields    ";
  text += scan.intensity.empty() ? "no intensity" : "intensity " + span_of(scan.intensity, 2);
  text += scan.ring.empty() ? ", no rings" : ", rings " + span_of(scan.ring, 0);
  text +=
      scan.offset_ns.empty() ? ", no times" : ", times " + span_of(scan.offset_ns, 1, 1e-6) + " ms";
  return text + "\n";
}

std::string describe_rows(const RangeImage& image, const SensorModel& sensor) {
  std::vector<std::uint32_t> counts;
  std::string empty;
  for (int row = 0; row < image.rows; ++row) {
    const std::uint32_t count = image.row_begin[row + 1] - image.row_begin[row];
    if (count > 0)
      counts.push_back(count);
    else
      empty += (empty.empty() ? "" : ", ") + to_fixed(sensor.elevation_deg[row], 1);
  }
  std::string text = "rows      " + std::to_string(counts.size()) + " of " +
                     std::to_string(image.rows) + " have points";
  if (!counts.empty()) {
    const auto middle = counts.begin() + static_cast<std::ptrdiff_t>(counts.size() / 2);
    std::nth_element(counts.begin(), middle, counts.end());
    text += ", " + span_of(counts, 0) + " each, median " + std::to_string(*middle) + " of " +
            std::to_string(image.columns) + " columns";
  }
  return text + (empty.empty() ? "" : "; none at " + empty + " deg") + "\n";
}

std::string describe_stages(const Scan& scan, const ScanStages& stages, const SensorModel& sensor) {
  const std::size_t points = stages.image.size();
  const Segmentation& s = stages.segmentation;
  const Features& f = stages.features;
  const auto number = [](std::size_t count) { return std::to_string(count); };
  std::string text = "sensor    " + sensor.name + ", " + number(sensor.elevation_deg.size()) +
                     " rows from " + to_fixed(sensor.elevation_deg.front(), 1) + " to " +
                     to_fixed(sensor.elevation_deg.back(), 1) + " deg\n";
  text += describe_rows(stages.image, sensor);
  text += "left out  " + number(returns_of(scan).size() - points) +
          " points: in no row, nearer than " + to_fixed(sensor.min_range, 1) + " m or beyond " +
          to_fixed(sensor.max_range, 1) + " m\n";
  text += "height    " +
          (stages.sensor_height == 0.0
               ? std::string("unknown, too little level ground in sight")
               : to_fixed(stages.sensor_height, 2) + " m above the ground" +
                     (sensor.height == 0.0 ? ", estimated" : ", from the sensor's file")) +
          "\n";
  if (stages.sensor.tilted())
    text += "tilt      roll " + to_fixed(stages.sensor.mount_roll_deg, 1) + ", pitch " +
            to_fixed(stages.sensor.mount_pitch_deg, 1) + " deg" +
            (sensor.tilted() ? ", from the sensor's file" : ", estimated") + "\n";
  text += "ground    " + percent(s.ground_points, points) + " of the points\n";
  text += "clusters  " + number(s.clusters) + " with " + percent(s.segment_points, points) +
          " of the points; " + percent(points - s.ground_points - s.segment_points, points) +
          " in none\n";
  text += "features  " + number(f.edges_large.size()) + " edges, " + number(f.edges_sharp.size()) +
          " of them sharp; " + number(f.planars_large.size()) + " planar points, " +
          number(f.planars_flat.size()) + " of them flat\n";
  return text;
}

// The clouds are the result; a page of them is made where the companion package is installed.
bool show(const std::filesystem::path& folder) {
  std::printf("clouds of the stages in %s\n", folder.c_str());
  try {
    return make_report(folder, false);
  } catch (const InputError& error) {
    spdlog::warn("{}", error.what());
    return true;
  }
}

void inspect(const Options& options, int& exit_code) {
  const CommonOptions& common = options.common;
  const Settings settings = load_settings(common.method, common.config, common.assignments);
  const auto [scan, facts] = read_scan(options);
  const std::string summary = describe_scan(scan);
  std::printf("%s", summary.c_str());
  std::fflush(stdout);  // before an error about the sensor
  const SensorModel sensor = choose_sensor(common.sensor, scan, facts);
  // No error: a scan that does not fit the sensor is the one to inspect.
  if (const auto mismatch = sensor_mismatch(scan, sensor)) spdlog::warn("{}", *mismatch);
  const ScanStages stages = make_stages(scan, sensor, settings);
  const std::string found = describe_stages(scan, stages, sensor);
  std::printf("%s", found.c_str());
  if (!options.output) return;
  const std::filesystem::path folder = make_run_folder(options.output, options.input);
  write_stage_clouds(folder, stages);
  write_stage_facts(folder, stages, sensor, options.input, summary + found);
  if (!show(folder)) exit_code = 1;
}

}  // namespace

void add_inspect(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "inspect", "Show what the front end makes of one scan: rows, ground, clusters, features");
  auto options = std::make_shared<Options>();
  add_input_options(*command, *options, "SCAN", "a scan, or anything that run takes");
  command->add_option("-o,--output", options->output,
                      "folder for coloured clouds and a page that shows them, new or empty");
  add_common_options(*command, options->common);
  command->callback([options, &exit_code] { inspect(*options, exit_code); });
}

}  // namespace lego_loam_sc
