// SPDX-License-Identifier: BSD-3-Clause
#include "eval/association.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>

#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::uint64_t kMaxDifferenceNs = 10'000'000;

// Cannot overflow.
std::uint64_t gap(std::int64_t a, std::int64_t b) {
  const auto [earlier, later] = std::minmax(a, b);
  return static_cast<std::uint64_t>(later) - static_cast<std::uint64_t>(earlier);
}

std::vector<PosePair> pair_by_index(const PoseFile& truth, const PoseFile& estimate) {
  const std::size_t count = estimate.poses.size();
  const bool both_kitti = !truth.has_stamps && !estimate.has_stamps;
  if (count > truth.poses.size() || (count < truth.poses.size() && !both_kitti))
    throw InputError("the estimate has " + std::to_string(count) + " poses and the truth " +
                     std::to_string(truth.poses.size()) +
                     "; without stamps in both they are paired by index: give files of the same "
                     "scans, or both in TUM format");
  std::vector<PosePair> pairs(count);
  for (std::size_t i = 0; i < count; ++i) pairs[i] = {truth.poses[i].pose, estimate.poses[i].pose};
  return pairs;
}

void check_ascending(const Trajectory& trajectory, const std::string& name) {
  for (std::size_t i = 1; i < trajectory.size(); ++i)
    if (trajectory[i].stamp_ns <= trajectory[i - 1].stamp_ns)
      throw InputError("pose " + std::to_string(i + 1) + " of the " + name +
                       " is not later than the previous one: sort the file by stamp");
}

// `trajectory` ascends and is not empty.
const StampedPose& nearest(const Trajectory& trajectory, std::int64_t stamp_ns) {
  const auto after = std::lower_bound(
      trajectory.begin(), trajectory.end(), stamp_ns,
      [](const StampedPose& pose, std::int64_t stamp) { return pose.stamp_ns < stamp; });
  if (after == trajectory.begin()) return *after;
  if (after == trajectory.end()) return *(after - 1);
  const StampedPose& before = *(after - 1);
  return gap(after->stamp_ns, stamp_ns) < gap(before.stamp_ns, stamp_ns) ? *after : before;
}

std::vector<PosePair> pair_by_stamp(const Trajectory& truth, const Trajectory& estimate) {
  check_ascending(truth, "truth");
  check_ascending(estimate, "estimate");
  std::vector<PosePair> pairs;
  if (truth.empty() || estimate.empty()) return pairs;
  const bool truth_is_longer = truth.size() > estimate.size();
  const Trajectory& longer = truth_is_longer ? truth : estimate;
  for (const StampedPose& pose : truth_is_longer ? estimate : truth) {
    const StampedPose& other = nearest(longer, pose.stamp_ns);
    if (gap(other.stamp_ns, pose.stamp_ns) > kMaxDifferenceNs) continue;
    pairs.push_back(truth_is_longer ? PosePair{other.pose, pose.pose}
                                    : PosePair{pose.pose, other.pose});
  }
  return pairs;
}

}  // namespace

std::vector<PosePair> associate(const PoseFile& truth, const PoseFile& estimate) {
  const bool by_stamp = truth.has_stamps && estimate.has_stamps;
  std::vector<PosePair> pairs =
      by_stamp ? pair_by_stamp(truth.poses, estimate.poses) : pair_by_index(truth, estimate);
  if (pairs.size() < 2)
    throw InputError("truth and estimate have " + std::to_string(pairs.size()) +
                     " poses in common" + (by_stamp ? " within 0.01 s" : "") +
                     ", at least two are needed: check that both are of the same recording");
  return pairs;
}

}  // namespace lego_loam_sc
