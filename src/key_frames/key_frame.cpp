// SPDX-License-Identifier: BSD-3-Clause
#include "key_frames/key_frame.hpp"

#include <algorithm>
#include <cmath>

#include "features/features.hpp"

namespace lego_loam_sc {

PackedPoint pack(const Eigen::Vector3f& position, float intensity) {
  const auto step = [](float metres) {
    return static_cast<std::int16_t>(
        std::lround(std::clamp(metres / PackedPoint::kStep, -32767.0f, 32767.0f)));
  };
  return {step(position.x()), step(position.y()), step(position.z()),
          Eigen::half(std::clamp(intensity, -65504.0f, 65504.0f))};
}

namespace {

std::vector<FeaturePoint> unpack(const std::vector<PackedPoint>& points) {
  std::vector<FeaturePoint> result(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) result[i].position = points[i].position();
  return result;
}

}  // namespace

Features unpack(const KeyFrame& key_frame) {
  Features features;
  features.planars_large = unpack(key_frame.planars);
  features.edges_large = unpack(key_frame.edges);
  features.scattered = unpack(key_frame.scattered);
  return features;
}

}  // namespace lego_loam_sc
