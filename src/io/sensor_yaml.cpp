// SPDX-License-Identifier: BSD-3-Clause
#include "io/sensor_yaml.hpp"

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/file.hpp"
#include "io/presets.hpp"
#include "io/yaml.hpp"

namespace lego_loam_sc {
namespace {

// All fields but the name and the beams, in the order of the file.
template <class Sensor, class Visit>
void visit_fields(Sensor& s, Visit&& visit) {
  visit("columns", s.columns, "columns of the range image over 360 degrees");
  visit("min_range", s.min_range, "m; nearer points hit the vehicle or the sensor itself");
  visit("max_range", s.max_range, "m");
  visit("range_noise", s.range_noise, "m, one sigma");
  visit("period", s.period, "s for one turn");
  visit("start_azimuth_deg", s.start_azimuth_deg,
        "where a sweep starts, counter-clockwise from straight ahead");
  visit("clockwise", s.clockwise, "seen from above");
  visit("motion_compensated", s.motion_compensated,
        "points are already moved to the stamp of their scan");
  visit("elevation_correction_deg", s.elevation_correction_deg,
        "added to the elevation angle of every point");
  visit("height", s.height, "m above the ground; 0 = unknown, then estimated from the scans");
  visit("mount_roll_deg", s.mount_roll_deg, "180 = upside down; all zero = estimated too");
  visit("mount_pitch_deg", s.mount_pitch_deg, "positive looks down to the front");
}

// Ranges are checked by validate(SensorModel).
void set(bool& value, const YamlEntry& entry) {
  value = to_bool(entry);
}
void set(double& value, const YamlEntry& entry) {
  value = to_double(entry);
}
void set(int& value, const YamlEntry& entry) {
  value = to_int(entry, 0, std::numeric_limits<int>::max());
}

std::string print(bool value) {
  return value ? "true" : "false";
}
std::string print(int value) {
  return to_text(value);
}
std::string print(double value) {
  return to_text(value);
}

struct EvenBeams {
  std::optional<int> beams;
  std::optional<double> lowest_deg, highest_deg;

  bool any() const { return beams || lowest_deg || highest_deg; }

  // Nothing unless all three are there.
  std::optional<std::vector<double>> elevations() const {
    if (!beams || !lowest_deg || !highest_deg) return std::nullopt;
    std::vector<double> result;
    const int last = *beams - 1;
    for (int i = 0; i <= last; ++i)  // both ends exact
      result.push_back((*lowest_deg * (last - i) + *highest_deg * i) / last);
    return result;
  }
};

void apply(const YamlEntry& entry, SensorModel& sensor, EvenBeams& even) {
  if (entry.key == "elevation_deg") {
    sensor.elevation_deg = to_doubles(entry);
  } else if (entry.key == "beams") {
    even.beams = to_int(entry, 2, 256);
  } else if (entry.key == "lowest_deg") {
    even.lowest_deg = to_double(entry, -90.0, 90.0);
  } else if (entry.key == "highest_deg") {
    even.highest_deg = to_double(entry, -90.0, 90.0);
  } else {
    bool found = false;
    std::vector<std::string> keys = {"elevation_deg", "beams", "lowest_deg", "highest_deg"};
    visit_fields(sensor, [&](const char* name, auto& value, const char*) {
      keys.emplace_back(name);
      if (entry.key != name) return;
      set(value, entry);
      found = true;
    });
    if (!found) fail_unknown_key(entry, keys);
  }
}

}  // namespace

SensorModel parse_sensor_yaml(const std::string& text, const std::string& name,
                              const std::string& file) {
  SensorModel sensor;
  sensor.name = name;
  EvenBeams even;
  for (const YamlEntry& entry : parse_yaml(text, file)) apply(entry, sensor, even);
  const auto even_elevations = even.elevations();
  if (sensor.elevation_deg.empty() ? !even_elevations : even.any())
    throw InputError(file + ": give either elevation_deg or all of beams, lowest_deg, highest_deg");
  if (even_elevations) sensor.elevation_deg = *even_elevations;
  if (const auto fault = validate(sensor)) throw InputError(file + ": " + *fault);
  return sensor;
}

SensorModel load_sensor(const std::string& name_or_file) {
  if (const auto preset = find_preset("sensors", name_or_file))
    return parse_sensor_yaml(*preset, name_or_file, "the preset " + name_or_file);
  const std::filesystem::path path(name_or_file);
  std::error_code missing;
  if (!std::filesystem::exists(path, missing))
    throw InputError("there is no sensor and no file " + describe_unknown("sensors", name_or_file));
  return parse_sensor_yaml(read_file(path), path.stem().string(), path.string());
}

std::string to_yaml(const SensorModel& sensor) {
  std::string beams;
  for (const double elevation : sensor.elevation_deg)
    beams += (beams.empty() ? "" : ", ") + to_text(elevation);
  std::string text = "# " + sensor.name + "\nelevation_deg: [" + beams +
                     "]  # deg, one per beam from the lowest up\n";
  visit_fields(sensor, [&](const char* name, const auto& value, const char* comment) {
    text += name + (": " + print(value)) + "  # " + comment + "\n";
  });
  return text;
}

}  // namespace lego_loam_sc
