// SPDX-License-Identifier: BSD-3-Clause
#include "app/stage_files.hpp"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "io/atomic_file.hpp"
#include "io/bytes.hpp"
#include "io/cloud_writer.hpp"

namespace lego_loam_sc {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour kGrey = {170, 170, 170};
constexpr Colour kRed = {224, 32, 32};
// Told apart from each other and from the red of the ground.
constexpr std::array<Colour, 8> kPalette = {{{31, 119, 180},
                                             {44, 160, 44},
                                             {148, 103, 189},
                                             {140, 86, 75},
                                             {23, 190, 207},
                                             {188, 189, 34},
                                             {90, 90, 90},
                                             {230, 168, 0}}};

constexpr const char* kProperties =
    "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
    "property ushort row\nproperty ushort column\nproperty uchar ground\nproperty int cluster\n"
    "property float roughness\nproperty float sharpness\nproperty uchar feature\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";

Colour of_row(const ScanStages&, std::size_t, int row) {
  return kPalette[row % kPalette.size()];
}

Colour of_segment(const ScanStages& stages, std::size_t i, int) {
  if (stages.segmentation.label[i] == Label::ground) return kRed;
  const int cluster = stages.segmentation.cluster[i];
  return cluster < 0 ? kGrey : kPalette[cluster % kPalette.size()];
}

// Blue to red by the logarithm of roughness over threshold, from a hundredth to a hundred.
Colour of_roughness(const ScanStages& stages, std::size_t i, int) {
  const float sharpness = stages.sharpness[i];
  if (std::isnan(sharpness)) return kGrey;
  const float t = std::clamp(std::log10(std::max(sharpness, 1e-6F)) / 2.0F, -1.0F, 1.0F);
  const auto fade = [&](float end) {
    return static_cast<std::uint8_t>(230.0F + std::abs(t) * (end - 230.0F));
  };
  return t < 0.0F ? Colour{fade(0), fade(70), fade(220)} : Colour{fade(220), fade(20), fade(0)};
}

Colour of_large_set(const ScanStages& stages, std::size_t i, int) {
  switch (stages.feature_set[i]) {
    case FeatureSet::edge_large:
    case FeatureSet::edge_sharp: return {0, 64, 255};
    case FeatureSet::planar_large:
    case FeatureSet::planar_flat: return {255, 140, 0};
    case FeatureSet::none: break;
  }
  return kGrey;
}

Colour of_small_set(const ScanStages& stages, std::size_t i, int) {
  if (stages.feature_set[i] == FeatureSet::edge_sharp) return {0, 160, 0};
  if (stages.feature_set[i] == FeatureSet::planar_flat) return {255, 20, 147};
  return kGrey;
}

std::string records(const ScanStages& stages,
                    Colour (*colour)(const ScanStages&, std::size_t, int)) {
  const RangeImage& image = stages.image;
  std::string bytes;
  for (int row = 0; row < image.rows; ++row) {
    for (std::size_t i = image.row_begin[row]; i < image.row_begin[row + 1]; ++i) {
      append(bytes, image.points[i]);
      append(bytes, image.intensity[i]);
      append(bytes, static_cast<std::uint16_t>(row));
      append(bytes, image.column[i]);
      append(bytes, static_cast<std::uint8_t>(stages.segmentation.label[i] == Label::ground));
      append(bytes, stages.segmentation.cluster[i]);
      append(bytes, stages.roughness[i]);
      append(bytes, stages.sharpness[i]);
      append(bytes, stages.feature_set[i]);
      append(bytes, colour(stages, i, row));
    }
  }
  return bytes;
}

}  // namespace

void write_stage_clouds(const std::filesystem::path& folder, const ScanStages& stages) {
  const std::size_t count = stages.image.size();
  for (const auto& [name, colour] : {std::pair("rows.ply", &of_row),
                                     {"segments.ply", &of_segment},
                                     {"roughness.ply", &of_roughness},
                                     {"features_large.ply", &of_large_set},
                                     {"features_small.ply", &of_small_set}})
    write_ply(folder / name, kProperties, count, records(stages, colour));
}

void write_stage_facts(const std::filesystem::path& folder, const ScanStages& stages,
                       const SensorModel& sensor, const std::string& input,
                       const std::string& summary) {
  const nlohmann::json facts = {{"input", input},
                                {"summary", summary},
                                {"rows", stages.image.rows},
                                {"columns", stages.image.columns},
                                {"elevation_deg", sensor.elevation_deg}};
  // A file name need not be UTF-8.
  write_file(folder / "stages.json",
             facts.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n");
}

}  // namespace lego_loam_sc
