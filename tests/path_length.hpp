// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include "sim/motion.hpp"

namespace lego_loam_sc {

constexpr std::int64_t second = 1'000'000'000;

// Of a whole motion, m, by its places every 0.1 s.
inline double path_length(const Motion& motion) {
  double length = 0.0;
  for (std::int64_t t = 0; t < motion.duration_ns; t += second / 10)
    length += (motion.pose(t + second / 10).translation() - motion.pose(t).translation()).norm();
  return length;
}

}  // namespace lego_loam_sc
