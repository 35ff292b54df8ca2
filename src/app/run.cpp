// SPDX-License-Identifier: BSD-3-Clause
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/checkpoint.hpp"
#include "app/commands.hpp"
#include "app/common_options.hpp"
#include "app/external_command.hpp"
#include "app/interrupt.hpp"
#include "app/progress.hpp"
#include "app/result_writer.hpp"
#include "app/run_folder.hpp"
#include "app/run_input.hpp"
#include "app/scan_input.hpp"
#include "core/error.hpp"
#include "io/blob_file.hpp"
#include "io/point_times.hpp"
#include "io/sensor_yaml.hpp"
#include "io/settings_yaml.hpp"
#include "io/trajectory.hpp"
#include "sensor/recognise_sensor.hpp"
#include "slam/slam.hpp"

namespace lego_loam_sc {
namespace {

struct Options : InputOptions {
  CommonOptions common;
  std::optional<std::filesystem::path> output;
  bool resume = false;
  double checkpoint_seconds = 60.0;
  std::optional<std::filesystem::path> truth;
  int threads = 2;
  std::optional<std::size_t> count;
  bool report = false;
  bool quiet = false;
};

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::filesystem::path folder_of(const Options& options) {
  std::error_code error;
  const bool is_new = !options.resume || !std::filesystem::exists(*options.output, error) ||
                      std::filesystem::is_empty(*options.output, error);
  if (is_new) return make_run_folder(options.output, options.input);
  if (Checkpoint::marks(*options.output)) return *options.output;
  throw InputError(options.output->string() +
                   ": holds no checkpoint to resume from; a run that is done has none");
}

// The position of a run in its input, saved with each checkpoint.
struct Bookmark {
  std::string settings, sensor;     // as YAML
  std::size_t taken = 0;            // of the input
  std::int64_t stamp_ns = 0;        // of the last scan
  std::vector<std::string> faults;  // so far
  double wall_seconds = 0.0;        // so far

  template <class Archive>
  void state(Archive& archive) {
    archive(settings, sensor, taken, stamp_ns, faults, wall_seconds);
  }
};

RunFacts facts_of(const Options& options) {
  RunFacts facts;
  facts.input = options.input;
  facts.method = options.common.method;
  facts.threads = options.threads;
  if (options.truth) facts.truth = {options.truth->string(), read_poses(*options.truth)};
  return facts;
}

// The sensor of a run, to which `scan` has to fit.
SensorModel sensor_of(const Options& options, const Scan& scan, const ScanSource& source) {
  const SensorModel sensor = choose_sensor(options.common.sensor, scan, source.facts());
  if (const auto mismatch = sensor_mismatch(scan, sensor)) throw InputError(*mismatch);
  if (!options.quiet) {
    spdlog::info("sensor {}, method {}", sensor.name, options.common.method);
    for (const std::string& note : source.notes()) spdlog::info("{}", note);
  }
  return sensor;
}

// The SLAM of a run with all that it writes.
struct Work {
  Checkpoint checkpoint;
  ResultWriter writer;
  Slam slam;
  Bookmark mark;

