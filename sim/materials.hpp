// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

// Reflectivities of common materials, 0 to 1.

constexpr double kAsphalt = 0.2;
constexpr double kConcrete = 0.35;
constexpr double kGlass = 0.0005;  ///< specular: almost nothing returns
constexpr double kSteel = 0.4;

}  // namespace lego_loam_sc
