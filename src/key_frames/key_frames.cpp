// SPDX-License-Identifier: BSD-3-Clause
#include "key_frames/key_frames.hpp"

#include <span>
#include <utility>

#include "features/features.hpp"

namespace lego_loam_sc {

KeyFrames::KeyFrames(std::shared_ptr<BlobStore> store)
    : store_(store ? std::move(store) : std::make_shared<MemoryBlobs>()) {
  clear();
}

void KeyFrames::clear() {
  entries_.clear();
  store_->clear();
}

void KeyFrames::add(const KeyFrame& key_frame) {
  Entry entry{key_frame.reference_ns, key_frame.travelled, store_->size(), {}};
  const auto all = clouds(key_frame);
  for (std::size_t c = 0; c < kClouds; ++c) {
    entry.counts[c] = static_cast<std::uint32_t>(all[c]->size());
    store_->append(std::as_bytes(std::span(*all[c])));
  }
  entries_.push_back(entry);
}

KeyFrame KeyFrames::operator[](std::size_t k) const {
  return load(entries_[k], kClouds);
}

Features KeyFrames::features(std::size_t k) const {
  return unpack(load(entries_[k], kClouds - 1));
}

// With the first `count` of its clouds.
KeyFrame KeyFrames::load(const Entry& entry, std::size_t count) const {
  KeyFrame key_frame;
  key_frame.reference_ns = entry.reference_ns;
  key_frame.travelled = entry.travelled;
  std::uint64_t offset = entry.offset;
  const auto all = clouds(key_frame);
  for (std::size_t c = 0; c < count; ++c) {
    all[c]->resize(entry.counts[c]);
    const std::span<std::byte> bytes = std::as_writable_bytes(std::span(*all[c]));
    store_->read(offset, bytes);
    offset += bytes.size();
  }
  return key_frame;
}

}  // namespace lego_loam_sc
