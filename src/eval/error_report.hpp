// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "eval/errors.hpp"

namespace lego_loam_sc {

/// The errors of one estimate; the last part of a name is its unit, and what the path is too short
/// for is null.
nlohmann::ordered_json to_json(const TrajectoryError& error);

struct NamedError {
  std::string name;  ///< of the estimate
  TrajectoryError error;
};

/// For people: one line for each kind of error, one column for each estimate.
std::string error_table(std::span<const NamedError> estimates);

}  // namespace lego_loam_sc
