// SPDX-License-Identifier: BSD-3-Clause
#include "slam/back_end.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "graph/edge_covariance.hpp"
#include "loop/scan_context.hpp"

namespace lego_loam_sc {

BackEnd::BackEnd(const BackEndSettings& settings, double range_noise, LoopDetector detector,
                 std::shared_ptr<KeyFrames> key_frames)
    : settings_(settings),
      key_frames_(std::move(key_frames)),
      graph_(settings.graph),
      loop_closer_(settings.loop, settings.graph, range_noise, std::move(detector)) {
  key_frames_->clear();
}

BackEnd::Result BackEnd::add(const TrackedKeyFrame& key_frame) {
  add_to_graph(key_frame);
  key_frames_->add(key_frame.key_frame);
  scan_of_key_frame_.push_back(key_frame.scan);

  Result result;
  ScanContext context =
      make_scan_context(key_frame.points, key_frame.sensor_height, settings_.loop.scan_context);
  result.loops = loop_closer_.close(*key_frames_, std::move(context), fragments_, graph_);
  for (LoopReport& loop : result.loops) {
    loop.query_scan = scan_of_key_frame_[loop.candidate.query];
    loop.match_scan = scan_of_key_frame_[loop.candidate.match];
  }
  result.correction = correction_after(result.loops);
  return result;
}

void BackEnd::add_to_graph(const TrackedKeyFrame& key_frame) {
  if (key_frame.number == 0) {
    graph_.add_first(key_frame.T_map_key);
    return;
  }
  if (key_frame.starts_fragment) fragments_.begin(key_frame.number);
  const Matrix6 covariance =
      key_frame.starts_fragment
          ? unconstrained_covariance()
          : odometry_covariance(key_frame.covariance, key_frame.T_map_key.linear(),
                                key_frame.localizability, settings_.graph);
  graph_.add_key_frame({key_frame.number - 1, key_frame.number, key_frame.T_last_key, covariance});
}

// A loop that was accepted is news, and so are the poses after one that was taken out again.
std::optional<Correction> BackEnd::correction_after(const std::vector<LoopReport>& loops) const {
  const auto any = [&](Verdict verdict) {
    return std::ranges::any_of(
        loops, [&](const LoopReport& loop) { return loop.verification.verdict == verdict; });
  };
  Correction correction;
  correction.accepted = any(Verdict::accepted);
  if (!correction.accepted && !any(Verdict::contradicted)) return std::nullopt;
  correction.T_map_key = graph_.poses();
  const int newest = static_cast<int>(graph_.size()) - 1;
  std::ranges::copy_if(loop_closer_.places(), std::back_inserter(correction.places),
                       [&](int k) { return fragments_.joined(k, newest); });
  return correction;
}

}  // namespace lego_loam_sc
