// SPDX-License-Identifier: BSD-3-Clause
#include "eval/error_report.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "core/text.hpp"

namespace lego_loam_sc {
namespace {

using Json = nlohmann::ordered_json;

struct Line {
  const char* label;
  const char* pointer;  // into the JSON of an estimate
  int decimals;
};

constexpr Line kLines[] = {
    {"poses compared", "/pairs", 0},
    {"length of the truth (m)", "/truth_length_m", 3},
    {"length of the estimate (m)", "/estimate_length_m", 3},
    {"ATE rmse (m)", "/ate_m/rmse", 6},
    {"ATE mean (m)", "/ate_m/mean", 6},
    {"ATE median (m)", "/ate_m/median", 6},
    {"ATE max (m)", "/ate_m/max", 6},
    {"ATE rmse without alignment (m)", "/ate_unaligned_m/rmse", 6},
    {"RPE rmse per frame (m)", "/rpe_frame/translation_m/rmse", 6},
    {"RPE rmse per frame (deg)", "/rpe_frame/rotation_deg/rmse", 6},
    {"RPE rmse per metre (m)", "/rpe_metre/translation_m/rmse", 6},
    {"RPE rmse per metre (deg)", "/rpe_metre/rotation_deg/rmse", 6},
    {"KITTI t_rel (%)", "/kitti/t_rel_percent", 4},
    {"KITTI r_rel (deg/100 m)", "/kitti/r_rel_deg_per_100m", 4},
    {"end error x (m)", "/end/x_m", 4},
    {"end error y (m)", "/end/y_m", 4},
    {"end error z (m)", "/end/z_m", 4},
    {"end error (deg)", "/end/rotation_deg", 4},
    {"first to last pose, truth (m)", "/first_to_last/truth_m", 4},
    {"first to last pose, estimate (m)", "/first_to_last/estimate_m", 4},
};

Json statistics_json(const Statistics& statistics) {
  return {{"rmse", statistics.rmse},
          {"mean", statistics.mean},
          {"median", statistics.median},
          {"min", statistics.min},
          {"max", statistics.max}};
}

Json relative_json(const RelativeError& error) {
  return {{"translation_m", statistics_json(error.translation)},
          {"rotation_deg", statistics_json(error.rotation_deg)}};
}

Json kitti_json(const KittiError& error) {
  return {{"t_rel_percent", error.translation_percent},
          {"r_rel_deg_per_100m", error.rotation_deg_per_100m},
          {"segments", error.segments}};
}

Json end_json(const EndError& error) {
  return {{"x_m", error.translation.x()},
          {"y_m", error.translation.y()},
          {"z_m", error.translation.z()},
          {"rotation_deg", error.rotation_deg}};
}

std::string cell(const Json& errors, const Line& line) {
  const Json::json_pointer pointer(line.pointer);
  if (!errors.contains(pointer)) return "path too short";
  return to_fixed(errors[pointer].get<double>(), line.decimals);
}

std::string padded_left(const std::string& text, std::size_t width) {
  return std::string(width - std::min(width, text.size()), ' ') + text;
}

}  // namespace

Json to_json(const TrajectoryError& error) {
  return {{"pairs", error.pairs},
          {"truth_length_m", error.truth_length},
          {"estimate_length_m", error.estimate_length},
          {"ate_m", statistics_json(error.ate)},
          {"ate_unaligned_m", statistics_json(error.ate_unaligned)},
          {"rpe_frame", relative_json(error.rpe_frame)},
          {"rpe_metre", error.rpe_metre ? relative_json(*error.rpe_metre) : Json()},
          {"kitti", error.kitti ? kitti_json(*error.kitti) : Json()},
          {"end", end_json(error.end)},
          {"first_to_last",
           {{"truth_m", error.truth_first_to_last}, {"estimate_m", error.estimate_first_to_last}}}};
}

std::string error_table(std::span<const NamedError> estimates) {
  std::size_t label_width = 0;
  for (const Line& line : kLines)
    label_width = std::max(label_width, std::string(line.label).size());
  std::vector<Json> errors;
  std::vector<std::size_t> widths;
  std::string table(label_width, ' ');
  for (const NamedError& estimate : estimates) {
    errors.push_back(to_json(estimate.error));
    widths.push_back(std::max<std::size_t>(estimate.name.size(), 14));
    table += "  " + padded_left(estimate.name, widths.back());
  }
  for (const Line& line : kLines) {
    std::string label = line.label;
    label.resize(label_width, ' ');
    table += "\n" + label;
    for (std::size_t i = 0; i < errors.size(); ++i)
      table += "  " + padded_left(cell(errors[i], line), widths[i]);
  }
  return table + "\n";
}

}  // namespace lego_loam_sc
