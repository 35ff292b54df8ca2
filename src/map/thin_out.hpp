// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "features/features.hpp"

namespace lego_loam_sc {

/// The sets of maps, each with one point for each voxel of `spacing` m (0 = all).
Features thin_out(const Features& features, double spacing);

}  // namespace lego_loam_sc
