// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>

namespace lego_loam_sc {

/// A file, a setting or an argument is invalid, or a result cannot be written. The message is one
/// sentence: what, where, and what to change. The application prints it and exits with 1.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace lego_loam_sc
