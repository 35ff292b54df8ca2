// SPDX-License-Identifier: BSD-3-Clause
//
// Loops found by a detector of your own instead of Scan Context: here by how many points of a key
// frame lie in each ring of 2 m around the sensor, whichever way it looks.
//
//   03_own_loop_detector SCANS

#include <array>
#include <cstdio>
#include <exception>
#include <lego_loam_sc/io/scan_source.hpp>
#include <lego_loam_sc/sensor/recognise_sensor.hpp>
#include <lego_loam_sc/slam/slam.hpp>
#include <optional>
#include <stdexcept>

using namespace lego_loam_sc;

using Histogram = Eigen::Array<double, 30, 1>;

Histogram describe(const KeyFrame& key_frame) {
  Histogram histogram = Histogram::Zero();
  for (const PackedPoint& point : key_frame.others) {
    const int ring = static_cast<int>(point.position().head<2>().norm() / 2.0f);
    if (ring < histogram.size()) histogram[ring] += 1.0;
  }
  return histogram / std::max(histogram.sum(), 1.0);
}

int main(int argc, char** argv) try {
  if (argc != 2) return std::fputs("usage: 03_own_loop_detector SCANS\n", stderr), 2;

  Settings settings;
  settings.loop.scan_context.enabled = false;
  settings.loop.radius_search.enabled = false;

  std::vector<Histogram> histograms;  // of all key frames so far
  const LoopDetector detector = [&histograms](const LoopQuery& query) {
    while (histograms.size() < query.key_frames.size())
      histograms.push_back(describe(query.key_frames[histograms.size()]));
    LoopCandidate best;
    best.distance = 2.0;
    for (int k = 0; k < query.eligible; ++k) {
      const double distance = (histograms.back() - histograms[k]).abs().sum();
      if (distance < best.distance) best.match = k, best.distance = distance;
    }
    return std::vector<LoopCandidate>{best};  // the verifier decides
  };

  const auto source = open_scans(argv[1]);
  std::optional<Scan> scan = source->next();
  if (!scan) throw std::runtime_error("there is no scan");
  Slam slam(recognise_sensor(*scan, source->facts()), settings, 2, detector);
  for (; scan; scan = source->next()) slam.process(*scan);
  for (const PoseEdge& loop : slam.graph().loop_edges())
    std::printf("key frame %d is back at key frame %d\n", loop.to, loop.from);
} catch (const std::exception& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 1;
}
