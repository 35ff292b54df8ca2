// SPDX-License-Identifier: BSD-3-Clause
//
// Times each stage by itself on two neighbouring scans of a folder, in the middle of a drive:
//
//   lego-loam-sc simulate street --sensor hdl64e --count 40 -o SCANS
//   lego_loam_sc_micro SCANS [--benchmark_filter=REGEX ...]
//
// scripts/bench compares two commits with it.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "features/features.hpp"
#include "graph.hpp"
#include "io/scan_source.hpp"
#include "io/sensor_presets.hpp"
#include "key_frames/make_key_frame.hpp"
#include "loop/scan_context.hpp"
#include "loop/scan_context_index.hpp"
#include "mapping/mapper.hpp"
#include "odometry/odometry.hpp"
#include "registration/deskew.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "slam/settings.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kHeight = 1.7;  // m; of the sensor when the data set does not say

// What the stages hand on for one scan.
struct Stages {
  explicit Stages(Scan raw, const SensorModel& sensor, const Settings& settings)
      : scan(std::move(raw)),
        image(project(scan, sensor)),
        segmentation(segment(image, sensor, height(sensor), settings.segmentation)),
        features(extract_features(image, segmentation, sensor, settings.features)) {}

  static double height(const SensorModel& sensor) {
    return sensor.height > 0.0 ? sensor.height : kHeight;
  }

  Scan scan;
  RangeImage image;
  Segmentation segmentation;
  Features features;
};

struct Fixture {
  SensorModel sensor;
  Settings settings;
  std::vector<Stages> scans;  // the last two of the folder

  const Stages& before() const { return scans.front(); }
  const Stages& now() const { return scans.back(); }
};

Fixture load(const std::string& folder) {
  const std::unique_ptr<ScanSource> source = open_scans(folder);
  std::optional<Scan> before, now;
  while (std::optional<Scan> scan = source->next()) {
    before = std::move(now);
    now = std::move(scan);
  }
  if (!before) throw std::runtime_error(folder + " has fewer than two scans");
  Fixture fixture;
  fixture.sensor = recognise_sensor(*now, source->facts());
  for (std::optional<Scan>* scan : {&before, &now})
    fixture.scans.emplace_back(std::move(**scan), fixture.sensor, fixture.settings);
  return fixture;
}

// Other places for the index: nobody drives so far for a benchmark.
ScanContextIndex random_places(int count, const ScanContextSettings& settings) {
  std::mt19937 random(1);
  ScanContextIndex index(settings);
  for (int i = 0; i < count; ++i) {
    ScanContext place;
    place.rings = settings.rings;
    place.sectors = settings.sectors;
    place.columns.assign(static_cast<std::size_t>(settings.rings) * settings.sectors, 0.1f);
    place.occupied.assign(settings.sectors, 1.0f);
    for (int ring = 0; ring < settings.rings; ++ring)
      place.ring_key.push_back(static_cast<float>(random() % 4096) / 1024.0f);
    index.add(i, std::move(place));
  }
  return index;
}

template <class Step>
void add(const std::string& name, Step&& step) {
  benchmark::RegisterBenchmark(name.c_str(), [step](benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(step());
  })->Unit(benchmark::kMillisecond);
}

void add_front_end(const std::string& folder, const Fixture& f) {
  add("read", [folder] { return open_scans(folder)->next(); });
  add("project", [&f] { return project(f.now().scan, f.sensor); });
  add("segment", [&f] {
    return segment(f.now().image, f.sensor, Stages::height(f.sensor), f.settings.segmentation);
  });
  add("features", [&f] {
    return extract_features(f.now().image, f.now().segmentation, f.sensor, f.settings.features);
  });
}

void add_matching(const Fixture& f) {
  const auto odometry = std::make_shared<Odometry>(f.settings.odometry, f.sensor.range_noise);
  add("odometry_index", [&f, odometry] {
    odometry->set_previous(f.before().features);
    return odometry->has_previous();
  });
  odometry->set_previous(f.before().features);
  add("odometry_match", [&f, odometry] {
    return odometry->estimate(f.now().features, Pose::Identity(), f.sensor.period);
  });
  const auto mapper = std::make_shared<Mapper>(f.settings.mapping, f.sensor.range_noise);
  mapper->insert(f.before().features, Pose::Identity());
  add("map_match", [&f, mapper] {
    return mapper->refine(f.now().features,
                          {Pose::Identity(), Pose::Identity(), Pose::Identity(), f.sensor.period});
  });
  add("map_insert", [&f, mapper] {
    mapper->insert(f.before().features, Pose::Identity());
    return mapper->empty();
  });
}

void add_loops(const Fixture& f) {
  const ScanContextSettings& settings = f.settings.loop.scan_context;
  const auto points = std::make_shared<std::vector<Eigen::Vector3f>>(f.now().image.points);
  add("deskew_points", [&f] { return deskewed_points(f.now().image, Vector6::Constant(0.1)); });
  add("key_frame", [&f, points] {
    return make_key_frame(f.now().image, f.now().segmentation, f.now().features, *points, 0.0,
                          f.settings.key_frames.point_spacing);
  });
  add("scan_context", [&f, points, settings] {
    return make_scan_context(*points, Stages::height(f.sensor), settings);
  });
  for (const int places : {5'000, 100'000}) {
    const auto index = std::make_shared<ScanContextIndex>(random_places(places, settings));
    const auto here = std::make_shared<ScanContext>(
        make_scan_context(*points, Stages::height(f.sensor), settings));
    add("scan_context_query/" + std::to_string(places),
        [index, here, places] { return index->search(places, *here, places); });
  }
}

}  // namespace
}  // namespace lego_loam_sc

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (argc != 2) {
    std::fprintf(stderr, "usage: lego_loam_sc_micro SCANS [--benchmark_...]\n");
    return 2;
  }
  try {
    const lego_loam_sc::Fixture fixture = lego_loam_sc::load(argv[1]);
    lego_loam_sc::add_front_end(argv[1], fixture);
    lego_loam_sc::add_matching(fixture);
    lego_loam_sc::add_loops(fixture);
    lego_loam_sc::add_graph_benchmarks();
    benchmark::RunSpecifiedBenchmarks();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lego_loam_sc_micro: %s\n", error.what());
    return 1;
  }
}
