// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <string>

#include "io/presets.hpp"
#include "io/sensor_yaml.hpp"
#include "made_scenes.hpp"
#include "preset_name.hpp"

namespace lego_loam_sc {
namespace {

// The intensity of a made scan is the row that a point was measured in.
void expect_right_rows(const RangeImage& image) {
  for (int row = 0; row < image.rows; ++row)
    for (std::uint32_t k = image.row_begin[row]; k < image.row_begin[row + 1]; ++k)
      ASSERT_EQ(image.intensity[k], row) << "point " << k;
}

class SensorPreset : public testing::TestWithParam<std::string> {};

// A sensor that moves on through the hall while it turns.
Scan sweep_of(const SensorModel& sensor, int number) {
  const auto pose_at = [&](double seconds) {
    return pose_of(-8.0 + 3.0 * number + 5.0 * seconds, 4.0, 1.8, 25.0 * number + 40.0 * seconds);
  };
  return take_sweep(hall(), sensor, pose_at,
                    {.stamp_ns = number * 100'000'000, .noise = sensor.range_noise, .seed = 3});
}

TEST_P(SensorPreset, ItsScansGoThroughTheFrontEndWithTheRightRows) {
  const SensorModel sensor = load_sensor(GetParam());
  for (int number = 0; number < 3; ++number) {
    Scan scan = sweep_of(sensor, number);
    const Staged staged = through_stages(scan, sensor, 1.8);
    ASSERT_GT(staged.image.size(), 0.9 * static_cast<double>(scan.size()));
    expect_right_rows(staged.image);
    EXPECT_GT(static_cast<double>(staged.segmentation.ground_points),
              0.05 * static_cast<double>(staged.image.size()));
    EXPECT_GT(staged.features.edges_sharp.size(), 10u);
    EXPECT_GT(staged.features.planars_flat.size(), 100u);

    // Drivers number from above or from below, and converters drop the numbers.
    const auto top = static_cast<std::uint16_t>(sensor.rows() - 1);
    for (std::uint16_t& ring : scan.ring) ring = static_cast<std::uint16_t>(top - ring);
    expect_right_rows(project(scan, sensor));
    scan.ring.clear();
    const RangeImage unnumbered = project(scan, sensor);
    EXPECT_EQ(unnumbered.size(), staged.image.size());
    expect_right_rows(unnumbered);
  }
}

INSTANTIATE_TEST_SUITE_P(All, SensorPreset, testing::ValuesIn(preset_names("sensors")),
                         preset_name);

}  // namespace
}  // namespace lego_loam_sc
