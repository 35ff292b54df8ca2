// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <bit>
#include <cstring>
#include <string>

namespace lego_loam_sc {

static_assert(std::endian::native == std::endian::little, "files are written in memory byte order");

/// The value at `bytes`, which need not be aligned.
/// @{
template <class T>
T load(const char* bytes) {
  T value;
  std::memcpy(static_cast<void*>(&value), bytes, sizeof(T));
  return value;
}

template <class T>
T load_big_endian(const char* bytes) {
  char reversed[sizeof(T)];
  std::reverse_copy(bytes, bytes + sizeof(T), reversed);
  return load<T>(reversed);
}
/// @}

/// Appends the bytes of `value`.
template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

}  // namespace lego_loam_sc
