// SPDX-License-Identifier: BSD-3-Clause
#include "segmentation/body_mask.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/pose.hpp"

namespace lego_loam_sc {
namespace {

// Pixels that the motion is found from, about.
constexpr int kSamples = 4000;
// A normal is that of neighbours this far to either side, m, or this many columns.
constexpr double kReach = 0.2;
constexpr int kMaxReach = 8;
// Error of the normal, rad: roughness and noise over the reach.
constexpr double kNormalError = 0.1;
// Sigmas: what is no change, and what is one.
constexpr double kUnchanged = 3.0;
constexpr double kChanged = 4.0;
// The sensor has moved when so many pixels changed. With fewer of them the largest errors of the
// range pass for a motion.
constexpr int kLeastChanged = 60;
constexpr double kLeastChangedShare = 0.1;
// A motion explains this share of the changes.
constexpr double kLeastAgreeing = 0.5;
constexpr int kIterations = 8;
// Prior of the motion since the reference: m and rad.
constexpr double kMotionSigma = 3.0;
constexpr double kTurnSigma = 0.3;
// There is a body when this share of the pixels that a motion must have changed did not, and more
// of them than change by chance to any other narrow band of ranges. Some must have changed.
constexpr double kLeastBody = 0.15;
constexpr double kLeastWorld = 0.1;
constexpr int kLeastBodyPixels = 30;
constexpr double kOverChance = 3.0;
// After so many comparisons without a body, two scans of every so many are compared.
constexpr int kEnough = 20;
constexpr int kPause = 10;
// Scans after which a reference is too old.
constexpr int kOldest = 20;
constexpr int kMostVotes = 20;
// A pixel is masked by two comparisons, or by one in which this many times more pixels stayed than
// changed: the motion of a single one may be wrong where little holds it.
constexpr int kLeastVotes = 2;
constexpr double kOverwhelming = 2.0;
// The share of the body that its range stands for: a few pixels may be taken for it by mistake.
constexpr double kMost = 0.95;

std::vector<float> ranges_of_pixels(const RangeImage& image) {
  std::vector<float> range(image.pixels.size(), 0.0F);
  for (std::size_t k = 0; k < range.size(); ++k)
    if (image.pixels[k] >= 0) range[k] = image.range[image.pixels[k]];
  return range;
}

}  // namespace

BodyMask::BodyMask(const SensorModel& sensor)
    : rows_(sensor.rows()),
      columns_(sensor.columns),
      noise_(static_cast<float>(std::max(sensor.range_noise, 0.01))) {
  for (const double elevation : sensor.elevation_deg) elevation_.push_back(radians(elevation));
  for (int column = 0; column < columns_; ++column)
    azimuth_.push_back((column + 0.5) * 2.0 * std::numbers::pi / columns_ - std::numbers::pi);
}

Eigen::Vector3d BodyMask::direction(std::size_t pixel) const {
  const double elevation = elevation_[pixel / columns_];
  const double azimuth = azimuth_[pixel % columns_];
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

// The range flow of a pixel whose neighbours in the reference lie on a plane: for a fixed plane
// with normal n (away from the sensor) along the beam u, n.v + r2 (u x n).w = (r1 - r2) n.u.
bool BodyMask::flow_at(int row, int column, const std::vector<float>& range, Flow& flow) const {
  const auto at = [&](int r, int c) {
    return static_cast<std::size_t>(r) * columns_ + (c + columns_) % columns_;
  };
  const std::size_t here = at(row, column);
  const double r1 = reference_[here];
  const double r2 = range[here];
  if (r1 == 0.0 || r2 == 0.0) return false;
  const double spacing = r1 * 2.0 * std::numbers::pi / columns_;
  const int reach = std::clamp(static_cast<int>(std::ceil(kReach / spacing)), 1, kMaxReach);
  const std::size_t left = at(row, column + reach);
  const std::size_t right = at(row, column - reach);
  // The rows next to it, one to each side where there are two.
  const int row_reach = rows_ < 32 ? 1 : 2;
  const int upper = std::min(row + row_reach, rows_ - 1);
  const int lower = std::max(row - row_reach, 0);
  const std::size_t up = at(upper, column);
  const std::size_t down = at(lower, column);
  for (const std::size_t neighbour : {left, right, up, down})
    if (reference_[neighbour] == 0.0F) return false;
  const auto point = [&](std::size_t pixel) {
    return Eigen::Vector3d(static_cast<double>(reference_[pixel]) * direction(pixel));
  };
  const Eigen::Vector3d across = point(left) - point(right);
  const Eigen::Vector3d along = point(up) - point(down);
  Eigen::Vector3d n = across.cross(along);
  const double area = n.norm();
  if (!(area > 0.0)) return false;
  n /= area;
  const Eigen::Vector3d u = direction(here);
  double facing = n.dot(u);
  if (facing < 0.0) {
    n = -n;
    facing = -facing;
  }
  if (facing < 0.1) return false;
  const Eigen::Vector3d p = r1 * u;
  const double flat = 4.0 * noise_ + 0.01 * r1;
  for (const std::size_t neighbour : {left, up})  // the opposite ones follow
    if (std::abs(n.dot(point(neighbour) - p)) > flat) return false;
  flow.row << n, r2 * u.cross(n);
  flow.change = (r1 - r2) * facing;
  // A pixel is not always looked through at the same azimuth.
  const double jitter = 0.3 * spacing * std::sqrt(std::max(0.0, 1.0 - facing * facing));
  flow.sigma = std::hypot(std::numbers::sqrt2 * noise_ * facing, jitter);
  return true;
}

bool BodyMask::has_changed(const Flow& flow) {
  return std::abs(flow.change) > kChanged * flow.sigma;
}

BodyMask::Kind BodyMask::kind_of(const Flow& flow, const Motion& motion) {
  const double expected = flow.row.dot(motion.mean);
  const double doubt = std::hypot(kNormalError * motion.mean.head<3>().norm(),
                                  std::sqrt(flow.row.dot(motion.covariance * flow.row)));
  if (std::abs(flow.change) < kUnchanged * flow.sigma)
    return std::abs(expected) > 2.0 * kChanged * flow.sigma + kUnchanged * doubt ? Kind::body
                                                                                 : Kind::neutral;
  const bool agrees = std::abs(flow.change - expected) < kUnchanged * (flow.sigma + doubt);
  return agrees && has_changed(flow) ? Kind::world : Kind::other;
}

// By robust least squares from the pixels that changed. False when these do not agree on one.
bool BodyMask::find_motion(const std::vector<Flow>& flows, Motion& motion) {
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    Matrix6 H = Matrix6::Zero();
    H.diagonal().head<3>().setConstant(1.0 / (kMotionSigma * kMotionSigma));
    H.diagonal().tail<3>().setConstant(1.0 / (kTurnSigma * kTurnSigma));
    Vector6 g = Vector6::Zero();
    // The kernel narrows to what noise explains.
    const double widening = std::pow(3.0, std::max(0, kIterations - 4 - iteration));
    const double from_normals = kNormalError * motion.mean.head<3>().norm();
    for (const Flow& flow : flows) {
      if (!has_changed(flow)) continue;
      const double scale = flow.sigma * widening + from_normals;
      const double e = (flow.change - flow.row.dot(motion.mean)) / scale;
      const double weight = 1.0 / (scale * scale * (1.0 + e * e / 4.0));
      H += weight * flow.row * flow.row.transpose();
      g += weight * flow.change * flow.row;
    }
    motion.covariance = H.inverse();
    motion.mean = motion.covariance * g;
  }
  const auto changed = std::ranges::count_if(flows, has_changed);
  const auto agreeing = std::ranges::count_if(
      flows, [&](const Flow& flow) { return kind_of(flow, motion) == Kind::world; });
  return static_cast<double>(agreeing) >= kLeastAgreeing * static_cast<double>(changed);
}

void BodyMask::observe(const RangeImage& image) {
  if (size_ == 0 && compared_ >= kEnough && ++paused_ <= kPause) return;
  std::vector<float> range = ranges_of_pixels(image);
  if (reference_.empty()) {
    reference_ = std::move(range);
    return;
  }
  ++age_;
  if (!votes_.empty()) forget_changed(range);
  const int stride = std::max(1, rows_ * columns_ / kSamples);
  std::vector<Flow> flows;
  for (int row = 0; row < rows_; ++row) {
    for (int column = row % stride; column < columns_; column += stride) {
      Flow flow;
      if (flow_at(row, column, range, flow)) flows.push_back(flow);
    }
  }
  const auto changed = static_cast<double>(std::ranges::count_if(flows, has_changed));
  const auto all = static_cast<double>(flows.size());
  const bool moved = changed >= kLeastChanged && changed >= kLeastChangedShare * all;
  if (moved) look_for_body(flows, range);
  if (!moved && age_ < kOldest) return;
  age_ = 0;
  if (size_ == 0 && compared_ >= kEnough) {
    reference_.clear();
    paused_ = 0;
  } else {
    reference_ = std::move(range);
  }
}

void BodyMask::look_for_body(const std::vector<Flow>& flows, const std::vector<float>& range) {
  Motion motion;
  if (!find_motion(flows, motion)) return;
  ++compared_;
  int body = 0;
  int world = 0;
  int chance = 0;  // changes that nothing explains, in a band twice as wide
  for (const Flow& flow : flows) {
    const Kind kind = kind_of(flow, motion);
    body += kind == Kind::body;
    world += kind == Kind::world;
    chance += kind == Kind::other && std::abs(flow.change) < 3.0 * kUnchanged * flow.sigma;
  }
  const int both = body + world;
  if (body >= kLeastBodyPixels && body >= kLeastBody * both && world >= kLeastWorld * both &&
      body >= kOverChance * 0.5 * chance)
    vote(range, motion, body >= kOverwhelming * world ? kLeastVotes : 1);
}

void BodyMask::vote(const std::vector<float>& range, const Motion& motion, int weight) {
  if (votes_.empty()) {
    votes_.assign(range.size(), 0);
    body_.assign(range.size(), 0.0F);
  }
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      Flow flow;
      if (!flow_at(row, column, range, flow) || kind_of(flow, motion) != Kind::body) continue;
      const std::size_t pixel = static_cast<std::size_t>(row) * columns_ + column;
      const bool was_masked = is_masked(pixel);
      if (votes_[pixel] == 0) body_[pixel] = range[pixel];
      votes_[pixel] = static_cast<std::int8_t>(std::min(votes_[pixel] + weight, kMostVotes));
      size_ += is_masked(pixel) && !was_masked;
    }
  }
}