  Work(const Options& options, const std::filesystem::path& folder, const SensorModel& sensor,
       const Settings& settings)
      : checkpoint(folder),
        writer(folder, sensor, settings),
        slam(sensor, settings, std::max(options.threads - 1, 1), {},
             std::make_shared<BlobFile>(folder / "key_frame_points.bin")),
        mark{.settings = to_yaml(settings), .sensor = to_yaml(sensor)} {}
};

// Goes on from the checkpoint.
void resume(const Options& options, RunInput& input, Work& work) {
  Bookmark saved;
  work.checkpoint.load([&](StateReader& reader) {
    reader(saved);
    if (saved.settings != work.mark.settings || saved.sensor != work.mark.sensor)
      throw InputError(options.output->string() +
                       ": was begun with other settings or another sensor; give those of its "
                       "settings.yaml and sensor.yaml to resume it");
    reader(work.writer);
    work.slam.read(reader);
  });
  const std::optional<std::int64_t> skipped = input.skip_to(saved.taken, saved.faults);
  const std::int64_t stamp_ns = skipped.value_or(work.mark.stamp_ns);
  if (!interrupted() && (input.taken() != saved.taken || stamp_ns != saved.stamp_ns))
    throw InputError(options.output->string() + ": was begun with other scans than those of " +
                     options.input + "; give the same INPUT, --first and --count to resume it");
  work.mark = std::move(saved);
}

void save_checkpoint(const RunInput& input, double wall_seconds, Work& work) {
  work.mark.taken = input.taken();
  work.mark.faults = input.faults();
  work.mark.wall_seconds = wall_seconds;
  work.checkpoint.save([&](StateWriter& state) {
    state(work.mark, work.writer);
    return work.slam.write(state);
  });
}

// Processes the scans already read, then those that follow. `wall_seconds` gives the time so far.
void process_scans(const Options& options, RunInput& input, std::deque<Scan> scans,
                   const std::function<double()>& wall_seconds, Work& work) {
  Progress progress(input.expected(), options.quiet);
  double saved = wall_seconds();
  while (!interrupted()) {
    if (scans.empty()) {
      std::optional<Scan> scan = input.next();
      if (!scan) break;
      scans.push_back(std::move(*scan));
    }
    work.writer.add(work.slam.process(scans.front()));
    progress.step();
    work.mark.stamp_ns = scans.front().stamp_ns;
    scans.pop_front();
    if (!scans.empty() || wall_seconds() - saved < options.checkpoint_seconds) continue;
    save_checkpoint(input, wall_seconds(), work);
    saved = wall_seconds();
  }
}

void run(const Options& options, int& exit_code) {
  const auto begin = std::chrono::steady_clock::now();
  const CommonOptions& common = options.common;
  const Settings settings = load_settings(common.method, common.config, common.assignments);
  RunFacts facts = facts_of(options);
  RunInput input(options, options.count, options.quiet);
  std::deque<Scan> scans = input.leading();
  if (scans.empty() && !input.finish_reader()) {
    exit_code = 1;
    return;
  }
  if (scans.empty())
    throw InputError(options.input + ": no scan could be read; nothing was written");
  const DatasetFacts& dataset = input.source().facts();
  const SensorModel sensor = sensor_of(options, scans.back(), input.source());
  facts.sensor = sensor.name;
  std::vector<std::string> notes = input.source().notes();
  if (sensor.motion_compensated && are_times(scans.back().offset_ns)) {
    notes.emplace_back(
        "the scans are declared motion compensated: the times of their points are not used");
    if (!options.quiet) spdlog::info("{}", notes.back());
  }
  const std::size_t noted = input.source().notes().size();
  if (options.threads > 1) input.read_ahead();

  const std::filesystem::path folder = folder_of(options);
  Work work(options, folder, sensor, settings);
  work.mark.stamp_ns = scans.back().stamp_ns;
  catch_interrupts();
  if (work.checkpoint.holds_state()) {
    resume(options, input, work);
    scans.clear();
  } else {
    work.writer.begin();
  }
  const auto wall_seconds = [before = work.mark.wall_seconds, begin] {
    return before + seconds_since(begin);
  };
  process_scans(options, input, std::move(scans), wall_seconds, work);

  input.finish_reader();
  facts.faults = input.faults();
  const std::vector<std::string>& all_notes = input.final_notes();
  for (std::size_t k = noted; k < all_notes.size(); ++k) {
    if (!options.quiet) spdlog::info("{}", all_notes[k]);
    notes.push_back(all_notes[k]);
  }
  facts.notes = std::move(notes);
  facts.interrupted = interrupted();
  facts.wall_seconds = wall_seconds();
  const RunSummary summary = work.writer.finish(work.slam, dataset, facts);
  work.checkpoint.remove();
  if (!options.quiet)
    std::printf("%sresults in %s\n%s\n", summary.text.c_str(), folder.c_str(),
                summary.verdict.c_str());
  if (!facts.faults.empty()) exit_code = 1;
  if (options.report && !make_report(folder, options.quiet)) exit_code = 1;
}

}  // namespace

void add_run(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand("run", "Run the SLAM on the scans of INPUT");
  auto options = std::make_shared<Options>();
  add_input_options(*command, *options, "INPUT",
                    "KITTI sequence folder, folder of .bin, .pcd or .ply scans, ROS bag, Velodyne "
                    ".pcap, or - for a scan stream on standard input");
  auto* output =
      command->add_option("-o,--output", options->output, "folder for the results, new or empty");
  command
      ->add_flag("--resume", options->resume,
                 "go on in the folder of a run that was killed, from its last checkpoint")
      ->needs(output);
  command
      ->add_option("--checkpoint", options->checkpoint_seconds,
                   "seconds of work from one checkpoint to the next")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_common_options(*command, options->common);
  command->add_option("--threads", options->threads, "bound on all threads")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  command->add_option("--count", options->count, "number of scans to use");
  command->add_option("--truth", options->truth, "true trajectory, TUM or KITTI: adds the errors")
      ->check(CLI::ExistingFile);
  command->add_flag("--report", options->report, "write report.html as well");
  command->add_flag("--quiet", options->quiet, "print errors only");
  command->callback([options, &exit_code] { run(*options, exit_code); });
}

}  // namespace lego_loam_sc
