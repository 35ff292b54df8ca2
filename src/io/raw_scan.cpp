// SPDX-License-Identifier: BSD-3-Clause
#include "io/raw_scan.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/bytes.hpp"

namespace lego_loam_sc {
namespace {

// Field names of ROS, PCL and the drivers of Velodyne, Ouster, Hesai, RoboSense and Livox; the
// first that the file has is used.
constexpr std::array<std::string_view, 3> kIntensityNames = {"intensity", "reflectivity", "i"};
constexpr std::array<std::string_view, 4> kRingNames = {"ring", "line", "channel", "laser_id"};
constexpr std::array<std::string_view, 6> kTimeNames = {"t",           "time",       "timestamp",
                                                        "offset_time", "time_stamp", "timeOffset"};

template <std::size_t N>
const Column* find(std::span<const Column> columns, const std::array<std::string_view, N>& names) {
  for (const std::string_view name : names)
    for (const Column& column : columns)
      if (column.name == name) return &column;
  return nullptr;
}

// Calls set(i, value) for each number, with one loop per type.
template <class T, class Set>
void for_each_number(const Column& column, std::size_t count, Set&& set) {
  const char* at = column.data;
  if (column.big_endian) {
    for (std::size_t i = 0; i < count; ++i, at += column.stride) set(i, load_big_endian<T>(at));
  } else {
    for (std::size_t i = 0; i < count; ++i, at += column.stride) set(i, load<T>(at));
  }
}

template <class Set>
void for_each(const Column& column, std::size_t count, Set&& set) {
  switch (column.stored) {
    case NumberType::int8: return for_each_number<std::int8_t>(column, count, set);
    case NumberType::uint8: return for_each_number<std::uint8_t>(column, count, set);
    case NumberType::int16: return for_each_number<std::int16_t>(column, count, set);
    case NumberType::uint16: return for_each_number<std::uint16_t>(column, count, set);
    case NumberType::int32: return for_each_number<std::int32_t>(column, count, set);
    case NumberType::uint32: return for_each_number<std::uint32_t>(column, count, set);
    case NumberType::int64: return for_each_number<std::int64_t>(column, count, set);
    case NumberType::uint64: return for_each_number<std::uint64_t>(column, count, set);
    case NumberType::float32: return for_each_number<float>(column, count, set);
    case NumberType::float64: return for_each_number<double>(column, count, set);
  }
}

}  // namespace

RawScan assemble(std::span<const Column> columns, std::size_t count, const std::string& file) {
  RawScan raw;
  Scan& scan = raw.scan;
  scan.points.resize(count);
  for (int axis = 0; axis < 3; ++axis) {
    constexpr std::array<std::string_view, 3> kAxes = {"x", "y", "z"};
    const Column* column = find(columns, std::array{kAxes[axis]});
    if (!column)
      throw InputError(file + " has no field " + std::string(kAxes[axis]) +
                       "; a scan needs x, y and z");
    for_each(*column, count,
             [&](std::size_t i, auto value) { scan.points[i][axis] = static_cast<float>(value); });
  }
  if (const Column* intensity = find(columns, kIntensityNames)) {
    scan.intensity.resize(count);
    for_each(*intensity, count,
             [&](std::size_t i, auto value) { scan.intensity[i] = static_cast<float>(value); });
  }
  if (const Column* ring = find(columns, kRingNames)) {
    scan.ring.resize(count);
    for_each(*ring, count, [&](std::size_t i, auto value) {
      const auto number = static_cast<double>(value);
      if (!(number >= 0.0 && number <= std::numeric_limits<std::uint16_t>::max()))
        throw InputError(file + ": field " + ring->name + " of point " + std::to_string(i) +
                         " is " + to_text(number) + ", a ring is between 0 and 65535");
      scan.ring[i] = static_cast<std::uint16_t>(number);
    });
  }
  if (const Column* time = find(columns, kTimeNames)) {
    raw.time.resize(count);
    raw.time_type = time->declared;
    for_each(*time, count, [&](std::size_t i, auto value) {
      // The time of a point without return is undefined.
      raw.time[i] = is_return(scan.points[i]) ? static_cast<double>(value)
                                              : std::numeric_limits<double>::quiet_NaN();
    });
  }
  return raw;
}

std::vector<double> take_numbers(std::string_view& rest, std::size_t count, std::size_t width,
                                 const std::string& file) {
  // Every number but the last takes at least two bytes, including white space.
  if (count > (rest.size() + 1) / 2 / width)
    throw InputError(file + ": the header declares " + std::to_string(count) +
                     " points, the data is too short for them");
  std::vector<double> numbers(std::max<std::size_t>(count, 1) * width);
  for (std::size_t i = 0; i < count * width; ++i) {
    const std::string_view word = take_word(rest);
    const auto value = parse_double(word);
    if (!value)
      throw InputError(
          file + ": point " + std::to_string(i / width) + " of " + std::to_string(count) +
          (word.empty() ? " is missing; the file is truncated"
                        : ": \"" + std::string(word.substr(0, 40)) + "\" is not a number"));
    numbers[i] = *value;
  }
  return numbers;
}

}  // namespace lego_loam_sc
