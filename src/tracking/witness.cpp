// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/witness.hpp"

#include <limits>

namespace lego_loam_sc {
namespace {

constexpr std::size_t kViews = 3;
constexpr std::size_t kWitnesses = 400;
constexpr int kMinHeard = 40;

}  // namespace

double Testimony::contradiction() const {
  const int heard = agreeing + contradicting;
  return heard < kMinHeard ? std::numeric_limits<double>::quiet_NaN()
                           : static_cast<double>(contradicting) / heard;
}

std::vector<std::size_t> witnesses(std::size_t points) {
  std::vector<std::size_t> chosen;
  const std::size_t count = points < kWitnesses ? points : kWitnesses;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(i * points / count);
  return chosen;
}

Testimony Witness::hear(std::span<const Eigen::Vector3f> points, const Pose& T_map_lidar) const {
  Testimony testimony;
  std::vector<Eigen::Isometry3f> T_key_lidar;
  for (const PlacedView& placed : views_)
    T_key_lidar.push_back((placed.T_map_key.inverse() * T_map_lidar).cast<float>());
  for (const Eigen::Vector3f& point : points) {
    bool surface = false;
    bool free = false;
    for (std::size_t k = 0; k < views_.size() && !surface; ++k) {
      const RangeView::Sight sight = views_[k].view.sight(T_key_lidar[k] * point);
      surface = sight == RangeView::Sight::surface;
      free |= sight == RangeView::Sight::free;
    }
    testimony.agreeing += surface;
    testimony.contradicting += free && !surface;
  }
  return testimony;
}

void Witness::add(int key_frame, std::span<const Eigen::Vector3f> points, const Pose& T_map_key) {
  if (views_.size() == kViews) views_.erase(views_.begin());
  views_.push_back({key_frame, T_map_key, RangeView(points, row_spacing_)});
}

void Witness::correct(std::span<const Pose> T_map_key) {
  for (PlacedView& placed : views_) placed.T_map_key = T_map_key[placed.key_frame];
}

}  // namespace lego_loam_sc
