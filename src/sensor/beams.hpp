// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scan.hpp"

namespace lego_loam_sc {

/// The beams found in some scans, from the lowest up.
struct Beams {
  std::vector<double> elevation_deg;                ///< median over the points of each beam
  std::vector<double> iqr_deg;                      ///< interquartile range of their elevations
  std::vector<std::vector<std::int16_t>> of_point;  ///< for each scan: beam of each point or -1

  bool empty() const { return elevation_deg.empty(); }
};

/// The ring of each point by storage order, see rings_of_storage_order(): -1 for points without
/// return; empty when the scan is stored in another order.
std::vector<std::int16_t> stored_rings(const Scan& scan);

/// Beams by the ring field; none when it is missing or constant.
Beams beams_of_rings(std::span<const Scan> scans);

/// Beams by storage order, for scans stored like KITTI's; none for others.
Beams beams_of_storage_order(std::span<const Scan> scans);

/// Beams by the elevations alone; none when these form no lines.
Beams beams_of_elevations(std::span<const Scan> scans);

/// Why the ring numbers of a scan are not beams, as one sentence: a Livox or solid-state sensor
/// numbers lines without a fixed elevation. Nothing when they are.
std::optional<std::string> ring_fault(const Beams& rings);

}  // namespace lego_loam_sc
