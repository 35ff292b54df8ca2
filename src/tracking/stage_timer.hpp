// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <chrono>
#include <optional>

namespace lego_loam_sc {

/// The stages of paper figure 4, for the times that they take.
enum class Stage { projection, segmentation, features, odometry, mapping, loops };
constexpr int kStages = 6;

/// Adds the wall time from each start() to the next one, to stop() or to its own end, to the
/// stage's entry.
class StageTimer {
 public:
  /// Adds to these.
  explicit StageTimer(std::array<double, kStages>& milliseconds) : milliseconds_(milliseconds) {}
  ~StageTimer() { stop(); }
  StageTimer(const StageTimer&) = delete;
  StageTimer& operator=(const StageTimer&) = delete;

  /// Ends the stage before and begins this one.
  void start(Stage stage) {
    stop();
    stage_ = stage;
    begin_ = Clock::now();
  }

  /// Ends the stage.
  void stop() {
    if (!stage_) return;
    const std::chrono::duration<double, std::milli> passed = Clock::now() - begin_;
    milliseconds_[static_cast<int>(*stage_)] += passed.count();
    stage_.reset();
  }

 private:
  using Clock = std::chrono::steady_clock;

  std::array<double, kStages>& milliseconds_;
  std::optional<Stage> stage_;
  Clock::time_point begin_;
};

}  // namespace lego_loam_sc
