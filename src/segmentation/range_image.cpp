// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "core/pose.hpp"
#include "segmentation/azimuth.hpp"
#include "segmentation/row_assignment.hpp"

namespace lego_loam_sc {
namespace {

std::vector<std::uint8_t> usable_points(const Scan& scan, const SensorModel& sensor) {
  const float nearest = static_cast<float>(sensor.min_range * sensor.min_range);
  const float farthest = static_cast<float>(sensor.max_range * sensor.max_range);
  std::vector<std::uint8_t> usable(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) {
    const float squared = scan.points[i].squaredNorm();  // NaN and infinity fail both comparisons
    usable[i] = squared >= nearest && squared <= farthest && squared > 0.0f;
  }
  return usable;
}

// Adds a small angle to the elevation of the points of a row, which keep their range. Elevation
// bias of KITTI's scans: see docs/sensors.md. All points of a row lie at nearly the row's own
// elevation: with that a point takes no root and no division, and is off by a hundred thousandth of
// its range.
class Raise {
 public:
  Raise(double elevation, double angle)
      : along_(static_cast<float>(std::cos(elevation + angle) / std::cos(elevation))),
        up_(static_cast<float>(std::sin(elevation + angle) - std::sin(elevation))) {}

  Eigen::Vector3f operator()(const Eigen::Vector3f& p, float range) const {
    return {p.x() * along_, p.y() * along_, p.z() + range * up_};
  }

 private:
  float along_;
  float up_;
};

// Seconds between the start of the sweep and the time when the sensor looked at `azimuth`.
float time_of_azimuth(float azimuth, const SensorModel& sensor) {
  const float start = static_cast<float>(radians(sensor.start_azimuth_deg));
  const float turned = sensor.clockwise ? start - azimuth : azimuth - start;
  const float turns = turned / (2.0f * std::numbers::pi_v<float>);
  return (turns - std::floor(turns)) * static_cast<float>(sensor.period);
}

// Fills `age` and `reference_ns`; `source` is the scan's index of each point of the image.
void assign_times(const Scan& scan, const std::vector<std::uint32_t>& source,
                  const std::vector<float>& azimuth, const SensorModel& sensor, RangeImage& image) {
  image.stamp_ns = image.reference_ns = scan.stamp_ns;
  image.age.assign(source.size(), 0.0f);
  if (sensor.motion_compensated || source.empty()) return;
  if (!scan.offset_ns.empty()) {
    std::int64_t first = scan.offset_ns[source.front()];
    std::int64_t last = first;
    for (const std::uint32_t i : source) {
      first = std::min<std::int64_t>(first, scan.offset_ns[i]);
      last = std::max<std::int64_t>(last, scan.offset_ns[i]);
    }
    const std::int64_t middle = first + (last - first) / 2;
    image.reference_ns += middle;
    for (std::size_t k = 0; k < source.size(); ++k)
      image.age[k] =
          static_cast<float>(1e-9 * static_cast<double>(scan.offset_ns[source[k]] - middle));
  } else if (sensor.times_from_azimuth) {
    image.reference_ns += std::llround(0.5e9 * sensor.period);
    for (std::size_t k = 0; k < source.size(); ++k)
      image.age[k] =
          time_of_azimuth(azimuth[source[k]], sensor) - 0.5f * static_cast<float>(sensor.period);
  }
}

}  // namespace

RangeImage project(const Scan& scan, const SensorModel& sensor) {
  const std::vector<std::uint8_t> usable = usable_points(scan, sensor);
  const std::vector<std::int16_t> row = assign_rows(scan, usable, sensor);
  std::vector<float> azimuth(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i)
    azimuth[i] = fast_atan2(scan.points[i].y(), scan.points[i].x());

  RangeImage image;
  image.rows = sensor.rows();
  image.columns = sensor.columns;
  const std::size_t pixels = static_cast<std::size_t>(image.rows) * image.columns;

  // Counting sort by pixel. The counts stand two places up: their sums are the beginnings of the
  // pixels one place up, and placing the points moves each to the end of its pixel.
  std::vector<std::uint32_t> pixel(scan.size());
  std::vector<std::uint32_t> begin(pixels + 2, 0);
  const float columns_per_radian = image.columns / (2.0f * std::numbers::pi_v<float>);
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!usable[i] || row[i] < 0) continue;
    int column = static_cast<int>((azimuth[i] + std::numbers::pi_v<float>)*columns_per_radian);
    if (column >= image.columns) column -= image.columns;
    pixel[i] = static_cast<std::uint32_t>(row[i]) * image.columns + column;
    ++begin[pixel[i] + 2];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<std::uint32_t> source(begin.back());
  for (std::size_t i = 0; i < scan.size(); ++i)
    if (usable[i] && row[i] >= 0) source[begin[pixel[i] + 1]++] = static_cast<std::uint32_t>(i);

  const std::size_t count = source.size();
  image.points.resize(count);
  image.range.resize(count);
  image.intensity.assign(count, 0.0f);
  image.column.resize(count);
  image.pixels.assign(pixels, -1);
  image.row_begin.resize(image.rows + 1);
  for (int r = 0; r <= image.rows; ++r)
    image.row_begin[r] = begin[static_cast<std::size_t>(r) * image.columns];

  const Eigen::Matrix3f R_level_lidar = R_base_lidar(sensor).cast<float>();
  const auto by_azimuth = [&](std::uint32_t a, std::uint32_t b) {
    return std::pair(azimuth[a], a) < std::pair(azimuth[b], b);
  };
  for (int r = 0; r < image.rows; ++r) {
    const Raise raise(radians(sensor.elevation_deg[r]), radians(sensor.elevation_correction_of(r)));
    for (int c = 0; c < image.columns; ++c) {
      const std::size_t p = static_cast<std::size_t>(r) * image.columns + c;
      if (begin[p + 1] - begin[p] > 1)
        std::sort(source.begin() + begin[p], source.begin() + begin[p + 1], by_azimuth);
      std::int32_t nearest = -1;
      for (std::uint32_t k = begin[p]; k < begin[p + 1]; ++k) {
        const Eigen::Vector3f& point = scan.points[source[k]];
        image.range[k] = point.norm();
        image.points[k] = raise(point, image.range[k]);
        if (sensor.tilted()) image.points[k] = R_level_lidar * image.points[k];
        image.column[k] = static_cast<std::uint16_t>(c);
        if (!scan.intensity.empty()) image.intensity[k] = scan.intensity[source[k]];
        if (nearest < 0 || image.range[k] < image.range[nearest])
          nearest = static_cast<std::int32_t>(k);
      }
      image.pixels[p] = nearest;
    }
  }
  assign_times(scan, source, azimuth, sensor, image);
  return image;
}

}  // namespace lego_loam_sc
