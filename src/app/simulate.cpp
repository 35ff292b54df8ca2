// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "io/scan_stream.hpp"
#include "io/sensor_yaml.hpp"
#include "sim/kitti_folder.hpp"
#include "sim/lidar.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {
namespace {

struct Options {
  std::string world;
  std::string output;
  std::string sensor;  // empty: the world's own
  std::uint64_t seed = 1;
  std::optional<std::int64_t> count;
  std::string distort;  // on, off, empty: as the sensor says
  std::optional<double> noise;
  std::string drop_outs = "on";
};

using Sink = std::function<void(const Scan&, const Pose& T_world_lidar)>;

Sink open_sink(const std::string& output, const DatasetFacts& facts) {
  if (output == "-") {
    const auto stream = std::make_shared<ScanStreamWriter>(std::cout, facts);
    return [stream](const Scan& scan, const Pose&) { stream->write(scan); };
  }
  const auto folder = std::make_shared<KittiFolder>(output, facts);
  return [folder](const Scan& scan, const Pose& pose) { folder->add(scan, pose); };
}

DatasetFacts facts_of(const SensorModel& sensor, const std::string& name_or_file, bool distorted) {
  DatasetFacts facts;
  // A file must be found from the folder's own place too.
  facts.sensor =
      sensor.name == name_or_file ? name_or_file : std::filesystem::absolute(name_or_file).string();
  facts.motion_compensated = !distorted;
  return facts;
}

void simulate(const Options& options) {
  World world = make_world(options.world, options.seed);
  const std::string sensor_name =
      options.sensor.empty() ? std::string(world.sensor) : options.sensor;
  const SensorModel sensor = load_sensor(sensor_name);
  const bool distort =
      options.distort.empty() ? !sensor.motion_compensated : options.distort == "on";
  const LidarSettings settings{.distort = distort,
                               .noise = options.noise.value_or(sensor.range_noise),
                               .drop_outs = options.drop_outs == "on",
                               .seed = options.seed};
  const Sink sink = open_sink(options.output, facts_of(sensor, sensor_name, distort));

  const RayCaster caster(std::move(world.mesh));
  const LidarPose lidar_pose =
      [&, T_vehicle_lidar = mounting(sensor, world.sensor_height)](std::int64_t time_ns) -> Pose {
    return world.motion.pose(time_ns) * T_vehicle_lidar;
  };
  const std::int64_t period = std::llround(sensor.period * 1e9);
  // The last scan of a whole drive is taken at rest at its end.
  const std::int64_t whole_drive = (world.motion.duration_ns + period - 1) / period + 1;
  const std::int64_t count = options.count.value_or(whole_drive);
  Progress progress(static_cast<std::size_t>(count), isatty(STDERR_FILENO) == 0);
  catch_interrupts();  // a scan half written would spoil the rest
  for (std::int64_t i = 0; i < count && !interrupted(); ++i) {
    const std::int64_t stamp_ns = i * period;
    sink(sweep(caster, sensor, lidar_pose, stamp_ns, settings), lidar_pose(stamp_ns));
    progress.step();
  }
}

}  // namespace

void add_simulate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  const CLI::IsMember on_off({"on", "off"});
  std::string worlds;
  for (const std::string_view name : world_names())
    worlds += (worlds.empty() ? "" : ", ") + std::string(name);

  CLI::App* command =
      app.add_subcommand("simulate", "Make scans of a made world, with their truth");
  command->add_option("WORLD", options->world, "One of: " + worlds)->required();
  command
      ->add_option("-o,--output", options->output,
                   "Folder to make, or - for a scan stream on standard output")
      ->required();
  command->add_option("--sensor", options->sensor,
                      "Sensor preset or file [default: what suits the world]");
  command->add_option("--seed", options->seed, "Of the world, the noise and the shaking")
      ->capture_default_str();
  command->add_option("--count", options->count, "Scans [default: the whole drive]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--distort", options->distort,
                   "Motion within a sweep [default: as the sensor says]")
      ->check(on_off);
  command
      ->add_option("--noise", options->noise,
                   "Sigma of the ranges, m [default: as the sensor says]")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--dropouts", options->drop_outs, "Weak echoes get lost")
      ->capture_default_str()
      ->check(on_off);
  command->callback([options] { simulate(*options); });
}

}  // namespace lego_loam_sc
