// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/ground_profile.hpp"

#include <Eigen/Cholesky>
#include <cmath>
#include <cstddef>
#include <vector>

namespace lego_loam_sc {
namespace {

// A strip ahead and behind: roads are crowned and have kerbs, which look like a cone sideways.
constexpr float kHalfWidth = 1.2f;  // m
constexpr float kNearest = 3.0f;    // m
constexpr float kFarthest = 25.0f;
constexpr int kMinPoints = 4;           // in a row
constexpr double kMaxRoughness = 0.04;  // m, standard deviation in a row
// From row to row outwards the ground rises by no more than this slope and offset (m); what does
// is a kerb or a vehicle, and hides the ground behind it.
constexpr double kMaxSlope = 0.05;
constexpr double kMaxStep = 0.01;
constexpr double kMinGap = 0.3;  // m from row to row; rows in between add nothing
constexpr std::size_t kMinRows = 6;
constexpr std::size_t kMinRowsOfSide = 2;

constexpr double kSigma = 0.015;     // m, of a row's height
constexpr double kCurvature = 5e-4;  // 1/m, one sigma of a road's own
constexpr double kKernel = 2.0;      // scale of Cauchy's kernel, sigmas
constexpr int kReweightings = 5;

struct RowHeight {
  double x;  // m
  double z;
};

std::optional<RowHeight> height_of_row(const RangeImage& image, const Segmentation& segmentation,
                                       int row, float side) {
  double n = 0.0, x = 0.0, z = 0.0, zz = 0.0;
  for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
    const Eigen::Vector3f& p = image.points[i];
    const float ahead = side * p.x();
    if (segmentation.label[i] != Label::ground || std::abs(p.y()) > kHalfWidth ||
        ahead < kNearest || ahead > kFarthest)
      continue;
    n += 1.0;
    x += p.x();
    z += p.z();
    zz += static_cast<double>(p.z()) * p.z();
  }
  if (n < kMinPoints) return std::nullopt;
  x /= n;
  z /= n;
  if (zz / n - z * z > kMaxRoughness * kMaxRoughness) return std::nullopt;
  return RowHeight{x, z};
}

// Outwards as far as the ground goes on without a step.
std::vector<RowHeight> profile_of_side(const RangeImage& image, const Segmentation& segmentation,
                                       float side) {
  std::vector<RowHeight> profile;
  for (int row = 0; row < image.rows; ++row) {
    const std::optional<RowHeight> next = height_of_row(image, segmentation, row, side);
    if (!next) continue;
    if (!profile.empty()) {
      const double gap = std::abs(next->x) - std::abs(profile.back().x);
      if (gap < kMinGap) continue;
      if (std::abs(next->z - profile.back().z) > kMaxSlope * gap + kMaxStep) break;
    }
    profile.push_back(*next);
  }
  return profile;
}

}  // namespace

std::optional<double> cone_of_ground(const RangeImage& image, const Segmentation& segmentation) {
  std::vector<RowHeight> profile = profile_of_side(image, segmentation, 1.0f);
  const std::vector<RowHeight> behind = profile_of_side(image, segmentation, -1.0f);
  if (profile.size() < kMinRowsOfSide || behind.size() < kMinRowsOfSide ||
      profile.size() + behind.size() < kMinRows)
    return std::nullopt;
  profile.insert(profile.end(), behind.begin(), behind.end());

  // z = height + slope x + cone |x| + curvature x^2 / 2.
  std::vector<double> weight(profile.size(), 1.0);
  Eigen::Vector4d solution = Eigen::Vector4d::Zero();
  for (int k = 0; k < kReweightings; ++k) {
    Eigen::Matrix4d H = Eigen::Matrix4d::Zero();
    Eigen::Vector4d g = Eigen::Vector4d::Zero();
    H(3, 3) = std::pow(kSigma / kCurvature, 2);
    const auto row_of = [](const RowHeight& p) {
      return Eigen::Vector4d(1.0, p.x, std::abs(p.x), 0.5 * p.x * p.x);
    };
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const Eigen::Vector4d row = row_of(profile[i]);
      H += weight[i] * row * row.transpose();
      g += weight[i] * profile[i].z * row;
    }
    solution = H.ldlt().solve(g);
    for (std::size_t i = 0; i < profile.size(); ++i) {
      const double e = (profile[i].z - row_of(profile[i]).dot(solution)) / (kKernel * kSigma);
      weight[i] = 1.0 / (1.0 + e * e);
    }
  }
  if (!std::isfinite(solution[2])) return std::nullopt;
  return -std::atan(solution[2]);
}

}  // namespace lego_loam_sc
