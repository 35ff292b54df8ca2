// SPDX-License-Identifier: BSD-3-Clause
#include "key_frames/make_key_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/voxel_filter.hpp"
#include "map/voxel_table.hpp"
#include "registration/deskew.hpp"

namespace lego_loam_sc {
namespace {

std::vector<PackedPoint> packed(const std::vector<FeaturePoint>& points) {
  std::vector<PackedPoint> result;
  for (const FeaturePoint& p : points) result.push_back(pack(p.position, p.intensity));
  return result;
}

float max_abs_time(const RangeImage& image) {
  float span = 0.0f;
  for (const float time : image.time) span = std::max(span, std::abs(time));
  return span;
}

}  // namespace

std::vector<Eigen::Vector3f> deskewed_points(const RangeImage& image, const Vector6& twist) {
  const float span = max_abs_time(image);
  if (span == 0.0f) return image.points;
  const SweepMotion motion(twist, span);
  std::vector<Eigen::Vector3f> points(image.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] = motion(image.points[i], image.time[i]);
  return points;
}

KeyFrame make_key_frame(const RangeImage& image, const Segmentation& segmentation,
                        const Features& deskewed, std::span<const Eigen::Vector3f> points,
                        double travelled, double spacing) {
  KeyFrame key_frame;
  key_frame.reference_ns = image.reference_ns;
  key_frame.travelled = travelled;
  const Features thin = voxel_filter(deskewed, spacing);
  key_frame.planars = packed(thin.planars_large);
  key_frame.edges = packed(thin.edges_large);

  // What these leave out, in voxels that they have not taken.
  VoxelTable<char> taken;
  taken.reserve(image.size() / 4);
  const auto take = [&](const Eigen::Vector3f& p) {
    const auto key = key_of(p.cast<double>() / spacing);
    return key && taken.find_or_insert(*key).second;
  };
  for (const auto* cloud : {&key_frame.planars, &key_frame.edges})
    for (const PackedPoint& p : *cloud) take(p.position());
  for (const FeaturePoint& p : thin.scattered)
    if (take(p.position)) key_frame.scattered.push_back(pack(p.position, p.intensity));
  // Along a row most points share the voxel of the one before; a glance at the distance is cheaper
  // than a look into the table.
  const float near = static_cast<float>(0.25 * spacing * spacing);
  Eigen::Vector3f last = Eigen::Vector3f::Constant(std::numeric_limits<float>::max());
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (segmentation.label[i] == Label::outlier || (points[i] - last).squaredNorm() < near)
      continue;
    last = points[i];
    if (take(points[i])) key_frame.others.push_back(pack(points[i], image.intensity[i]));
  }
  return key_frame;
}

}  // namespace lego_loam_sc
