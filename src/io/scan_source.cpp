// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan_source.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <set>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/text.hpp"
#include "io/bin.hpp"
#include "io/file.hpp"
#include "io/pcd.hpp"
#include "io/ply.hpp"
#include "io/point_times.hpp"
#include "io/scan_stream.hpp"

namespace lego_loam_sc {
namespace {

namespace fs = std::filesystem;

constexpr std::int64_t kAssumedPeriodNs = 100'000'000;
constexpr std::size_t kScansForTimeUnit = 10;  // read at most to determine the unit of times

bool is_scan(const fs::path& path) {
  return path.extension() == ".bin" || path.extension() == ".pcd" || path.extension() == ".ply";
}

class FileSource : public ScanSource {
 public:
  /// `stamps_ns` has one stamp per file or is empty.
  FileSource(std::vector<fs::path> files, std::vector<std::int64_t> stamps_ns, DatasetFacts facts)
      : files_(std::move(files)), stamps_ns_(std::move(stamps_ns)) {
    facts_ = std::move(facts);
    if (stamps_ns_.empty() && files_.size() > 1)
      notes_.emplace_back(
          "there is no times.txt: stamps come from absolute point times, or else scans are 0.1 s "
          "apart");
  }

  std::optional<std::size_t> size() const override { return files_.size(); }

  std::optional<Scan> next() override {
    if (next_ == files_.size()) return std::nullopt;
    const std::size_t index = next_++;  // advances past an invalid scan, too
    StampHint hint;
    hint.certain = !stamps_ns_.empty();
    hint.stamp_ns =
        hint.certain ? stamps_ns_[index] : static_cast<std::int64_t>(index) * kAssumedPeriodNs;
    hint.unit = facts_.point_times ? facts_.point_times : unit_;
    return read(files_[index], hint);
  }

 private:
  Scan read(const fs::path& file, const StampHint& hint) {
    if (file.extension() == ".bin") {
      Scan scan = read_bin(file);
      scan.stamp_ns = hint.stamp_ns;
      return scan;
    }
    RawScan raw = read_points(file);
    PointTimes times = interpret(raw, hint, file);
    raw.scan.stamp_ns = times.stamp_ns;
    raw.scan.offset_ns = std::move(times.offset_ns);
    leave_out(times.stray, file, raw.scan);
    // One driver wrote all scans, so the unit found in a full sweep holds for sparse scans too.
    if (times.unit && !unit_) {
      unit_ = times.unit;
      notes_.push_back(std::move(times.decision));
    } else if (!times.unit && !raw.time.empty() && !missing_times_noted_) {
      missing_times_noted_ = true;
      notes_.push_back(file.filename().string() + ": " + times.decision);
    }
    return std::move(raw.scan);
  }

  void leave_out(std::span<const std::uint32_t> stray, const fs::path& file, Scan& scan) {
    for (const std::uint32_t i : stray)
      scan.points[i].setConstant(std::numeric_limits<float>::quiet_NaN());
    if (stray.empty() || stray_times_noted_) return;
    stray_times_noted_ = true;
    notes_.push_back(file.filename().string() + ": " + std::to_string(stray.size()) +
                     " points are left out, their times are far outside of the sweep; so are "
                     "those of further scans");
  }

  static RawScan read_points(const fs::path& file) {
    return file.extension() == ".pcd" ? read_pcd(file) : read_ply(file);
  }

  PointTimes interpret(const RawScan& raw, StampHint hint, const fs::path& file) const {
    try {
      return interpret_point_times(raw.time, raw.time_type, hint, file.string());
    } catch (const InputError&) {
      if (!hint.unit) hint.unit = unit_of_next_files(hint);
      if (!hint.unit) throw;
    }
    return interpret_point_times(raw.time, raw.time_type, hint, file.string());
  }

  // The first scans may be too short to determine the unit.
  std::optional<TimeUnit> unit_of_next_files(const StampHint& hint) const {
    const std::size_t end = std::min(next_ + kScansForTimeUnit - 1, files_.size());
    for (std::size_t index = next_; index < end; ++index) {
      try {
        const RawScan raw = read_points(files_[index]);
        const PointTimes times = interpret_point_times(raw.time, raw.time_type, hint, "");
        if (times.unit) return times.unit;
      } catch (const InputError&) {
        continue;  // reported when it is read itself
      }
    }
    return std::nullopt;
  }

