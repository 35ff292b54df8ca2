// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <vector>

namespace lego_loam_sc {

// Binary little-endian files of points x y z (m) and intensity, all float32. They replace an old
// file at once and throw InputError when that fails.

void write_ply(const std::filesystem::path& path, const std::vector<Eigen::Vector4f>& points);
void write_pcd(const std::filesystem::path& path, const std::vector<Eigen::Vector4f>& points);

}  // namespace lego_loam_sc
