// SPDX-License-Identifier: BSD-3-Clause
#include "slam/settings.hpp"

#include <sstream>
#include <type_traits>

#include "core/sensor_model.hpp"

namespace lego_loam_sc {
namespace {

class RangeCheck {
 public:
  RangeCheck(std::string group, std::optional<std::string>& fault)
      : group_(std::move(group)), fault_(fault) {}

  void operator()(const char*, bool, const char*) const {}

  template <class Number>
  void operator()(const char* name, Number value, std::type_identity_t<Number> minimum,
                  std::type_identity_t<Number> maximum, const char*) const {
    if (fault_ || (value >= minimum && value <= maximum)) return;  // false for NaN too
    std::ostringstream sentence;
    sentence << group_ << "." << name << " is " << value << ", it must be between " << minimum
             << " and " << maximum;
    fault_ = sentence.str();
  }

 private:
  std::string group_;
  std::optional<std::string>& fault_;
};

}  // namespace

std::optional<std::string> validate(const Settings& settings) {
  std::optional<std::string> fault;
  Settings::groups(settings, [&](const char* name, const auto& group) {
    visit_settings(group, RangeCheck(name, fault));
  });
  return fault;
}

std::optional<std::string> validate(const SensorModel& sensor) {
  const auto in = [](double value, double minimum, double maximum) {
    return value >= minimum && value <= maximum;
  };
  if (sensor.elevation_deg.empty() || sensor.elevation_deg.size() > 256)
    return "elevation_deg must list 1 to 256 beams";
  for (std::size_t i = 0; i < sensor.elevation_deg.size(); ++i) {
    if (!in(sensor.elevation_deg[i], -90.0, 90.0))
      return "elevation_deg must lie between -90 and 90";
    if (i > 0 && !(sensor.elevation_deg[i] > sensor.elevation_deg[i - 1]))
      return "elevation_deg must ascend from the lowest to the highest beam";
  }
  if (!in(sensor.columns, 36, 16384)) return "columns must be between 36 and 16384";
  if (!in(sensor.min_range, 0.0, 1000.0)) return "min_range must be between 0 and 1000 m";
  if (!in(sensor.max_range, 1.0, 10000.0) || sensor.max_range <= sensor.min_range)
    return "max_range must be between 1 and 10000 m and above min_range";
  if (!in(sensor.range_noise, 0.0, 1.0)) return "range_noise must be between 0 and 1 m";
  if (!in(sensor.period, 1e-3, 10.0)) return "period must be between 0.001 and 10 s";
  if (!in(sensor.start_azimuth_deg, -360.0, 360.0))
    return "start_azimuth_deg must be between -360 and 360";
  if (!in(sensor.elevation_correction_deg, -5.0, 5.0))
    return "elevation_correction_deg must be between -5 and 5";
  if (!in(sensor.height, 0.0, 100.0)) return "height must be between 0 (unknown) and 100 m";
  if (!in(sensor.mount_roll_deg, -180.0, 180.0)) return "mount_roll_deg must be within 180 degrees";
  if (!in(sensor.mount_pitch_deg, -90.0, 90.0)) return "mount_pitch_deg must be within 90 degrees";
  return std::nullopt;
}

}  // namespace lego_loam_sc
