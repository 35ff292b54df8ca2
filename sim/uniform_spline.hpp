// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace lego_loam_sc {

/// A uniform cubic B-spline: twice differentiable. It starts at the first and ends at the last of
/// its controls, passes near the others, and goes straight on beyond its ends.
template <class Value>
class UniformSpline {
 public:
  /// At least two controls, `spacing` apart in the parameter, the first at 0.
  UniformSpline(std::vector<Value> controls, double spacing)
      : controls_(std::move(controls)), spacing_(spacing) {}

  double end() const { return spacing_ * static_cast<double>(controls_.size() - 1); }

  Value at(double u) const {
    const double inside = std::clamp(u, 0.0, end());
    if (u != inside) return at(inside) + (u - inside) * derivative(inside);
    const auto [i, t] = place_of(u);
    const double s = 1.0 - t;
    return (s * s * s * control(i - 1) + (4.0 - 6.0 * t * t + 3.0 * t * t * t) * control(i) +
            (4.0 - 6.0 * s * s + 3.0 * s * s * s) * control(i + 1) + t * t * t * control(i + 2)) /
           6.0;
  }

  /// With respect to the parameter.
  Value derivative(double u) const {
    const auto [i, t] = place_of(std::clamp(u, 0.0, end()));
    const double s = 1.0 - t;
    return 0.5 / spacing_ *
           (s * s * (control(i) - control(i - 1)) +
            (1.0 + 2.0 * s * t) * (control(i + 1) - control(i)) +
            t * t * (control(i + 2) - control(i + 1)));
  }

 private:
  // The interval and the place within it, 0 to 1.
  std::pair<std::ptrdiff_t, double> place_of(double u) const {
    const double x = u / spacing_;
    const double i = std::min(std::floor(x), static_cast<double>(controls_.size() - 2));
    return {static_cast<std::ptrdiff_t>(i), x - i};
  }

  Value control(std::ptrdiff_t i) const {
    const auto last = static_cast<std::ptrdiff_t>(controls_.size()) - 1;
    if (i < 0) return 2.0 * controls_.front() - controls_[1];
    if (i > last) return 2.0 * controls_.back() - controls_[static_cast<std::size_t>(last - 1)];
    return controls_[static_cast<std::size_t>(i)];
  }

  std::vector<Value> controls_;
  double spacing_;
};

}  // namespace lego_loam_sc
