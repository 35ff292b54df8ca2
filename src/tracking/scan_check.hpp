// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "core/sensor_model.hpp"
#include "segmentation/body_mask.hpp"
#include "segmentation/filler_shell.hpp"
#include "segmentation/range_image.hpp"
#include "tracking/sweep_unit.hpp"

namespace lego_loam_sc {

/// What the scans so far held that is no measurement of the surroundings.
struct ScanFindings {
  std::size_t points = 0;         ///< of all scans, with those below
  std::size_t filler_points = 0;  ///< at one range in all directions, see FillerShell
  double filler_range = 0.0;      ///< m
  std::size_t body_points = 0;    ///< that move with the sensor, see BodyMask
  double body_range = 0.0;        ///< m; nearly all of them are within it
  double time_factor = 1.0;       ///< that the times of the points were multiplied by
  int long_sweeps = 0;            ///< longer than the gap between scans, see SweepUnit
  int sweeps = 0;                 ///< that were compared with the gap

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(points, filler_points, filler_range, body_points, body_range, time_factor, long_sweeps,
            sweeps);
  }
};

/// Watches the range images of a recording for what cannot be, and puts them right where that is
/// unambiguous: takes out fillers and the body of the vehicle, and corrects the unit of the
/// times.
class ScanCheck {
 public:
  /// Knows nothing of the recording yet.
  explicit ScanCheck(const SensorModel& sensor)
      : filler_(sensor), body_(sensor), sweep_(sensor.period) {}

  /// Takes the image of the next scan as it was projected, and puts it right.
  void check(RangeImage& image);

  /// Puts another projection of that scan right.
  void correct(RangeImage& image) const;

  /// So far.
  const ScanFindings& findings() const { return findings_; }

  /// Whether something was learnt that scans before should have been handled by.
  bool has_learnt() const { return body_.size() > 0 || sweep_.factor() != 1.0; }

  /// Begins with the first scan again, but knows what was learnt.
  void restart();

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(filler_, body_, sweep_, findings_);
  }

 private:
  FillerShell filler_;
  BodyMask body_;
  SweepUnit sweep_;
  ScanFindings findings_;
};

}  // namespace lego_loam_sc
