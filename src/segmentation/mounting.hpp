// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "core/sensor_model.hpp"
#include "segmentation/range_image.hpp"

namespace lego_loam_sc {

/// Estimates the tilt of a sensor whose model states no mounting (height, roll and pitch are zero)
/// and sets the angles in `sensor`. The ground is the plane within 60 degrees of level that
/// supports most of the points within 15 m, with almost none behind it. A plane above the sensor,
/// which is then mounted upside down, is accepted only when there is almost nothing below. A tilt
/// below five degrees is ignored, since the ground or the vehicle may cause it. Returns true when a
/// tilt was found: the scan of `image` must then be projected again.
bool estimate_tilt(const RangeImage& image, SensorModel& sensor);

}  // namespace lego_loam_sc
