// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/recognise_sensor.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/pose.hpp"
#include "core/text.hpp"
#include "sensor/beams.hpp"
#include "sensor/row_assignment.hpp"

namespace lego_loam_sc {
namespace {

// Beams fit when kFitShare of the points lie within kNearShare of the spacing to one; by chance 30
// % do.
constexpr double kNearShare = 0.15;
constexpr double kFitShare = 0.8;
// Outside the outermost beams by more than units of one model differ. KITTI's scans have
// kStrayShare of their points there at most; with kMisfitShare a scan is another sensor's.
constexpr double kFarDeg = 2.0;
constexpr double kStrayShare = 0.05;
constexpr double kMisfitShare = 0.2;
constexpr double kRingShare = 0.9;  // of the beams of a preset that must be present
constexpr double kNearDeg = 0.5;    // mean difference between units of one model

struct Elevations {
  std::vector<double> deg;  // of the points with a return
  double lowest = 0.0;
  double highest = 0.0;
};

Elevations measure_elevations(const Scan& scan) {
  Elevations elevations;
  for (const Eigen::Vector3f& p : scan.points)
    if (is_return(p))
      elevations.deg.push_back(degrees(std::atan2(p.z(), std::hypot(p.x(), p.y()))));
  if (elevations.deg.empty()) return elevations;
  const auto [lowest, highest] = std::minmax_element(elevations.deg.begin(), elevations.deg.end());
  elevations.lowest = *lowest;
  elevations.highest = *highest;
  return elevations;
}

// Distance from an elevation to the nearest beam, and the local spacing of the beams, deg.
struct NearestBeam {
  double distance;
  double spacing;
};

// `beams` has at least two entries.
NearestBeam nearest_beam(const std::vector<double>& beams, double elevation) {
  const auto above = std::lower_bound(beams.begin(), beams.end(), elevation);
  if (above == beams.begin()) return {beams.front() - elevation, beams[1] - beams[0]};
  if (above == beams.end()) return {elevation - beams.back(), beams.back() - *(above - 2)};
  return {std::min(*above - elevation, elevation - *(above - 1)), *above - *(above - 1)};
}

template <class Holds>
double share_of(const Elevations& elevations, Holds&& holds) {
  const auto count = std::count_if(elevations.deg.begin(), elevations.deg.end(), holds);
  return static_cast<double>(count) / static_cast<double>(elevations.deg.size());
}

bool fits(const Elevations& elevations, const std::vector<double>& beams) {
  return share_of(elevations, [&](double elevation) {
           const NearestBeam nearest = nearest_beam(beams, elevation);
           return nearest.distance <= kNearShare * nearest.spacing;
         }) >= kFitShare;
}

double share_outside(const Elevations& elevations, const std::vector<double>& beams) {
  return share_of(elevations, [&](double elevation) {
    return elevation < beams.front() - kFarDeg || elevation > beams.back() + kFarDeg;
  });
}

std::size_t count_rings(const Scan& scan) {
  std::vector<bool> seen(std::size_t{std::numeric_limits<std::uint16_t>::max()} + 1);
  for (std::size_t i = 0; i < scan.ring.size(); ++i)
    if (is_return(scan.points[i])) seen[scan.ring[i]] = true;
  return static_cast<std::size_t>(std::count(seen.begin(), seen.end(), true));
}

std::size_t count_stored_rings(const Scan& scan) {
  const std::vector<std::int16_t> ring = stored_rings(scan);
  return ring.empty() ? 0 : static_cast<std::size_t>(1 + *std::ranges::max_element(ring));
}

// Null when there is none.
const SensorModel* find_preset(std::span<const SensorModel> presets, std::string_view name) {
  const auto found = std::ranges::find(presets, name, &SensorModel::name);
  return found == presets.end() ? nullptr : &*found;
}

// Null when no preset fits.
const SensorModel* recognise(const Scan& scan, const Elevations& elevations,
                             std::span<const SensorModel> presets) {
  const std::size_t rings = count_rings(scan);
  if (rings == 0) {
    const std::size_t stored = count_stored_rings(scan);
    const SensorModel* kitti = find_preset(presets, "kitti");
    // The outermost rings may be empty.
    if (kitti && stored >= 60 && stored <= 66 &&
        share_outside(elevations, kitti->elevation_deg) < kStrayShare)
      return kitti;
  }
  for (const char* name : {"vlp16", "hdl32e"}) {
    const SensorModel* sensor = find_preset(presets, name);
    if (sensor && rings <= sensor->elevation_deg.size() && fits(elevations, sensor->elevation_deg))
      return sensor;
  }
  if (const auto preset = nearest_preset(beams_of_rings({&scan, 1}).elevation_deg, presets))
    return find_preset(presets, preset->name);
  // The beams of an HDL-64E differ too much from unit to unit to be compared one by one.
  const SensorModel* hdl64e = find_preset(presets, "hdl64e");
  if (hdl64e && rings > 32 && rings <= 64 &&
      share_outside(elevations, hdl64e->elevation_deg) < kStrayShare)
    return hdl64e;
  return nullptr;
}

std::string describe(const Scan& scan, const Elevations& elevations) {
  return std::to_string(elevations.deg.size()) + " points" +
         (scan.ring.empty() ? std::string(" without ring numbers")
                            : " in " + std::to_string(count_rings(scan)) + " rings") +
         " between " + to_fixed(elevations.lowest, 1) + " and " + to_fixed(elevations.highest, 1) +
         " degrees";
}

}  // namespace

std::optional<NearestPreset> nearest_preset(const std::vector<double>& elevation_deg,
                                            std::span<const SensorModel> presets) {
  std::vector<double> elevation(elevation_deg.size());
  std::ranges::transform(elevation_deg, elevation.begin(), radians);
  std::optional<NearestPreset> nearest;
  const auto compare = [&](const SensorModel& sensor) {
    if (sensor.motion_compensated || elevation.size() < kRingShare * sensor.rows()) return;
    const auto rows = align_to_beams(elevation, sensor);
    if (!rows) return;
    double sum = 0.0;
    for (std::size_t k = 0; k < rows->size(); ++k)
      sum += std::abs(elevation_deg[k] - sensor.elevation_deg[(*rows)[k]]);
    const double difference = sum / static_cast<double>(rows->size());
    if (difference < (nearest ? nearest->difference_deg : kNearDeg))
      nearest = NearestPreset{sensor.name, difference};
  };
  // RS-LiDAR-16, RS-Helios-16P and XT16 have the beams of a VLP-16, the most common: it wins ties.
  if (const SensorModel* vlp16 = find_preset(presets, "vlp16")) compare(*vlp16);
  for (const SensorModel& sensor : presets) compare(sensor);
  return nearest;
}

SensorModel recognise_sensor(const Scan& scan, std::span<const SensorModel> presets) {
  if (const auto fault = ring_fault(beams_of_rings({&scan, 1})))
    throw InputError("the sensor is not recognised: " + *fault);
  const Elevations elevations = measure_elevations(scan);
  const SensorModel* sensor =
      elevations.deg.empty() ? nullptr : recognise(scan, elevations, presets);
  if (sensor) return *sensor;
  std::vector<std::string> names;
  for (const SensorModel& preset : presets) names.push_back(preset.name);
  throw InputError("the sensor is not recognised: the scan has " + describe(scan, elevations) +
                   "; give --sensor with a sensor file or one of " + join(names));
}

std::optional<std::string> sensor_mismatch(const Scan& scan, const SensorModel& sensor) {
  const Elevations elevations = measure_elevations(scan);
  if (elevations.deg.empty()) return std::nullopt;
  if (const auto fault = ring_fault(beams_of_rings({&scan, 1}))) return fault;
  const auto& beams = sensor.elevation_deg;
  if (count_rings(scan) <= beams.size() && share_outside(elevations, beams) <= kMisfitShare)
    return std::nullopt;
  return "the scan does not fit the sensor " + sensor.name + ", which has " +
         std::to_string(beams.size()) + " beams between " + to_fixed(beams.front(), 1) + " and " +
         to_fixed(beams.back(), 1) + " degrees: it has " + describe(scan, elevations) +
         "; give another --sensor";
}

}  // namespace lego_loam_sc
