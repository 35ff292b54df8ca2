// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scan.hpp"

namespace lego_loam_sc {

/// The beams that made some scans, from the lowest up.
struct Beams {
  std::vector<double> elevation_deg;                ///< median of the points of each beam
  std::vector<double> spread_deg;                   ///< between the quartiles of its points
  std::vector<std::vector<std::int16_t>> of_point;  ///< of each scan: beam of each point or -1

  bool empty() const { return elevation_deg.empty(); }
};

/// The ring of each point by the order of storage, see rings_of_storage_order(): -1 for those
/// without return; nothing when the scan is stored in another order.
std::vector<std::int16_t> stored_rings(const Scan& scan);

/// By the ring field; none when it is missing or the same everywhere.
Beams beams_of_rings(std::span<const Scan> scans);

/// By the order of storage, for scans stored as KITTI's are; none for others.
Beams beams_of_storage_order(std::span<const Scan> scans);

/// By the elevations alone: none when they do not gather on lines.
Beams beams_of_elevations(std::span<const Scan> scans);

/// Why the numbered rings of a scan are none, as one sentence: a Livox or a solid-state sensor
/// numbers lines that are no beams. Nothing when they are good.
std::optional<std::string> fault_of_rings(const Beams& rings);

}  // namespace lego_loam_sc
