// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/pose.hpp"
#include "core/sensor_model.hpp"
#include "tracking/front_end.hpp"
#include "tracking/proven_correction.hpp"

namespace lego_loam_sc {

/// The sensor as its model states it, and with what the scans have shown.
class Calibration {
 public:
  /// As the model states it.
  explicit Calibration(const SensorModel& model)
      : nominal(model), sensor(model), height(model.height) {}

  SensorModel nominal;
  SensorModel sensor;  ///< with the tilt and the elevation angles that were found on the way
  double height;       ///< m above the ground, 0 = not known yet

  /// Takes what the front end found of the mounting.
  void set_mounting(const Mounting& mounting);

  /// Whether the tilt that is in use was estimated.
  bool tilt_is_estimated() const { return sensor.tilted() && !nominal.tilted(); }

  /// Whether a scan by itself shows the tilt that is in use, within a few degrees.
  bool shows_tilt(const Scan& scan) const;

  /// Takes the ground of a scan, `travelled` m from the start, as evidence of a common error of the
  /// elevation angles (see cone_of_ground), which is corrected once it is proved. A tilted sensor
  /// is left alone: it does not spin about the vertical axis.
  void observe_ground(const FrontEnd& front_end, double travelled);

  /// The correction in force, 0 when none has proved itself, and one sigma of what is known, deg.
  /// @{
  double elevation_bias_deg() const { return degrees(elevation_bias_.value()); }
  double elevation_bias_sigma_deg() const { return degrees(elevation_bias_.sigma()); }
  /// @}

  /// The tracker has the LiDAR's axes turned level; this gives the pose of the LiDAR.
  Pose to_lidar_frame(Pose T_frame_level) const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(sensor.mount_roll_deg, sensor.mount_pitch_deg, sensor.elevation_correction_deg, height,
            elevation_bias_, next_observation_);
  }

 private:
  // Rays graze rough ground and meet its tops first, and roads have a shape: the ground is a cone
  // of up to 0.06 degrees to a sensor without error. A smaller correction is not believed.
  ProvenCorrection elevation_bias_{radians(0.1)};
  double next_observation_ = 0.0;  // m from the start
};

}  // namespace lego_loam_sc
