// SPDX-License-Identifier: BSD-3-Clause
#include "slam/match_scans.hpp"

#include <array>

#include "features/features.hpp"
#include "segmentation/ground.hpp"
#include "segmentation/range_image.hpp"
#include "segmentation/segmentation.hpp"
#include "slam/make_key_frame.hpp"

namespace lego_loam_sc {
namespace {

struct Described {
  KeyFrame key_frame;
  ScanContext context;
};

Described describe(const Scan& scan, const SensorModel& sensor, const Settings& settings) {
  const RangeImage image = project(scan, sensor);
  double height = sensor.height;
  if (height == 0.0)
    height = estimate_sensor_height(image, sensor, settings.segmentation).value_or(0.0);
  const Segmentation segmentation = segment(image, sensor, height, settings.segmentation);
  const Features features = extract_features(image, segmentation, sensor, settings.features);
  return {make_key_frame(image, segmentation, features, image.points, 0.0,
                         settings.key_frames.point_spacing),
          make_scan_context(image.points, height, settings.loop.scan_context)};
}

}  // namespace

ScanMatch match_scans(const Scan& a, const Scan& b, const SensorModel& sensor,
                      const Settings& settings) {
  const Described match = describe(a, sensor, settings);
  const Described query = describe(b, sensor, settings);
  ScanMatch result;
  result.scan_context = compare(query.context, match.context);

  const std::array<PlacedKeyFrame, 1> placed_match{{{&match.key_frame, Pose::Identity()}}};
  const std::array<PlacedKeyFrame, 1> placed_query{{{&query.key_frame, Pose::Identity()}}};
  std::array<Pose, 1> guess{Pose::Identity()};
  guess[0].linear() = rotation_from_rpy(0.0, 0.0, result.scan_context.yaw);
  result.verification = verify_loop(placed_query, placed_match, guess, sensor.range_noise,
                                    settings.loop.verifier);
  if (result.verification.verdict == Verdict::accepted &&
      !(result.scan_context.distance < settings.loop.scan_context.threshold))
    result.verification.verdict = Verdict::no_candidate;
  return result;
}

}  // namespace lego_loam_sc
