// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "core/state_archive.hpp"
#include "io/append_file.hpp"

namespace lego_loam_sc {

/// The state that a killed run leaves for `--resume`, in two files of its folder: `checkpoint` is
/// replaced at each save, `checkpoint.growth` is appended to. An empty `checkpoint` marks the
/// folder of a run that was killed before its first save.
class Checkpoint {
 public:
  /// Marks the folder if it is not marked yet.
  explicit Checkpoint(const std::filesystem::path& folder);

  static bool marks(const std::filesystem::path& folder);

  /// True when there is a state to load.
  bool holds_state() const;

  /// Calls `read` with the state. Throws InputError when the files are damaged or of another
  /// version.
  void load(const std::function<void(StateReader&)>& read);

  /// Saves what `write` writes, unless it returns false. Throws InputError when the disk is full.
  void save(const std::function<bool(StateWriter&)>& write);

  /// Removes both files when the run is complete.
  void remove();

 private:
  std::filesystem::path state_path_;
  std::filesystem::path growth_path_;
  std::optional<AppendFile> growth_;
  std::uint64_t growth_hash_;
  GrownCounts counts_;
};

}  // namespace lego_loam_sc
