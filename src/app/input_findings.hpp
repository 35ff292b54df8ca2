// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "slam/slam.hpp"

namespace lego_loam_sc {

/// What a run has found of its input that the user should know, a sentence each with what to
/// change; none of a good recording.
std::vector<std::string> input_sentences(const Slam& slam);

/// The same in numbers, for summary.json.
nlohmann::ordered_json input_json(const Slam& slam);

}  // namespace lego_loam_sc
