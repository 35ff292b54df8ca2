// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>

namespace lego_loam_sc {

/// Height of the ground (m) at a place of the world (m). Its slope is continuous.
using Ground = std::function<double(double x, double y)>;

}  // namespace lego_loam_sc
