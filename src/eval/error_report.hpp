// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "eval/errors.hpp"

namespace lego_loam_sc {

/// The errors of one estimate. Names end with the unit; errors that need a longer path are null.
nlohmann::ordered_json to_json(const TrajectoryError& error);

struct NamedError {
  std::string name;  ///< of the estimate
  TrajectoryError error;
};

/// A table for the terminal: one line per kind of error, one column per estimate.
std::string error_table(std::span<const NamedError> estimates);

}  // namespace lego_loam_sc
