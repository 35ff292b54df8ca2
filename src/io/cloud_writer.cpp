// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_writer.hpp"

#include <limits>
#include <string>

#include "io/bytes.hpp"  // asserts the byte order

namespace lego_loam_sc {
namespace {

static_assert(sizeof(MapPoint) == 20, "points are written as in memory");

std::string ply_header(std::string_view padding, std::size_t count, std::string_view properties) {
  return "ply\nformat binary_little_endian 1.0\n" + std::string(padding) + "element vertex " +
         std::to_string(count) + "\n" + std::string(properties) + "end_header\n";
}

constexpr std::string_view kMapProperties =
    "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
    "property int key_frame\n";

std::string pcd_header(std::string_view padding, std::size_t points) {
  const std::string count = std::to_string(points);
  return "# .PCD v0.7 - Point Cloud Data file format\n" + std::string(padding) +
         "VERSION 0.7\nFIELDS x y z intensity key_frame\nSIZE 4 4 4 4 4\nTYPE F F F F I\n"
         "COUNT 1 1 1 1 1\nWIDTH " +
         count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count + "\nDATA binary\n";
}

// A header of the same length for any count, padded by a comment.
std::string header(CloudFormat format, std::size_t count) {
  const bool ply = format == CloudFormat::ply;
  const auto with = [&](const std::string& padding, std::size_t points) {
    return ply ? ply_header(padding, points, kMapProperties) : pcd_header(padding, points);
  };
  const auto comment = [&](std::size_t spaces) {
    return (ply ? "comment" : "#") + std::string(spaces, ' ') + "\n";
  };
  const std::size_t length = with(comment(0), std::numeric_limits<std::size_t>::max()).size();
  return with(comment(length - with(comment(0), count).size()), count);
}

}  // namespace

CloudFile::CloudFile(const std::filesystem::path& path, CloudFormat format)
    : file_(path), format_(format) {
  file_.write(header(format_, 0));
}

void CloudFile::add(std::span<const MapPoint> points) {
  file_.write({reinterpret_cast<const char*>(points.data()), points.size_bytes()});
  count_ += points.size();
}

void CloudFile::commit() {
  file_.overwrite_beginning(header(format_, count_));
  file_.commit();
}

void write_ply(const std::filesystem::path& path, std::span<const MapPoint> points) {
  CloudFile file(path, CloudFormat::ply);
  file.add(points);
  file.commit();
}

void write_ply(const std::filesystem::path& path, std::string_view properties, std::size_t count,
               std::string_view bytes) {
  AtomicFile file(path);
  file.write(ply_header("", count, properties));
  file.write(bytes);
  file.commit();
}

}  // namespace lego_loam_sc
