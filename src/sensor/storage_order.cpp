// SPDX-License-Identifier: BSD-3-Clause
#include "sensor/storage_order.hpp"

namespace lego_loam_sc {

std::vector<std::int16_t> rings_of_storage_order(const Scan& scan,
                                                 const std::vector<std::uint8_t>& usable) {
  std::vector<std::int16_t> ring_of_point(scan.size(), -1);
  bool previous_in_fourth = false;
  bool passed_rear = false;  // prevents jitter around zero from starting rings
  int ring = 0;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!usable[i]) continue;
    const float x = scan.points[i].x();
    const float y = scan.points[i].y();
    if (previous_in_fourth && x > 0.0f && y >= 0.0f && passed_rear) {
      passed_rear = false;
      if (++ring >= kMaxRings) return {};
    }
    passed_rear = passed_rear || x < 0.0f;
    previous_in_fourth = x > 0.0f && y < 0.0f;
    ring_of_point[i] = static_cast<std::int16_t>(ring);
  }
  return ring_of_point;
}

}  // namespace lego_loam_sc
