// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "loop/settings.hpp"

namespace lego_loam_sc {

/// One place seen from above in polar bins: paper 2.2 and equations (2), (3) and (7). Compared,
/// not read: only the directions of its columns are kept, which is all that equation (4) asks for.
struct ScanContext {
  int rings = 0;                ///< N_r
  int sectors = 0;              ///< N_s
  std::vector<float> columns;   ///< sectors x rings: c_j / |c_j|, or zeros when the sector is empty
  std::vector<float> occupied;  ///< one per sector: 1 where the column holds a point, else 0
  std::vector<float> ring_key;  ///< one per ring, from the nearest to the farthest, m: K of (7)

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(rings, sectors, columns, occupied, ring_key);
  }
};

/// How well one scan context fits another when it is turned: equations (5) and (6).
struct ScanContextMatch {
  double distance = 1.0;  ///< D, in [0, 1]
  int shift = 0;          ///< n*, columns that the candidate is shifted by to fit the query
  double yaw = 0.0;       ///< rad in (-pi, pi]: T_candidate_query turns by R_z(yaw)
};

/// Describes the points of a key frame, given in its LiDAR frame (z up, m). `sensor_height` is that
/// of the sensor above the ground (m), so that heights count from the ground. Points beyond
/// `max_radius` and points that are not finite are left out. Sector 0 starts at the x axis and
/// sectors run counter-clockwise.
ScanContext make_scan_context(std::span<const Eigen::Vector3f> points, double sensor_height,
                              const ScanContextSettings& settings);

/// Compares at all shifts. Both must have the same number of rings and of sectors.
ScanContextMatch compare(const ScanContext& query, const ScanContext& candidate);

}  // namespace lego_loam_sc
