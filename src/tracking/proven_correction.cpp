// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/proven_correction.hpp"

#include <algorithm>
#include <cmath>

namespace lego_loam_sc {
namespace {

constexpr int kBlock = 10;  // measurements; those that follow each other see the same ground
constexpr double kMinBlocks = 3.0;  // before the first trial
constexpr double kMinTrials = 6.0;
constexpr double kProof = 3.0;     // sigmas of the mean gain to apply a correction
constexpr double kDisproof = 1.0;  // and below which it is taken back

}  // namespace

void ProvenCorrection::Sums::add(double x) {
  n += 1.0;
  sum += x;
  square += x * x;
}

double ProvenCorrection::Sums::sigma_of_mean() const {
  if (n < 2.0) return 0.0;
  return std::sqrt(std::max(square / n - mean() * mean(), 0.0) / (n - 1.0));
}

double ProvenCorrection::sigma() const {
  return sums_.sigma_of_mean();
}

void ProvenCorrection::add(double measurement) {
  block_sum_ += measurement;
  if (++in_block_ < kBlock) return;
  add_block(block_sum_ / kBlock);
  block_sum_ = 0.0;
  in_block_ = 0;
}

void ProvenCorrection::add_block(double mean) {
  if (sums_.n >= kMinBlocks) {
    const double tried = sums_.mean();
    gains_.add(mean * mean - (mean - tried) * (mean - tried));
  }
  sums_.add(mean);
  if (gains_.n < kMinTrials) return;
  const double proof = gains_.mean() / std::max(gains_.sigma_of_mean(), 1e-300);
  const bool large = std::abs(sums_.mean()) > floor_;
  if (value_ == 0.0 ? proof > kProof && large : proof > kDisproof && large)
    value_ = sums_.mean();
  else
    value_ = 0.0;
}

}  // namespace lego_loam_sc
