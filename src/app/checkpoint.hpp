// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/state_archive.hpp"
#include "io/append_file.hpp"

namespace lego_loam_sc {

/// What a run that is killed leaves for `--resume`, in two files of its folder: `checkpoint` is
/// replaced as a whole each time, `checkpoint.growth` gets what has grown. An empty `checkpoint`
/// marks the folder of a run that has not come far enough.
class Checkpoint {
 public:
  /// Marks the folder unless it is marked.
  explicit Checkpoint(const std::filesystem::path& folder);

  static bool marks(const std::filesystem::path& folder);

  /// Whether there is a state to be loaded.
  bool holds_state() const;

  /// Calls `read` with the state. Throws InputError when the files are damaged or another
  /// program's.
  void load(const std::function<void(StateReader&)>& read);

  /// Saves what `write` writes, unless it returns false. Throws InputError when the disk is full.
  void save(const std::function<bool(StateWriter&)>& write);

  /// For a run that is done.
  void remove();

 private:
  std::filesystem::path state_path_;
  std::filesystem::path growth_path_;
  std::optional<AppendFile> growth_;
  std::uint64_t growth_hash_;
  GrownCounts counts_;
};

}  // namespace lego_loam_sc
