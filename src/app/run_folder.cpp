// SPDX-License-Identifier: BSD-3-Clause
#include "app/run_folder.hpp"

#include <system_error>

#include "core/error.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error)
    throw InputError(folder.string() + ": cannot be made (" + error.message() +
                     "); choose another folder with -o");
}

std::string run_name(const std::string& input) {
  if (input == "-") return "stream";
  fs::path path = fs::path(input).lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  const std::string name = path.stem().string();
  return name.empty() || name == "." || name == ".." ? "run" : name;
}

}  // namespace

fs::path make_run_folder(const std::optional<fs::path>& asked, const std::string& input) {
  if (asked) {
    std::error_code error;
    const bool empty = fs::is_directory(*asked, error) && fs::is_empty(*asked, error);
    if (fs::exists(*asked, error) && !empty)
      throw InputError(asked->string() +
                       ": is there already and not an empty folder; a run never overwrites, choose "
                       "another -o");
    create(*asked);
    return *asked;
  }
  const fs::path runs = "runs";
  create(runs);
  for (int number = 1;; ++number) {
    const fs::path name = run_name(input) + "-" + std::to_string(number);
    std::error_code error;
    if (!fs::create_directory(runs / name, error)) {
      if (error)
        throw InputError((runs / name).string() + ": cannot be made (" + error.message() +
                         "); choose a folder with -o");
      continue;
    }
    fs::remove(runs / "latest", error);
    fs::create_directory_symlink(name, runs / "latest", error);  // a convenience: may fail
    return runs / name;
  }
}

}  // namespace lego_loam_sc
