// SPDX-License-Identifier: BSD-3-Clause
#include "io/bin.hpp"

#include <array>
#include <string>

#include "core/error.hpp"
#include "io/bytes.hpp"
#include "io/file.hpp"

namespace lego_loam_sc {

Scan read_bin(const std::filesystem::path& path) {
  return parse_bin(read_file(path), path.string());
}

Scan parse_bin(std::string_view bytes, const std::string& file) {
  constexpr std::size_t kPointBytes = 4 * sizeof(float);
  if (bytes.size() % kPointBytes != 0)
    throw InputError(file + " has " + std::to_string(bytes.size()) +
                     " bytes, which is not a multiple of 16 (float32 x y z intensity); it is "
                     "truncated or not a KITTI scan");
  Scan scan;
  const std::size_t count = bytes.size() / kPointBytes;
  scan.points.resize(count);
  scan.intensity.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto [x, y, z, intensity] = load<std::array<float, 4>>(bytes.data() + i * kPointBytes);
    scan.points[i] = Eigen::Vector3f(x, y, z);
    scan.intensity[i] = intensity;
  }
  return scan;
}

}  // namespace lego_loam_sc
