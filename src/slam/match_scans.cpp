// SPDX-License-Identifier: BSD-3-Clause
#include "slam/match_scans.hpp"

#include <array>

#include "key_frames/make_key_frame.hpp"
#include "tracking/front_end.hpp"

namespace lego_loam_sc {
namespace {

// In levelled axes.
struct Described {
  KeyFrame key_frame;
  ScanContext context;
  Eigen::Matrix3d R_level_lidar;
};

Described describe(const Scan& scan, const SensorModel& sensor, const Settings& settings) {
  const auto [image, segmentation, features, mounting, milliseconds] =
      run_front_end(scan, sensor, sensor.height, settings, true);
  return {make_key_frame(image, segmentation, features, image.points, 0.0,
                         settings.key_frames.point_spacing),
          make_scan_context(image.points, mounting.height, settings.loop.scan_context),
          R_base_lidar(mounted(sensor, mounting))};
}

}  // namespace

ScanMatch match_scans(const Scan& a, const Scan& b, const SensorModel& sensor,
                      const Settings& settings) {
  const Described match = describe(a, sensor, settings);
  const Described query = describe(b, sensor, settings);
  ScanMatch result;
  result.scan_context = compare(query.context, match.context);

  const std::array<PlacedKeyFrame, 1> placed_match{{{unpack(match.key_frame), Pose::Identity()}}};
  const std::array<PlacedKeyFrame, 1> placed_query{{{unpack(query.key_frame), Pose::Identity()}}};
  std::array<Pose, 1> guess{Pose::Identity()};
  guess[0].linear() = rotation_from_rpy(0.0, 0.0, result.scan_context.yaw);
  result.verification =
      verify_loop(placed_query, placed_match, guess, sensor.range_noise, settings.loop.verifier);
  result.verification.T_match_query.prerotate(match.R_level_lidar.transpose())
      .rotate(query.R_level_lidar);
  if (result.verification.verdict == Verdict::accepted &&
      !(result.scan_context.distance < settings.loop.scan_context.threshold))
    result.verification.verdict = Verdict::no_candidate;
  return result;
}

}  // namespace lego_loam_sc
