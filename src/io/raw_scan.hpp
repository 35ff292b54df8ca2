// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/scan.hpp"

namespace lego_loam_sc {

enum class NumberType {
  int8,
  uint8,
  int16,
  uint16,
  int32,
  uint32,
  int64,
  uint64,
  float32,
  float64
};

constexpr std::size_t size_of(NumberType type) {
  switch (type) {
    case NumberType::int8:
    case NumberType::uint8: return 1;
    case NumberType::int16:
    case NumberType::uint16: return 2;
    case NumberType::int32:
    case NumberType::uint32:
    case NumberType::float32: return 4;
    default: return 8;
  }
}

/// A field of a point file in memory: one number per point, `stride` bytes apart.
struct Column {
  std::string name;
  NumberType declared;  ///< type in the file's header
  NumberType stored;    ///< type in memory
  const char* data;
  std::size_t stride;
  bool big_endian = false;
};

/// The content of a PCD or PLY file. Its times are not interpreted yet, see point_times.hpp.
struct RawScan {
  Scan scan;                 ///< without stamp and offsets
  std::vector<double> time;  ///< one per point, NaN for points without return; may be empty
  NumberType time_type = NumberType::float64;
};

/// Extracts position, intensity, ring and time of `count` points by the field names that drivers
/// use. Throws InputError, which names `file`, when x, y or z is missing or a ring is out of range.
RawScan assemble(std::span<const Column> columns, std::size_t count, const std::string& file);

/// Parses `count` points of `width` (not 0) numbers from the front of `rest`; returns at least one
/// row, so that each column has an address. Throws InputError, which names `file`, when there are
/// fewer. Checks `count` against the length of `rest` before it allocates memory.
std::vector<double> take_numbers(std::string_view& rest, std::size_t count, std::size_t width,
                                 const std::string& file);

}  // namespace lego_loam_sc