bool BodyMask::is_masked(std::size_t pixel) const {
  return votes_[pixel] >= kLeastVotes;
}

float BodyMask::tolerance_at(int row, int column, float range) const {
  const std::size_t begin = static_cast<std::size_t>(row) * columns_;
  const float left = body_[begin + (column + 1) % columns_];
  const float right = body_[begin + (column + columns_ - 1) % columns_];
  const float slope = left > 0.0F && right > 0.0F ? 0.5F * std::abs(left - right) : 0.0F;
  return 4.0F * noise_ + std::min(slope, 0.05F * range);
}

// What is not where the body was is no part of it.
void BodyMask::forget_changed(const std::vector<float>& range) {
  for (int row = 0; row < rows_; ++row) {
    for (int column = 0; column < columns_; ++column) {
      const std::size_t pixel = static_cast<std::size_t>(row) * columns_ + column;
      if (votes_[pixel] == 0 || range[pixel] == 0.0F) continue;
      if (std::abs(range[pixel] - body_[pixel]) < tolerance_at(row, column, body_[pixel])) continue;
      const bool was_masked = is_masked(pixel);
      --votes_[pixel];
      size_ -= was_masked && !is_masked(pixel);
    }
  }
}

std::size_t BodyMask::mark(const RangeImage& image, std::vector<std::uint8_t>& remove) const {
  if (size_ == 0) return 0;
  std::size_t count = 0;
  for (int row = 0; row < rows_; ++row) {
    for (std::uint32_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      const int column = image.column[i];
      const std::size_t pixel = static_cast<std::size_t>(row) * columns_ + column;
      if (!is_masked(pixel) ||
          std::abs(image.range[i] - body_[pixel]) >= tolerance_at(row, column, body_[pixel]))
        continue;
      ++count;
      remove[i] = 1;
    }
  }
  return count;
}

double BodyMask::range() const {
  std::vector<float> ranges;
  for (std::size_t k = 0; k < votes_.size(); ++k)
    if (is_masked(k)) ranges.push_back(body_[k]);
  if (ranges.empty()) return 0.0;
  const auto most = ranges.begin() + static_cast<std::ptrdiff_t>(kMost * (ranges.size() - 1));
  std::ranges::nth_element(ranges, most);
  return *most;
}

}  // namespace lego_loam_sc
