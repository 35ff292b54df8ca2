// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <lego_loam_sc/core/scan.hpp>
#include <lego_loam_sc/core/time.hpp>
#include <optional>

#include "arrays.hpp"

namespace lego_loam_sc::python {

// Throws std::invalid_argument when the arrays do not fit together or a number is out of range.
Scan make_scan(const Points& points, double stamp, const std::optional<Numbers<double>>& offsets,
               const std::optional<Numbers<std::int64_t>>& rings,
               const std::optional<Numbers<float>>& intensity);

std::vector<Eigen::Vector3f> to_points(const Points& points);

}  // namespace lego_loam_sc::python
