// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_writer.hpp"

#include <string>

#include "io/atomic_file.hpp"
#include "io/bytes.hpp"  // asserts the byte order

namespace lego_loam_sc {
namespace {

static_assert(sizeof(MapPoint) == 20, "points are written as they lie");

std::string_view bytes_of(const std::vector<MapPoint>& points) {
  return {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(MapPoint)};
}

void write_cloud(const std::filesystem::path& path, std::string_view header,
                 std::string_view bytes) {
  AtomicFile file(path);
  file.write(header);
  file.write(bytes);
  file.commit();
}

}  // namespace

void write_ply(const std::filesystem::path& path, std::string_view properties, std::size_t count,
               std::string_view bytes) {
  write_cloud(path,
              "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(count) +
                  "\n" + std::string(properties) + "end_header\n",
              bytes);
}

void write_ply(const std::filesystem::path& path, const std::vector<MapPoint>& points) {
  write_ply(path,
            "property float x\nproperty float y\nproperty float z\nproperty float intensity\n"
            "property int key_frame\n",
            points.size(), bytes_of(points));
}

void write_pcd(const std::filesystem::path& path, const std::vector<MapPoint>& points) {
  const std::string count = std::to_string(points.size());
  write_cloud(path,
              "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
              "FIELDS x y z intensity key_frame\nSIZE 4 4 4 4 4\nTYPE F F F F I\n"
              "COUNT 1 1 1 1 1\nWIDTH " +
                  count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count +
                  "\nDATA binary\n",
              bytes_of(points));
}

}  // namespace lego_loam_sc
