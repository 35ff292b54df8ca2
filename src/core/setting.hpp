// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <type_traits>
#include <utility>

/// Declares a setting: a data member with its default, its limits (none for a switch) and a comment
/// that begins with its unit.
///
///     struct KeyFrameSettings {
///       LEGO_LOAM_SC_SETTING(double, distance, 2.0, 0.01, 1000.0, "m since the last key frame");
///       LEGO_LOAM_SC_SETTING(bool, enabled, true, "off: every scan is one");
///     };
///
/// The struct stays an aggregate of plain numbers; visit_settings lists them. C++20 does not know
/// the names of members, so each declaration adds a function that does.
#define LEGO_LOAM_SC_SETTING(type, name, value, ...)                                        \
  template <class Self, class Visit>                                                        \
  static void visit_setting(lego_loam_sc::DeclaredAt<__LINE__>, Self& self, Visit& visit) { \
    visit(#name, self.name, __VA_ARGS__);                                                   \
  }                                                                                         \
  type name = value

namespace lego_loam_sc {

/// Lines of a header that may declare settings.
constexpr int kMaxSettingLine = 256;

/// Where a setting is declared, which orders those of a struct.
template <int Line>
  requires(Line < kMaxSettingLine)
struct DeclaredAt {};

/// Calls visit(name, value, minimum, maximum, comment) for each number and visit(name, value,
/// comment) for each switch that a struct declares, in their order. Not for structs within it.
template <class Group, class Visit>
void visit_settings(Group& group, Visit&& visit) {
  const auto visit_line = [&]<int Line>(DeclaredAt<Line> line) {
    if constexpr (requires { std::remove_const_t<Group>::visit_setting(line, group, visit); })
      std::remove_const_t<Group>::visit_setting(line, group, visit);
  };
  [&]<int... Line>(std::integer_sequence<int, Line...>) {
    (visit_line(DeclaredAt<Line>{}), ...);
  }(std::make_integer_sequence<int, kMaxSettingLine>{});
}

}  // namespace lego_loam_sc
