// SPDX-License-Identifier: BSD-3-Clause
#include "app/input_findings.hpp"

#include <nlohmann/json.hpp>

#include "core/text.hpp"

namespace lego_loam_sc {
namespace {

// A body that is less than this share of the points may be what went along for a while.
constexpr double kLeastShare = 0.005;
// Sweeps longer than the gap between scans are said when they are this share of all.
constexpr double kLongSweeps = 0.2;

double share_of(std::size_t points, const ScanFindings& findings) {
  return findings.points > 0 ? static_cast<double>(points) / static_cast<double>(findings.points)
                             : 0.0;
}

std::string percent(double share) {
  return to_fixed(100.0 * share, 1) + " %";
}

}  // namespace

std::vector<std::string> input_sentences(const Slam& slam) {
  const ScanFindings& found = slam.findings();
  std::vector<std::string> sentences;
  if (found.filler_points > 0 && found.filler_range > 0.0)
    sentences.push_back(percent(share_of(found.filler_points, found)) +
                        " of the points lie at the same range of " +
                        to_fixed(found.filler_range, 2) +
                        " m in all directions: they stand for no return and were left out; switch "
                        "them off in the driver, or set max_range of the sensor below that");
  if (share_of(found.body_points, found) >= kLeastShare)
    sentences.push_back(percent(share_of(found.body_points, found)) +
                        " of the points move with the sensor, nearly all within " +
                        to_fixed(found.body_range, 1) +
                        " m: they are the vehicle's own body and were left out; min_range of the "
                        "sensor beyond it leaves them out from the first scan on");
  if (found.time_factor != 1.0)
    sentences.push_back("the times of the points were " + to_fixed(1.0 / found.time_factor, 0) +
                        " times longer than a sweep can last and were divided by it; give the unit "
                        "as point_times in dataset.yaml, or correct it in the driver");
  else if (found.long_sweeps > kLongSweeps * found.sweeps)
    sentences.push_back("the times of the points span more than the time to the next scan in " +
                        std::to_string(found.long_sweeps) + " of " + std::to_string(found.sweeps) +
                        " scans, which no sweep does; check the stamps and point_times in "
                        "dataset.yaml");
  if (!slam.sweep_check().fits())
    sentences.emplace_back(
        "the times of the points do not fit the motion, scans would fit the map better without "
        "them: they run backwards, or the scans are motion compensated already; correct them in "
        "the driver, or set motion_compensated: true in dataset.yaml");
  return sentences;
}

nlohmann::ordered_json input_json(const Slam& slam) {
  const ScanFindings& found = slam.findings();
  const SweepCheck& check = slam.sweep_check();
  nlohmann::ordered_json json = {
      {"fillers",
       {{"share", share_of(found.filler_points, found)}, {"range_m", found.filler_range}}},
      {"body", {{"share", share_of(found.body_points, found)}, {"range_m", found.body_range}}},
      {"times",
       {{"fit", check.fits()},
        {"factor", nullptr},
        {"factor_sigma", nullptr},
        {"applied_factor", found.time_factor},
        {"sweeps_too_long", found.long_sweeps}}}};
  if (check.scans() >= 2) {
    json["times"]["factor"] = check.factor();
    json["times"]["factor_sigma"] = check.standard_error();
  }
  return json;
}

}  // namespace lego_loam_sc
