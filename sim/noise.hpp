// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace lego_loam_sc {

/// Smooth noise in space, between -1 and 1, with features of about size 1. Twice differentiable and
/// determined by the seed.
double smooth_noise(const Eigen::Vector3d& place, std::uint64_t seed);

}  // namespace lego_loam_sc
