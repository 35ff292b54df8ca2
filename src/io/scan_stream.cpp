// SPDX-License-Identifier: BSD-3-Clause
#include "io/scan_stream.hpp"

#include <algorithm>
#include <array>
#include <type_traits>
#include <utility>

#include "core/error.hpp"
#include "io/bytes.hpp"

namespace lego_loam_sc {
namespace {

constexpr std::uint32_t kVersion = 1;
constexpr std::uint32_t kMaxText = 65536;
constexpr std::uint32_t kMaxPoints = 10'000'000;
constexpr std::string_view kMarker = "SCAN";
constexpr std::uint32_t kIntensity = 1, kRing = 2, kOffset = 4;

static_assert(sizeof(Eigen::Vector3f) == 3 * sizeof(float), "points are written as in memory");

template <class T>
std::string_view bytes_of(const std::vector<T>& array) {
  return {reinterpret_cast<const char*>(array.data()), array.size() * sizeof(T)};
}

void check(const std::ostream& out) {
  if (!out)
    throw InputError(
        "the scan stream cannot be written, its reader has closed it or the disk is full");
}

}  // namespace

ScanStreamWriter::ScanStreamWriter(std::ostream& out, const DatasetFacts& facts) : out_(out) {
  const std::string text = to_yaml(facts);
  std::string header(kScanStreamMagic);
  append(header, kVersion);
  append(header, static_cast<std::uint32_t>(text.size()));
  out_ << header << text;
  check(out_);
}

void ScanStreamWriter::write(const Scan& scan) {
  const auto fits = [&](std::size_t size) { return size == 0 || size == scan.size(); };
  if (!fits(scan.intensity.size()) || !fits(scan.ring.size()) || !fits(scan.offset_ns.size()) ||
      scan.size() > kMaxPoints)
    throw InputError(
        "the arrays of a scan must be empty or as long as its points, at most 10000000");
  std::string head(kMarker);
  append(head, (scan.intensity.empty() ? 0 : kIntensity) | (scan.ring.empty() ? 0 : kRing) |
                   (scan.offset_ns.empty() ? 0 : kOffset));
  append(head, scan.stamp_ns);
  append(head, static_cast<std::uint32_t>(scan.size()));
  out_ << head << bytes_of(scan.points) << bytes_of(scan.intensity) << bytes_of(scan.ring)
       << bytes_of(scan.offset_ns);
  check(out_);
}

ScanStreamReader::ScanStreamReader(std::istream& in, std::string name)
    : in_(in), name_(std::move(name)) {
  std::array<char, kScanStreamMagic.size()> magic;
  read(magic.data(), magic.size());
  if (std::string_view(magic.data(), magic.size()) != kScanStreamMagic)
    fail("it does not begin with " + std::string(kScanStreamMagic) +
         ", so it is not a scan stream");
  const auto version = read_number<std::uint32_t>();
  if (version != kVersion)
    fail("it has version " + std::to_string(version) + ", this program reads version 1");
  const auto length = read_number<std::uint32_t>();
  if (length > kMaxText) fail("its header text is longer than 65536 bytes");
  std::string text(length, '\0');
  read(text.data(), text.size());
  facts_ = parse_dataset_yaml(text, name_ + ", header text");
}

std::optional<Scan> ScanStreamReader::next() {
  if (ended_ || in_.peek() == std::istream::traits_type::eof()) return std::nullopt;
  std::array<char, kMarker.size()> marker;
  read(marker.data(), marker.size());
  if (std::string_view(marker.data(), marker.size()) != kMarker)
    fail("a scan must begin with " + std::string(kMarker));
  const auto arrays = read_number<std::uint32_t>();
  if (arrays > (kIntensity | kRing | kOffset))
    fail("a scan has unknown arrays (" + std::to_string(arrays) + ")");
  Scan scan;
  scan.stamp_ns = read_number<std::int64_t>();
  const auto count = read_number<std::uint32_t>();
  if (count > kMaxPoints)
    fail("a scan claims " + std::to_string(count) + " points, 10000000 are allowed");
  scan.points = read_array<Eigen::Vector3f>(count);
  if (arrays & kIntensity) scan.intensity = read_array<float>(count);
  if (arrays & kRing) scan.ring = read_array<std::uint16_t>(count);
  if (arrays & kOffset) scan.offset_ns = read_array<std::int32_t>(count);
  ++scans_;
  return scan;
}

void ScanStreamReader::read(char* bytes, std::size_t size) {
  in_.read(bytes, static_cast<std::streamsize>(size));
  byte_ += static_cast<std::size_t>(in_.gcount());
  if (static_cast<std::size_t>(in_.gcount()) != size) fail("it is truncated");
}

template <class T>
T ScanStreamReader::read_number() {
  std::array<char, sizeof(T)> bytes;
  read(bytes.data(), bytes.size());
  return load<T>(bytes.data());
}

template <class T>
std::vector<T> ScanStreamReader::read_array(std::size_t count) {
  constexpr std::size_t kChunk = 65536;
  std::vector<T> array;
  while (array.size() < count) {
    const std::size_t begin = array.size();
    array.resize(std::min(count, begin + std::max(begin, kChunk)));
    read(reinterpret_cast<char*>(array.data() + begin), (array.size() - begin) * sizeof(T));
  }
  return array;
}

void ScanStreamReader::fail(const std::string& what) {
  ended_ = true;
  throw InputError(name_ + ": " + what + "; " + std::to_string(scans_) +
                   " scans were complete, the error is at byte " + std::to_string(byte_));
}

}  // namespace lego_loam_sc
