// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/blob_store.hpp"
#include "key_frames/key_frame.hpp"

namespace lego_loam_sc {

/// The key frames of a drive in the order of time. What is asked for all the time is at hand, their
/// points lie in a store.
class KeyFrames {
 public:
  /// In memory without a store; empties it.
  explicit KeyFrames(std::shared_ptr<BlobStore> store = {});

  /// Adds the next key frame.
  void add(const KeyFrame& key_frame);

  /// Removes everything.
  void clear();

  /// Number of key frames.
  std::size_t size() const { return entries_.size(); }
  /// Reference time of key frame `k`.
  std::int64_t reference_ns(std::size_t k) const { return entries_[k].reference_ns; }
  double travelled(std::size_t k) const { return entries_[k].travelled; }  ///< m

  /// Loads key frame `k`.
  KeyFrame operator[](std::size_t k) const;
  /// unpack() of a key frame, whose other points are left alone.
  Features features(std::size_t k) const;

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    if constexpr (Archive::kReads) clear();
    archive.template grown<KeyFrame>(
        size(), [&](std::size_t k) { return (*this)[k]; },
        [&](const KeyFrame& key_frame) { add(key_frame); });
  }

 private:
  static constexpr std::size_t kClouds = 4;
  struct Entry {
    std::int64_t reference_ns = 0;
    double travelled = 0.0;
    std::uint64_t offset = 0;
    std::array<std::uint32_t, kClouds> counts{};  // points of each cloud, see clouds()
  };

  // The clouds of a key frame as they lie in the store, those for matching first.
  template <class Frame>
  static auto clouds(Frame& k) {
    return std::array{&k.planars, &k.edges, &k.scattered, &k.others};
  }
  KeyFrame load(const Entry& entry, std::size_t count) const;

  std::shared_ptr<BlobStore> store_;
  std::vector<Entry> entries_;
};

}  // namespace lego_loam_sc
