// SPDX-License-Identifier: BSD-3-Clause
#include "app/checkpoint.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "core/error.hpp"
#include "io/atomic_file.hpp"
#include "io/bytes.hpp"
#include "io/file.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMagic = "lego-loam-sc checkpoint\n";

// FNV-1a.
constexpr std::uint64_t kEmptyHash = 0xcbf29ce484222325;
std::uint64_t extend_hash(std::uint64_t hash, std::string_view bytes) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3;
  return hash;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw InputError(path.string() + ": " + what +
                   "; the run cannot be resumed, start it again in another folder");
}

struct Head {
  std::string version = LEGO_LOAM_SC_VERSION;
  std::uint64_t growth_size = 0;
  std::uint64_t growth_hash = kEmptyHash;

  template <class Archive>
  void state(Archive& archive) {
    archive(version, growth_size, growth_hash);
  }
};

}  // namespace

Checkpoint::Checkpoint(const fs::path& folder)
    : state_path_(folder / "checkpoint"),
      growth_path_(folder / "checkpoint.growth"),
      growth_hash_(kEmptyHash) {
  if (!marks(folder)) write_file(state_path_, "");
}

bool Checkpoint::marks(const fs::path& folder) {
  std::error_code error;
  return fs::is_regular_file(folder / "checkpoint", error);
}

bool Checkpoint::holds_state() const {
  std::error_code error;
  return fs::file_size(state_path_, error) > 0;
}

void Checkpoint::load(const std::function<void(StateReader&)>& read) {
  const std::string file = read_file(state_path_);
  constexpr std::size_t kHashed = kMagic.size() + sizeof(std::uint64_t);
  if (file.size() < kHashed || !file.starts_with(kMagic)) refuse(state_path_, "is no checkpoint");
  const std::string_view bytes = std::string_view(file).substr(kHashed);
  if (lego_loam_sc::load<std::uint64_t>(file.data() + kMagic.size()) !=
      extend_hash(kEmptyHash, bytes))
    refuse(state_path_, "is damaged");

  Head head;
  const std::string version = std::exchange(head.version, {});
  StateReader(bytes, {})(head);
  if (head.version != version)
    refuse(state_path_, "was written by version " + head.version + ", this is version " + version);
  std::string growth = read_file(growth_path_);
  if (growth.size() < head.growth_size) refuse(growth_path_, "is cut off");
  growth.resize(head.growth_size);
  if (extend_hash(kEmptyHash, growth) != head.growth_hash) refuse(growth_path_, "is damaged");

  StateReader reader(bytes, growth);
  try {
    reader(head);
    read(reader);
  } catch (const StateError& error) {
    refuse(state_path_, error.what());
  }
  growth_.emplace(growth_path_).cut(head.growth_size);
  growth_hash_ = head.growth_hash;
  counts_ = reader.counts();
}

void Checkpoint::save(const std::function<bool(StateWriter&)>& write) {
  if (!growth_) growth_.emplace(growth_path_).cut(0);
  const std::size_t size = growth_->size();
  std::uint64_t growth_hash = growth_hash_;
  StateWriter state(counts_, [&](std::string_view growth) {
    growth_->append(growth);
    growth_hash = extend_hash(growth_hash, growth);
  });
  if (!write(state)) {
    growth_->cut(size);
    return;
  }
  growth_hash_ = growth_hash;

  StateWriter head;
  head(Head{.growth_size = growth_->size(), .growth_hash = growth_hash_});
  std::string hash;
  append(hash, extend_hash(extend_hash(kEmptyHash, head.bytes()), state.bytes()));
  AtomicFile file(state_path_);
  file.write(kMagic);
  file.write(hash);
  file.write(head.bytes());
  file.write(state.bytes());
  file.commit();
  counts_ = state.counts();
}

void Checkpoint::remove() {
  growth_.reset();
  std::error_code error;
  fs::remove(state_path_, error);
  fs::remove(growth_path_, error);
}

}  // namespace lego_loam_sc
