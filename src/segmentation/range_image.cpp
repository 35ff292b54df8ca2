// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/range_image.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <span>

#include "core/azimuth.hpp"
#include "core/pose.hpp"
#include "sensor/row_assignment.hpp"

namespace lego_loam_sc {
namespace {

std::vector<float> ranges(const Scan& scan) {
  std::vector<float> range(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i) range[i] = scan.points[i].norm();
  return range;
}

// NaN and infinity fail the comparisons.
std::vector<std::uint8_t> usable_points(const std::vector<float>& range,
                                        const SensorModel& sensor) {
  const auto nearest =
      std::max(static_cast<float>(sensor.min_range), std::numeric_limits<float>::denorm_min());
  const auto farthest = static_cast<float>(sensor.max_range);
  std::vector<std::uint8_t> usable(range.size());
  for (std::size_t i = 0; i < range.size(); ++i)
    usable[i] = range[i] >= nearest && range[i] <= farthest;
  return usable;
}

std::vector<float> azimuths(const Scan& scan) {
  std::vector<float> azimuth(scan.size());
  for (std::size_t i = 0; i < scan.size(); ++i)
    azimuth[i] = fast_atan2(scan.points[i].y(), scan.points[i].x());
  return azimuth;
}

// Adds a small angle to the elevation of the points of a row at constant range (elevation bias, see
// docs/sensors.md). Using the nominal elevation of the row instead of the point's own saves root
// and division; the error is 1e-5 of the range.
class ElevationCorrection {
 public:
  ElevationCorrection(double elevation, double angle)
      : along_(static_cast<float>(std::cos(elevation + angle) / std::cos(elevation))),
        up_(static_cast<float>(std::sin(elevation + angle) - std::sin(elevation))) {}

  Eigen::Vector3f operator()(const Eigen::Vector3f& p, float range) const {
    return {p.x() * along_, p.y() * along_, p.z() + range * up_};
  }

 private:
  float along_;
  float up_;
};

// Seconds from the start of the sweep until the sensor measures at `azimuth`.
float time_of_azimuth(float azimuth, const SensorModel& sensor) {
  const auto start = static_cast<float>(radians(sensor.start_azimuth_deg));
  const float turned = sensor.clockwise ? start - azimuth : azimuth - start;
  const float turns = turned / (2.0f * std::numbers::pi_v<float>);
  return (turns - std::floor(turns)) * static_cast<float>(sensor.period);
}

// The column of each point, kNone for dropped points. A point exactly behind the sensor has azimuth
// -pi and lies in the first column.
constexpr std::uint16_t kNone = 0xffff;
std::vector<std::uint16_t> columns_of_points(const std::vector<std::uint8_t>& usable,
                                             const std::vector<std::int16_t>& row, int columns,
                                             std::vector<float>& azimuth) {
  std::vector<std::uint16_t> result(azimuth.size(), kNone);
  const float columns_per_radian = columns / (2.0f * std::numbers::pi_v<float>);
  for (std::size_t i = 0; i < azimuth.size(); ++i) {
    if (!usable[i] || row[i] < 0) continue;
    const auto column =
        static_cast<int>((azimuth[i] + std::numbers::pi_v<float>)*columns_per_radian);
    if (column >= columns) azimuth[i] = -std::numbers::pi_v<float>;
    result[i] = static_cast<std::uint16_t>(column < columns ? column : 0);
  }
  return result;
}

struct Direction {
  float azimuth;
  std::uint32_t point;  // of the scan

