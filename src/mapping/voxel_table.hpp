// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Core>

namespace lego_loam_sc {

/// The cell of a grid that holds a point, packed into 63 bits: 21 signed bits for each axis.
using VoxelKey = std::uint64_t;

constexpr std::int64_t kMaxCell = (1 << 20) - 1;

constexpr VoxelKey pack_cell(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto bits = [](std::int64_t v) { return static_cast<VoxelKey>(v) & 0x1fffff; };
  return bits(x) << 42 | bits(y) << 21 | bits(z);
}

/// The key of a point scaled to units of cells; nothing for a point out of the grid's range or not
/// finite, which must never alias into it.
inline std::optional<VoxelKey> key_of(const Eigen::Vector3d& scaled) {
  const Eigen::Vector3d cell = scaled.array().floor();
  if (!(cell.array().abs() < static_cast<double>(kMaxCell)).all()) return std::nullopt;
  return pack_cell(static_cast<std::int64_t>(cell.x()), static_cast<std::int64_t>(cell.y()),
                   static_cast<std::int64_t>(cell.z()));
}

/// A hash table from cells to values: open addressing, values in one array in the order of their
/// insertion, which is the only order that it can be walked in.
template <class Value>
class VoxelTable {
 public:
  std::size_t size() const { return values_.size(); }
  const std::vector<VoxelKey>& keys() const { return keys_; }
  const std::vector<Value>& values() const { return values_; }

  /// Makes room for this many values.
  void reserve(std::size_t count) {
    std::size_t slots = kFewestSlots;
    while (slots < 2 * (count + 1)) slots *= 2;
    if (slots > slots_.size()) rebuild(slots);
    keys_.reserve(count);
    values_.reserve(count);
  }

  Value* find(VoxelKey key) {
    if (slots_.empty()) return nullptr;
    for (std::size_t s = first_slot(key);; s = (s + 1) & mask()) {
      if (slots_[s].index == kEmpty) return nullptr;
      if (slots_[s].key == key) return &values_[slots_[s].index];
    }
  }

  /// The value of the cell and whether it was made by this call.
  std::pair<Value&, bool> find_or_insert(VoxelKey key) {
    if (2 * (values_.size() + 1) > slots_.size()) grow();
    std::size_t s = first_slot(key);
    for (; slots_[s].index != kEmpty; s = (s + 1) & mask())
      if (slots_[s].key == key) return {values_[slots_[s].index], false};
    slots_[s] = {key, static_cast<std::uint32_t>(values_.size())};
    keys_.push_back(key);
    values_.emplace_back();
    return {values_.back(), true};
  }

  /// Keeps the values for which keep(value) holds, in their order.
  template <class Keep>
  void retain(Keep&& keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!keep(values_[i])) continue;
      values_[kept] = std::move(values_[i]);
      keys_[kept] = keys_[i];
      ++kept;
    }
    values_.resize(kept);
    keys_.resize(kept);
    rebuild(slots_.size());
  }

  void clear() {
    keys_.clear();
    values_.clear();
    rebuild(slots_.size());
  }

 private:
  struct Slot {
    VoxelKey key = 0;
    std::uint32_t index = kEmpty;
  };
  static constexpr std::uint32_t kEmpty = 0xffffffff;
  static constexpr std::size_t kFewestSlots = 1024;

  std::size_t mask() const { return slots_.size() - 1; }

  // Fibonacci hashing of the mixed key: neighbouring cells spread over the table.
  std::size_t first_slot(VoxelKey key) const {
    key ^= key >> 29;
    key *= 0x9e3779b97f4a7c15ull;
    key ^= key >> 32;
    return key & mask();
  }

  void grow() { rebuild(slots_.empty() ? kFewestSlots : 2 * slots_.size()); }

  void rebuild(std::size_t slots) {
    slots_.assign(slots, Slot{});
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      std::size_t s = first_slot(keys_[i]);
      while (slots_[s].index != kEmpty) s = (s + 1) & mask();
      slots_[s] = {keys_[i], static_cast<std::uint32_t>(i)};
    }
  }

  std::vector<Slot> slots_;
  std::vector<VoxelKey> keys_;
  std::vector<Value> values_;
};

}  // namespace lego_loam_sc
