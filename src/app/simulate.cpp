// SPDX-License-Identifier: BSD-3-Clause
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <future>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "core/time.hpp"
#include "io/append_file.hpp"
#include "io/kitti_folder.hpp"
#include "io/scan_stream.hpp"
#include "io/sensor_yaml.hpp"
#include "io/trajectory.hpp"
#include "sim/beam_errors.hpp"
#include "sim/lidar.hpp"
#include "sim/ray_caster.hpp"
#include "sim/world.hpp"

namespace lego_loam_sc {
namespace {

struct Options {
  std::string world;
  std::string output;
  std::string route;   // empty: the world's own
  std::string sensor;  // empty: the world's own
  std::uint64_t seed = 1;
  std::optional<std::int64_t> count;
  std::string distort;  // on, off, empty: as the sensor says
  std::optional<double> noise;
  std::string drop_outs = "on";
  std::string wear;  // on, off, empty: as the world says
  std::string traffic = "on";
  std::string truth;  // empty: none beside what the folder holds
};

using Sink = std::function<void(const Scan&, const Pose& T_world_lidar)>;

Sink open_sink(const Options& options, const DatasetFacts& facts) {
  const auto truth = options.truth.empty() ? nullptr : std::make_shared<AppendFile>(options.truth);
  if (truth) truth->cut(0);
  const auto note = [truth](const Scan& scan, const Pose& T_world_lidar) {
    if (truth) truth->append(tum_line({scan.stamp_ns, T_world_lidar}));
  };
  if (options.output == "-") {
    const auto stream = std::make_shared<ScanStreamWriter>(std::cout, facts);
    return [stream, note](const Scan& scan, const Pose& T_world_lidar) {
      stream->write(scan);
      note(scan, T_world_lidar);
    };
  }
  const auto folder = std::make_shared<KittiFolder>(options.output, facts);
  return [folder, note](const Scan& scan, const Pose& T_world_lidar) {
    folder->add(scan, T_world_lidar);
    note(scan, T_world_lidar);
  };
}

DatasetFacts facts_of(const SensorModel& sensor, const std::string& name_or_file, bool distorted) {
  DatasetFacts facts;
  // A file must be found from the folder's own place too.
  facts.sensor =
      sensor.name == name_or_file ? name_or_file : std::filesystem::absolute(name_or_file).string();
  facts.motion_compensated = !distorted;
  return facts;
}

LidarSettings settings_of(const Options& options, const World& world, const SensorModel& sensor) {
  const bool worn = options.wear.empty() ? world.worn_sensor : options.wear == "on";
  return {.distort = options.distort.empty() ? !sensor.motion_compensated : options.distort == "on",
          .noise = options.noise.value_or(world.range_noise.value_or(sensor.range_noise)),
          .beam_errors = worn ? used_beams(sensor.rows(), options.seed) : BeamErrors(),
          .drop_outs = options.drop_outs == "on",
          .seed = options.seed};
}

void simulate(const Options& options) {
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error like a full disk
  World world = options.route.empty()
                    ? make_world(options.world, options.seed)
                    : make_world(options.world, options.seed, read_route(options.route));
  const std::string sensor_name =
      options.sensor.empty() ? std::string(world.sensor) : options.sensor;
  const SensorModel sensor = load_sensor(sensor_name);
  const LidarSettings settings = settings_of(options, world, sensor);
  const Sink sink = open_sink(options, facts_of(sensor, sensor_name, settings.distort));

  const RayCaster caster(world.mesh);
  world.mesh = {};
  const Traffic traffic(options.traffic == "on" ? std::move(world.traffic) : TrafficPlan());
  const LidarPose lidar_pose =
      [&, T_vehicle_lidar = mounting(sensor, world.sensor_height)](std::int64_t time_ns) -> Pose {
    return world.motion.pose(time_ns) * T_vehicle_lidar;
  };
  const std::int64_t period = nanoseconds(sensor.period);
  // The last scan of a whole drive is taken at its end.
  const std::int64_t whole_drive = (world.motion.duration_ns + period - 1) / period + 1;
  const std::int64_t count = options.count.value_or(whole_drive);
  Progress progress(static_cast<std::size_t>(count), isatty(STDERR_FILENO) == 0);
  catch_interrupts();         // ends after a whole scan
  std::future<void> written;  // the previous scan is written while the next is cast
  const auto finish_writing = [&] {
    if (!written.valid()) return;
    written.get();
    progress.step();
  };
  for (std::int64_t i = 0; i < count && !interrupted(); ++i) {
    Scan scan = sweep(caster, sensor, lidar_pose, i * period, settings, traffic);
    finish_writing();
    written = std::async(std::launch::async, [&sink, &lidar_pose, scan = std::move(scan)] {
      sink(scan, lidar_pose(scan.stamp_ns));
    });
  }
  finish_writing();
}

}  // namespace

void add_simulate(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  const CLI::IsMember on_off({"on", "off"});
  std::string worlds;
  for (const WorldKind& kind : world_kinds())
    worlds += "\n" + std::string(kind.name) + ": " + std::string(kind.description);

  CLI::App* command =
      app.add_subcommand("simulate", "Simulate the scans of a made world, with their truth");
  command->add_option("WORLD", options->world, "one of:" + worlds)->required();
  command
      ->add_option("-o,--output", options->output,
                   "folder to make, or - for a scan stream on standard output")
      ->required();
  command
      ->add_option("--route", options->route,
                   "KITTI or TUM file of poses to drive along, for city and kitti00")
      ->check(CLI::ExistingFile);
  command->add_option("--sensor", options->sensor,
                      "sensor preset or file [default: what suits the world]");
  command->add_option("--seed", options->seed, "of the world, the noise and the shaking")
      ->capture_default_str();
  command->add_option("--count", options->count, "scans [default: the whole drive]")
      ->check(CLI::PositiveNumber);
  command
      ->add_option("--distort", options->distort,
                   "motion within a sweep [default: as the sensor says]")
      ->check(on_off);
  command
      ->add_option("--noise", options->noise,
                   "sigma of the ranges, m [default: as the world or the sensor says]")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--dropouts", options->drop_outs, "weak echoes are lost")
      ->capture_default_str()
      ->check(on_off);
  command
      ->add_option("--wear", options->wear,
                   "beam errors of a used sensor [default: as the world says]")
      ->check(on_off);
  command->add_option("--traffic", options->traffic, "moving objects, in worlds that have them")
      ->capture_default_str()
      ->check(on_off);
  command->add_option("--truth", options->truth,
                      "TUM file to write the truth to, as truth.tum in a folder");
  command->callback([options] { simulate(*options); });
}

}  // namespace lego_loam_sc