  std::vector<fs::path> files_;
  std::vector<std::int64_t> stamps_ns_;
  std::size_t next_ = 0;
  std::optional<TimeUnit> unit_;
  bool missing_times_noted_ = false;
  bool stray_times_noted_ = false;
};

class StreamSource : public ScanSource {
 public:
  StreamSource(std::istream& in, const std::string& name) : reader_(in, name) {
    facts_ = reader_.facts();
  }
  std::optional<Scan> next() override {
    std::optional<Scan> scan = reader_.next();
    if (scan && !missing_times_noted_ && !scan->offset_ns.empty() && !are_times(scan->offset_ns)) {
      missing_times_noted_ = true;
      notes_.push_back("the points have no times: the offsets of the scan at " +
                       std::to_string(scan->stamp_ns) + " ns are all the same");
    }
    return scan;
  }

 private:
  ScanStreamReader reader_;
  bool missing_times_noted_ = false;
};

// The file must be opened before the reader is constructed and outlive it, so it is a base class.
struct OpenFile {
  explicit OpenFile(const fs::path& path) : file(path, std::ios::binary) {}
  std::ifstream file;
};

class StreamFileSource : private OpenFile, public StreamSource {
 public:
  explicit StreamFileSource(const fs::path& path)
      : OpenFile(path), StreamSource(file, path.string()) {}
};

std::vector<fs::path> list_scans(const fs::path& folder) {
  std::vector<fs::path> files;
  std::set<std::string> kinds;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    std::error_code unreadable;
    if (!is_scan(entry.path()) || !entry.is_regular_file(unreadable)) continue;
    files.push_back(entry.path());
    kinds.insert(entry.path().extension().string());
  }
  if (files.empty())
    throw InputError(folder.string() +
                     " contains no scans; give a folder with .bin, .pcd or .ply files, or one with "
                     "velodyne/*.bin");
  if (kinds.size() > 1)
    throw InputError(folder.string() + " contains scans of different kinds (" +
                     join(std::vector<std::string>(kinds.begin(), kinds.end())) +
                     "); keep only one kind");
  std::sort(files.begin(), files.end(), [](const fs::path& a, const fs::path& b) {
    return natural_less(a.filename().string(), b.filename().string());
  });
  return files;
}

std::vector<std::int64_t> read_times(const fs::path& path, std::size_t scans) {
  std::vector<std::int64_t> stamps = parse_scan_times(read_file(path), path.string());
  if (stamps.size() != scans)
    throw InputError(path.string() + " has " + std::to_string(stamps.size()) + " times for " +
                     std::to_string(scans) + " scans; it must have one line per scan");
  return stamps;
}

std::unique_ptr<ScanSource> open_folder(const fs::path& folder) {
  const bool has_velodyne = fs::is_directory(folder / "velodyne");
  std::vector<fs::path> files = list_scans(has_velodyne ? folder / "velodyne" : folder);
  DatasetFacts facts = read_dataset_facts(folder);
  facts.kitti = has_velodyne && files.front().extension() == ".bin";
  std::vector<std::int64_t> stamps;
  if (fs::exists(folder / "times.txt")) stamps = read_times(folder / "times.txt", files.size());
  return std::make_unique<FileSource>(std::move(files), std::move(stamps), std::move(facts));
}

bool is_scan_stream(const fs::path& path) {
  std::array<char, kScanStreamMagic.size()> magic{};
  std::ifstream(path, std::ios::binary).read(magic.data(), magic.size());
  return std::string_view(magic.data(), magic.size()) == kScanStreamMagic;
}

}  // namespace

std::unique_ptr<ScanSource> open_scans(const std::string& input) {
  if (input == "-") return std::make_unique<StreamSource>(std::cin, "standard input");
  const fs::path path(input);
  try {
    if (!fs::exists(path))
      throw InputError(input + " does not exist; give a folder of scans, a scan or - for a stream");
    if (fs::is_directory(path)) return open_folder(path);
    if (is_scan(path))
      return std::make_unique<FileSource>(std::vector{path}, std::vector<std::int64_t>{},
                                          read_dataset_facts(path.parent_path()));
    if (is_scan_stream(path)) return std::make_unique<StreamFileSource>(path);
  } catch (const fs::filesystem_error& error) {
    throw InputError(input + " cannot be read: " + error.code().message());
  }
  throw InputError(
      input +
      " is neither a folder of scans, a .bin, .pcd or .ply scan nor a scan stream; other "
      "recordings are read through the companion package");
}

std::vector<std::int64_t> parse_scan_times(std::string_view text, const std::string& file) {
  std::vector<std::int64_t> stamps;
  for (std::size_t number = 1; !text.empty(); ++number) {
    std::string_view line = take_line(text);
    const std::string_view word = take_word(line);
    if (word.empty()) continue;
    const auto stamp = parse_seconds(word);
    if (!stamp || !take_word(line).empty())
      throw InputError(file + ", line " + std::to_string(number) +
                       ": one number is expected, the stamp of a scan in seconds");
    stamps.push_back(*stamp);
  }
  return stamps;
}

}  // namespace lego_loam_sc
