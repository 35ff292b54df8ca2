// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/stage_files.hpp"
#include "io/atomic_file.hpp"

namespace lego_loam_sc {

// src/app/stage_page.html, compiled in.
extern const char* const kStagePage;

namespace {

constexpr std::string_view kPlaceholder = "\"STAGES\"";

// In thousandths, which are short to write; null where it is not defined.
nlohmann::json thousandths(float value) {
  return std::isfinite(value) ? nlohmann::json(std::llround(1e3 * value)) : nlohmann::json();
}

// A list over the pixels, null where nothing was seen.
template <class ValueOf>
nlohmann::json layer(const RangeImage& image, ValueOf&& value_of) {
  nlohmann::json list = nlohmann::json::array();
  for (const std::int32_t point : image.pixels)
    list.push_back(point < 0 ? nlohmann::json() : nlohmann::json(value_of(point)));
  return list;
}

}  // namespace

void write_stage_page(const std::filesystem::path& folder, const ScanStages& stages,
                      const SensorModel& sensor, const std::string& summary) {
  const RangeImage& image = stages.image;
  std::vector<std::uint32_t> counts;
  for (int row = 0; row < image.rows; ++row)
    counts.push_back(image.row_begin[row + 1] - image.row_begin[row]);
  const nlohmann::json data = {
      {"summary", summary},
      {"rows", image.rows},
      {"columns", image.columns},
      {"elevation_deg", sensor.elevation_deg},
      {"points", counts},
      {"range", layer(image, [&](int i) { return thousandths(image.range[i]); })},
      {"intensity", layer(image, [&](int i) { return thousandths(image.intensity[i]); })},
      {"ground",
       layer(image, [&](int i) { return stages.segmentation.label[i] == Label::ground ? 1 : 0; })},
      {"cluster", layer(image, [&](int i) { return stages.segmentation.cluster[i]; })},
      {"sharpness", layer(image, [&](int i) { return thousandths(stages.sharpness[i]); })},
      {"feature", layer(image, [&](int i) { return static_cast<int>(stages.feature_set[i]); })}};
  std::string page = kStagePage;
  std::string text = data.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  // A file name in the summary could end the script.
  for (std::size_t at = 0; (at = text.find("</", at)) != text.npos; at += 3)
    text.insert(at + 1, "\\");
  page.replace(page.find(kPlaceholder), kPlaceholder.size(), text);
  write_file(folder / "index.html", page);
}

}  // namespace lego_loam_sc
