// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "core/scan.hpp"

// What the fuzz targets share. Each gives the bytes that libFuzzer makes to one reader: it may
// throw InputError with a sentence, and what it accepts must hold together. All else ends the
// program.

namespace lego_loam_sc {

inline void require(bool holds) {
  if (!holds) std::abort();
}

/// The bytes as text.
inline std::string text_of(const unsigned char* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// Calls `read`; InputError is an answer.
template <class Read>
void read_or_refuse(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    require(error.what()[0] != '\0');
  }
}

/// The optional arrays of a scan are empty or have one entry for each point.
inline void require_whole(const Scan& scan) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == scan.size(); };
  require(fits(scan.intensity.size()) && fits(scan.ring.size()) && fits(scan.offset_ns.size()));
}

}  // namespace lego_loam_sc

extern "C" int LLVMFuzzerTestOneInput(const unsigned char* data, std::size_t size);