  bool operator<(const Direction& other) const {
    return azimuth < other.azimuth || (azimuth == other.azimuth && point < other.point);
  }
};

// The sensor turns one way, so apart from the start of the sweep and a few swapped points a row is
// already sorted in ascending or descending order.
void sort_row(std::span<Direction> row) {
  if (row.size() < 2) return;
  std::size_t falling = 0;
  for (std::size_t k = 1; k < row.size(); ++k) falling += row[k] < row[k - 1];
  if (2 * falling > row.size()) std::ranges::reverse(row);
  const auto seam = std::ranges::adjacent_find(row, [](const Direction& a, const Direction& b) {
    return b.azimuth < a.azimuth - std::numbers::pi_v<float>;
  });
  if (seam != row.end()) std::ranges::rotate(row, seam + 1);
  // Insertion sort, which is the fastest as long as few points are out of order.
  std::size_t moves = 0;
  for (std::size_t k = 1; k < row.size(); ++k) {
    const Direction direction = row[k];
    std::size_t place = k;
    for (; place > 0 && direction < row[place - 1]; --place) row[place] = row[place - 1];
    row[place] = direction;
    moves += k - place;
    if (moves > 8 * row.size()) {
      std::sort(row.begin(), row.end());
      return;
    }
  }
}

// The index in the image of each point that has a column: sorted by row, then azimuth. Fills
// `row_begin`.
std::vector<std::uint32_t> sort_points(const std::vector<std::uint16_t>& column,
                                       const std::vector<std::int16_t>& row,
                                       const std::vector<float>& azimuth, RangeImage& image) {
  image.row_begin.assign(image.rows + 1, 0);
  for (std::size_t i = 0; i < column.size(); ++i)
    if (column[i] != kNone) ++image.row_begin[row[i] + 1];
  std::partial_sum(image.row_begin.begin(), image.row_begin.end(), image.row_begin.begin());
  std::vector<std::uint32_t> end = image.row_begin;
  std::vector<Direction> order(image.row_begin.back());
  for (std::size_t i = 0; i < column.size(); ++i)
    if (column[i] != kNone) order[end[row[i]]++] = {azimuth[i], static_cast<std::uint32_t>(i)};

  std::vector<std::uint32_t> place(column.size());
  for (int r = 0; r < image.rows; ++r)
    sort_row(std::span(order).subspan(image.row_begin[r], end[r] - image.row_begin[r]));
  for (std::size_t k = 0; k < order.size(); ++k)
    place[order[k].point] = static_cast<std::uint32_t>(k);
  return place;
}

// The time of each point after the middle of the sweep, s; empty when the points have no times or
// are motion compensated. Fills `stamp_ns` and `reference_ns`.
std::vector<float> point_times(const Scan& scan, const std::vector<std::uint16_t>& column,
                               const std::vector<float>& azimuth, const SensorModel& sensor,
                               RangeImage& image) {
  image.stamp_ns = image.reference_ns = scan.stamp_ns;
  std::vector<float> time;
  if (sensor.motion_compensated || image.row_begin.back() == 0) return time;
  auto first = std::numeric_limits<std::int64_t>::max();
  auto last = std::numeric_limits<std::int64_t>::min();
  if (!scan.offset_ns.empty()) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if (column[i] == kNone) continue;
      first = std::min<std::int64_t>(first, scan.offset_ns[i]);
      last = std::max<std::int64_t>(last, scan.offset_ns[i]);
    }
  }
  if (first < last) {  // offsets that are all the same are no times
    const std::int64_t middle = first + (last - first) / 2;
    image.reference_ns += middle;
    time.resize(column.size());
    for (std::size_t i = 0; i < time.size(); ++i)
      time[i] = static_cast<float>(1e-9 * static_cast<double>(scan.offset_ns[i] - middle));
  } else if (sensor.times_from_azimuth) {
    image.reference_ns += std::llround(0.5e9 * sensor.period);
    time.resize(column.size());
    for (std::size_t i = 0; i < time.size(); ++i)
      time[i] = time_of_azimuth(azimuth[i], sensor) - 0.5f * static_cast<float>(sensor.period);
  }
  return time;
}

// The median of the columns from one point of a row to the next.
int column_step(const RangeImage& image) {
  std::vector<int> steps(image.columns + 1, 0);  // histogram
  int count = 0;
  for (int row = 0; row < image.rows; ++row) {
    for (std::uint32_t i = image.row_begin[row] + 1; i < image.row_begin[row + 1]; ++i, ++count)
      ++steps[image.column[i] - image.column[i - 1]];
  }
  int step = 0;
  for (int narrower = steps[0]; 2 * narrower < count; narrower += steps[step]) ++step;
  return std::max(step, 1);
}

}  // namespace

void fill_pixels(RangeImage& image) {
  image.pixels.assign(static_cast<std::size_t>(image.rows) * image.columns, -1);
  for (int row = 0; row < image.rows; ++row) {
    std::int32_t* pixels = image.pixels.data() + static_cast<std::size_t>(row) * image.columns;
    for (std::uint32_t k = image.row_begin[row]; k < image.row_begin[row + 1]; ++k) {
      std::int32_t& nearest = pixels[image.column[k]];
      if (nearest < 0 || image.range[k] < image.range[nearest])
        nearest = static_cast<std::int32_t>(k);
    }
  }
}

RangeImage project(const Scan& scan, const SensorModel& sensor) {
  const std::vector<float> range = ranges(scan);
  const std::vector<std::uint8_t> usable = usable_points(range, sensor);
  const std::vector<std::int16_t> row = assign_rows(scan, usable, sensor);
  std::vector<float> azimuth = azimuths(scan);
  const std::vector<std::uint16_t> column = columns_of_points(usable, row, sensor.columns, azimuth);

  RangeImage image;
  image.rows = sensor.rows();
  image.columns = sensor.columns;
  const std::vector<std::uint32_t> place = sort_points(column, row, azimuth, image);
  const std::vector<float> time = point_times(scan, column, azimuth, sensor, image);

  const std::size_t count = image.row_begin.back();
  image.points.resize(count);
  image.range.resize(count);
  image.intensity.resize(count);
  image.time.resize(count);
  image.column.resize(count);

  std::vector<ElevationCorrection> correct;
  for (int r = 0; r < image.rows; ++r)
    correct.emplace_back(radians(sensor.elevation_deg[r]),
                         radians(sensor.elevation_correction_deg));
  const Eigen::Matrix3f R_level_lidar = R_base_lidar(sensor).cast<float>();
  const bool tilted = sensor.tilted();
  const bool intensities = !scan.intensity.empty();
  // In the order of the scan: the sensor cycles through its rows, so each row is written in order.
  for (std::size_t i = 0; i < column.size(); ++i) {
    if (column[i] == kNone) continue;
    const std::uint32_t k = place[i];
    const Eigen::Vector3f point = correct[row[i]](scan.points[i], range[i]);
    image.points[k] = tilted ? R_level_lidar * point : point;
    image.range[k] = range[i];
    image.column[k] = column[i];
    if (intensities) image.intensity[k] = scan.intensity[i];
    if (!time.empty()) image.time[k] = time[i];
  }
  fill_pixels(image);
  image.column_step = column_step(image);
  return image;
}

}  // namespace lego_loam_sc
