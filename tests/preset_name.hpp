// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>

#include <string>

namespace lego_loam_sc {

/// The name of a test for each preset, which may have letters and digits only.
inline std::string preset_name(const testing::TestParamInfo<std::string>& info) {
  std::string name = info.param;
  std::erase(name, '-');
  return name;
}

}  // namespace lego_loam_sc
