// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/ground.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

// Growth of the height tolerance with the distance between two ground points.
constexpr float kHeightPerMetre = 0.05f;

struct LevelPoint {
  float distance;  // horizontal, from the sensor, m
  float z;         // height above the sensor, m
};

LevelPoint level_point(const Eigen::Vector3f& p) {
  return {std::sqrt(p.x() * p.x() + p.y() * p.y()), p.z()};
}

bool is_level(const LevelPoint& a, const LevelPoint& b, float max_tangent) {
  return std::abs(b.z - a.z) <= max_tangent * std::abs(b.distance - a.distance);
}

// The rows whose beams can hit the ground, the steepest downward beam first.
class GroundRows {
 public:
  GroundRows(const SensorModel& sensor, const SegmentationSettings& settings)
      : rows_(sensor.rows()),
        tilted_(sensor.tilted()),
        upside_down_(R_base_lidar(sensor)(2, 2) < 0.0),
        max_tangent_(static_cast<float>(std::tan(radians(settings.ground_max_elevation_deg)))) {
    const auto end = std::upper_bound(sensor.elevation_deg.begin(), sensor.elevation_deg.end(),
                                      settings.ground_max_elevation_deg);
    count_ = tilted_ ? rows_ : static_cast<int>(end - sensor.elevation_deg.begin());
  }

  int count() const { return count_; }
  int operator[](int k) const { return upside_down_ ? rows_ - 1 - k : k; }

  // A beam of a tilted sensor points up on one side and down on the other.
  bool may_be_ground(const LevelPoint& p) const {
    return !tilted_ || p.z <= max_tangent_ * p.distance;
  }

 private:
  int rows_;
  bool tilted_;
  bool upside_down_;
  float max_tangent_;
  int count_;
};

// Further points in the pixel of a ground point are ground when range and height agree.
void mark_pixel(const RangeImage& image, std::int32_t nearest, float tolerance,
                std::vector<Label>& label) {
  label[nearest] = Label::ground;
  const auto count = static_cast<std::int32_t>(image.size());
  const auto same = [&](std::int32_t k) {
    return image.column[k] == image.column[nearest] &&
           std::abs(image.range[k] - image.range[nearest]) < tolerance &&
           std::abs(image.points[k].z() - image.points[nearest].z()) < tolerance;
  };
  for (std::int32_t k = nearest + 1; k < count && same(k); ++k) label[k] = Label::ground;
  for (std::int32_t k = nearest - 1; k >= 0 && same(k); --k) label[k] = Label::ground;
}

// State of a column after the rows below.
struct Column {
  LevelPoint ground;  // the last ground point; initially the point below the sensor
  LevelPoint previous{};
  std::int32_t previous_index = -1;
  int previous_row = 0;
  bool ground_known = false;
};

}  // namespace

void mark_ground(const RangeImage& image, const SensorModel& sensor, double sensor_height,
                 const SegmentationSettings& settings, std::vector<Label>& label) {
  const auto max_tangent = static_cast<float>(std::tan(radians(settings.ground_slope_deg)));
  const auto tolerance = static_cast<float>(settings.ground_height_tolerance);
  const GroundRows rows(sensor, settings);

  // Row by row over all columns at once, which is the memory order of the image.
  Column start;
  start.ground = {0.0f, -static_cast<float>(sensor_height)};
  start.ground_known = sensor_height > 0.0;
  std::vector<Column> columns(image.columns, start);
  for (int row = 0; row < rows.count(); ++row) {
    for (int k = 0; k < image.columns; ++k) {
      const std::int32_t index = image.pixel(rows[row], k);
      if (index < 0) continue;
      Column& column = columns[k];
      const LevelPoint& previous = column.previous;
      const LevelPoint point = level_point(image.points[index]);
      if (!rows.may_be_ground(point)) continue;
      const bool neighbours =
          column.previous_index >= 0 && row - column.previous_row <= settings.ground_max_row_gap;
      if (neighbours && is_level(previous, point, max_tangent)) {
        const float allowed =
            tolerance +
            kHeightPerMetre * std::max(previous.distance - column.ground.distance, 0.0f);
        const bool continues = column.ground_known
                                   ? std::abs(previous.z - column.ground.z) <= allowed
                                   : previous.z < 0.0f;
        if (label[column.previous_index] == Label::ground || continues) {
          mark_pixel(image, column.previous_index, tolerance, label);
          mark_pixel(image, index, tolerance, label);
          column.ground = point;
          column.ground_known = true;
        }
      }
      column.previous = point;
      column.previous_index = index;
      column.previous_row = row;
    }
  }
}

std::optional<double> estimate_sensor_height(const RangeImage& image, const SensorModel& sensor,
                                             const SegmentationSettings& settings) {
  constexpr float kRadius = 15.0f;  // m round the vehicle, where the ground is dense and level
  constexpr float kBin = 0.1f;      // m; a kerb apart
  constexpr int kBins = 100;        // down to 10 m below the sensor
  constexpr int kMinPoints = 100;   // in the fullest bin; fewer may be roofs and hedges
  const auto max_tangent = static_cast<float>(std::tan(radians(settings.ground_slope_deg)));
  const GroundRows rows(sensor, settings);

  std::array<int, kBins> count{};
  std::array<double, kBins> depth_sum{};
  for (int column = 0; column < image.columns; ++column) {
    for (int row = 1; row < rows.count(); ++row) {
      const std::int32_t below = image.pixel(rows[row - 1], column);
      const std::int32_t index = image.pixel(rows[row], column);
      if (below < 0 || index < 0) continue;
      const LevelPoint a = level_point(image.points[below]);
      const LevelPoint b = level_point(image.points[index]);
      if (b.distance > kRadius || b.z >= 0.0f || !is_level(a, b, max_tangent)) continue;
      const int bin = static_cast<int>(-b.z / kBin);
      if (bin >= kBins) continue;
      ++count[bin];
      depth_sum[bin] += -b.z;
    }
  }
  const int best = static_cast<int>(std::max_element(count.begin(), count.end()) - count.begin());
  if (count[best] < kMinPoints) return std::nullopt;
  // The peak may straddle two bins.
  double sum = 0.0;
  int points = 0;
  for (int bin = std::max(best - 1, 0); bin <= std::min(best + 1, kBins - 1); ++bin) {
    sum += depth_sum[bin];
    points += count[bin];
  }
  return sum / points;
}

}  // namespace lego_loam_sc
