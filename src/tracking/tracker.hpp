// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <optional>

#include "core/scan.hpp"
#include "core/sensor_model.hpp"
#include "key_frames/correction.hpp"
#include "key_frames/key_frames.hpp"
#include "mapping/mapper.hpp"
#include "odometry/odometry.hpp"
#include "tracking/calibration.hpp"
#include "tracking/front_end.hpp"
#include "tracking/local_map_updater.hpp"
#include "tracking/motion_state.hpp"
#include "tracking/scan_check.hpp"
#include "tracking/scan_clock.hpp"
#include "tracking/settings.hpp"
#include "tracking/tracked_scan.hpp"
#include "tracking/tracking_monitor.hpp"
#include "tracking/witness.hpp"

namespace lego_loam_sc {

/// Local SLAM, paper 2.3 (1) to (4): finds the pose of each scan in a local map and says which
/// scans are key frames. Knows nothing of loops and of the pose graph; `correct` tells it what came
/// of them.
class Tracker {
 public:
  /// `key_frames` is where the back end keeps those that the tracker gave it: from there they are
  /// put into the local map again.
  Tracker(const SensorModel& sensor, const TrackerSettings& settings,
          std::shared_ptr<const KeyFrames> key_frames);

  /// The next scan. Whatever it holds, this returns; see Status.
  TrackedScan track(const Scan& scan);

  /// Brings the local map and the present pose in step with the pose graph. `correction` holds the
  /// key frames up to the last one that `track` gave.
  void correct(const Correction& correction);

  /// The next scan may change the result of the first one, see TrackedScan::first_again.
  bool may_reprocess() const { return first_scan_.has_value(); }

  /// With the mounting as it is known by now.
  const Calibration& calibration() const { return calibration_; }

  /// What the scans held that is no measurement of the surroundings.
  const ScanFindings& findings() const { return check_.findings(); }

  /// Whether the times of the points fit the motion.
  const SweepCheck& sweep_check() const { return mapper_.sweep_check(); }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(calibration_, clock_, check_, odometry_, mapper_, map_updater_, monitor_, witness_,
            motion_, progress_);
  }

 private:
  // From the scan before to the present one.
  struct Step {
    bool first = false;      // there is no scan before
    double jump_s = 0.0;     // see ScanTime
    double seconds = 0.0;    // between the reference times
    double stamp_age = 0.0;  // s, of the stamp after the reference time
    bool enough_points = true;
  };
  // Where a scan is, and what says so.
  struct Placement {
    Status status = Status::ok;
    bool mapped = false;        // the scan's turn to be matched and added
    MapMatch found;             // as the map gave it
    MapMatch match;             // as believed: without `found`, where that is refused
    bool new_fragment = false;  // tracking was lost: the scan begins a new map

    bool placed() const { return is_placed(status) || new_fragment; }
  };
  // The scan with its motion.
  struct Advance {
    ScanState current;
    Features features;  // de-skewed; none unless it is placed
    Pose T_reference_stamp = Pose::Identity();
    double prediction_m = 0.0;  // see TrackedScan
    Testimony testimony;
  };
  struct LastKeyFrame {
    int number = -1;
    Pose T_map_key = Pose::Identity();  // where the mapper has it

    template <class Archive>
    void state(Archive& archive) {
      archive(number, T_map_key);
    }
  };
  // What a repeated scan is told by, and the poses that it repeats; see TrackedScan.
  struct LastScan {
    std::uint64_t points_hash = 0;
    Pose T_odom_lidar = Pose::Identity();
    Pose T_key_lidar = Pose::Identity();

    template <class Archive>
    void state(Archive& archive) {
      archive(points_hash, T_odom_lidar, T_key_lidar);
    }
  };
  struct Progress {
    int scans = 0;
    int fragment = 0;
    LastKeyFrame last_key_frame;
    LastScan last_scan;

    template <class Archive>
    void state(Archive& archive) {
      archive(scans, fragment, last_key_frame, last_scan);
    }
  };
  struct FirstScan {
    int index = 0;
    Scan scan;
  };

  TrackedScan repeat(const Scan& scan);
  TrackedScan track_once(const Scan& scan, int index);
  TrackedScan restart(const FirstScan& first, const Scan& second, int index, const Vector6& twist);
  TrackedScan reprocess_first_scans(const FirstScan& first, const Scan& second,
                                    TrackedScan tracked);
  FrontEnd look_at(const Scan& scan, std::int64_t time_ns);
  Step begin_step(const FrontEnd& front_end, const ScanTime& time);
  Motion measure_motion(const Features& features, const Step& step) const;
  Placement place(const Features& features, const Motion& motion, const Step& step, int index);
  MapMatch match_with_map(const Features& features, const Motion& motion, double seconds);
  void begin_fragment();
  Advance advance(const FrontEnd& front_end, const Motion& motion, const Step& step,
                  const Placement& placement);
  Testimony hear_witnesses(const RangeImage& image, const ScanState& state) const;
  bool is_far_from_last_key_frame(const Pose& T_map_lidar) const;
  TrackedKeyFrame begin_key_frame(const FrontEnd& front_end, const Advance& advance,
                                  const Placement& placement, int index);

  TrackerSettings settings_;
  std::shared_ptr<const KeyFrames> key_frames_;
  Calibration calibration_;
  ScanClock clock_;
  ScanCheck check_;
  Odometry odometry_;
  Mapper mapper_;
  LocalMapUpdater map_updater_;
  TrackingMonitor monitor_;
  Witness witness_;
  MotionState motion_;
  Progress progress_;
  std::optional<FirstScan> first_scan_;  // until its motion is known
  bool find_tilt_ = true;  // false when the second scan has contradicted the first; of no use later
};

}  // namespace lego_loam_sc
