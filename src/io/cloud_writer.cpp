// SPDX-License-Identifier: BSD-3-Clause
#include "io/cloud_writer.hpp"

#include <string>

#include "io/atomic_file.hpp"
#include "io/bytes.hpp"  // asserts the byte order

namespace lego_loam_sc {
namespace {

void write_cloud(const std::filesystem::path& path, const std::string& header,
                 const std::vector<Eigen::Vector4f>& points) {
  AtomicFile file(path);
  file.write(header);
  file.write(
      {reinterpret_cast<const char*>(points.data()), points.size() * sizeof(Eigen::Vector4f)});
  file.commit();
}

}  // namespace

void write_ply(const std::filesystem::path& path, const std::vector<Eigen::Vector4f>& points) {
  write_cloud(path,
              "ply\nformat binary_little_endian 1.0\nelement vertex " +
                  std::to_string(points.size()) +
                  "\nproperty float x\nproperty float y\nproperty float z\n"
                  "property float intensity\nend_header\n",
              points);
}

void write_pcd(const std::filesystem::path& path, const std::vector<Eigen::Vector4f>& points) {
  const std::string count = std::to_string(points.size());
  write_cloud(path,
              "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n"
              "FIELDS x y z intensity\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH " +
                  count + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + count +
                  "\nDATA binary\n",
              points);
}

}  // namespace lego_loam_sc
