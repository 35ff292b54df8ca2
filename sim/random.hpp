// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace lego_loam_sc {

/// Hashes a 64-bit value (the finaliser of splitmix64), or several numbers to a key.
constexpr std::uint64_t hash(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15ULL;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ULL;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebULL;
  return x ^ (x >> 31);
}
template <class... More>
constexpr std::uint64_t hash(std::uint64_t first, std::uint64_t second, More... more) {
  return hash(hash(first) ^ second, more...);
}

/// A sequence of random numbers determined by its key alone. Construction is free, so every ray has
/// its own, and the result does not depend on the number of threads. The distributions of the
/// standard library differ between implementations, hence these. Draw once per statement or within
/// braces: the evaluation order of function arguments is unspecified.
class Random {
 public:
  explicit Random(std::uint64_t key) : key_(key) {}

  /// In [0, 1).
  double uniform() { return static_cast<double>(hash(key_, counter_++) >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  bool chance(double probability) { return uniform() < probability; }

  /// Mean 0, sigma 1 (Box-Muller).
  double gaussian() {
    const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
    return radius * std::cos(2.0 * std::numbers::pi * uniform());
  }

 private:
  std::uint64_t key_;
  std::uint64_t counter_ = 0;
};

}  // namespace lego_loam_sc
