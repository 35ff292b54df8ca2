// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"

namespace lego_loam_sc {

/// Finds the tilt of a sensor whose model states no mounting (height, roll and pitch are zero) and
/// sets the angles in `sensor`. The ground is the plane within 60 degrees of level on which most of
/// the points within 15 m lie, with next to none beyond it; one above the sensor, which then hangs
/// upside down, only when there is next to nothing below. Less than five degrees are taken for
/// none: that much is the ground's or the vehicle's. True when a tilt was found: the scan of
/// `image` must then be projected again.
bool estimate_tilt(const RangeImage& image, SensorModel& sensor);

}  // namespace lego_loam_sc
