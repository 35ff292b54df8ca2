// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace lego_loam_sc {

/// A grid cell packed into 63 bits: 21 signed bits per axis.
using VoxelKey = std::uint64_t;

constexpr std::int64_t kMaxCell = (1 << 20) - 1;

/// A grid cell by its index along each axis, from -kMaxCell to kMaxCell.
using Cell = std::array<std::int64_t, 3>;

constexpr VoxelKey pack_cell(std::int64_t x, std::int64_t y, std::int64_t z) {
  const auto bits = [](std::int64_t v) { return static_cast<VoxelKey>(v) & 0x1fffff; };
  return bits(x) << 42 | bits(y) << 21 | bits(z);
}

constexpr VoxelKey pack_cell(const Cell& cell) {
  return pack_cell(cell[0], cell[1], cell[2]);
}

/// The cell of a key.
constexpr Cell unpack_cell(VoxelKey key) {
  const auto number = [](VoxelKey bits) {
    return static_cast<std::int64_t>(bits << 43) >> 43;  // the sign is the 21st bit
  };
  return {number(key >> 42), number(key >> 21), number(key)};
}

/// The cell of a point in units of cells; nothing for a point that is not finite or outside the
/// grid, so that it cannot alias into another cell. The outermost cells of the grid are not used.
inline std::optional<Cell> cell_of(const Eigen::Vector3d& scaled) {
  Cell cell;
  for (int axis = 0; axis < 3; ++axis) {
    const double v = scaled[axis];
    if (!(std::abs(v) < static_cast<double>(kMaxCell))) return std::nullopt;
    const auto towards_zero = static_cast<std::int64_t>(v);
    cell[axis] = towards_zero - (v < static_cast<double>(towards_zero) ? 1 : 0);
    if (cell[axis] == -kMaxCell) return std::nullopt;
  }
  return cell;
}

/// The key of the cell of a point in units of cells.
inline std::optional<VoxelKey> key_of(const Eigen::Vector3d& scaled) {
  const std::optional<Cell> cell = cell_of(scaled);
  if (!cell) return std::nullopt;
  return pack_cell(*cell);
}

/// A hash table from cells to values with open addressing. Values lie in one array in order of
/// insertion, the only order of iteration: results do not depend on the hash.
template <class Value>
class VoxelTable {
 public:
  /// Number of entries.
  std::size_t size() const { return values_.size(); }
  /// In the order of their insertion.
  const std::vector<VoxelKey>& keys() const { return keys_; }
  /// In the order of the keys.
  const std::vector<Value>& values() const { return values_; }

  /// Reserves memory for `count` values.
  void reserve(std::size_t count) {
    std::size_t slots = kMinSlots;
    while (slots < 2 * (count + 1)) slots *= 2;
    if (slots > slots_.size()) rebuild(slots);
    keys_.reserve(count);
    values_.reserve(count);
  }

  /// The value of a cell, or null.
  const Value* find(VoxelKey key) const {
    if (slots_.empty()) return nullptr;
    for (std::size_t s = first_slot(key);; s = (s + 1) & mask()) {
      if (slots_[s].index == kEmpty) return nullptr;
      if (slots_[s].key == key) return &values_[slots_[s].index];
    }
  }

  /// Prefetches the slot of a cell for a later find.
  void prefetch(VoxelKey key) const {
    if (!slots_.empty()) __builtin_prefetch(&slots_[first_slot(key)]);
  }

  /// Prefetches the value of a cell, once its slot has been prefetched.
  void prefetch_value(VoxelKey key) const {
    if (slots_.empty()) return;
    const Slot& slot = slots_[first_slot(key)];
    if (slot.index != kEmpty) __builtin_prefetch(&values_[slot.index]);
  }

  /// The value of a cell and whether this call inserted it.
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

  /// Keeps the values of the cells for which keep(key) is true, in their order.
  template <class Keep>
  void retain(Keep&& keep) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      if (!keep(keys_[i])) continue;
      values_[kept] = std::move(values_[i]);
      keys_[kept] = keys_[i];
      ++kept;
    }
    values_.resize(kept);
    keys_.resize(kept);
    rebuild(slots_.size());
  }

  /// Removes everything.
  void clear() {
    keys_.clear();
    values_.clear();
    rebuild(slots_.size());
  }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(keys_, values_);
    if constexpr (Archive::kReads) {
      slots_.clear();
      reserve(keys_.size());
    }
  }

 private:
  struct Slot {
    VoxelKey key = 0;
    std::uint32_t index = kEmpty;
  };
  static constexpr std::uint32_t kEmpty = 0xffffffff;
  static constexpr std::size_t kMinSlots = 1024;

  std::size_t mask() const { return slots_.size() - 1; }

  // Fibonacci hashing of the mixed key. The eight cells of a 2 x 2 x 2 cube are adjacent in memory,
  // since they are read together.
  std::size_t first_slot(VoxelKey key) const {
    const std::size_t corner = (key & 1) | (key >> 20 & 2) | (key >> 40 & 4);
    VoxelKey cube = key & ~pack_cell(1, 1, 1);
    cube ^= cube >> 29;
    cube *= 0x9e3779b97f4a7c15ull;
    cube ^= cube >> 32;
    return (cube << 3 | corner) & mask();
  }

  void grow() { rebuild(slots_.empty() ? kMinSlots : 2 * slots_.size()); }

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
