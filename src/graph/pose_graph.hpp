// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "core/pose.hpp"
#include "graph/settings.hpp"

namespace lego_loam_sc {

/// A measured pose of key frame `to` in the frame of key frame `from`.
///
/// The truth is `T_from_to * exp_se3(noise)` with noise ~ N(0, covariance): translation (m) first,
/// then rotation (rad), both along the axes of `to`. A covariance S of the left perturbation that
/// `perturb` applies becomes B S B^T with B = diag(R^T, R^T) and R the rotation of T_from_to. The
/// covariance must be positive definite. The graph applies no floor of its own: the caller adds
/// those of GraphSettings, since a scan matcher's covariance covers the noise of its points, but
/// not moving objects, distortion and calibration errors.
struct PoseEdge {
  int from = 0;
  int to = 0;
  Pose T_from_to = Pose::Identity();
  Matrix6 covariance = Matrix6::Identity();

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(from, to, T_from_to, covariance);
  }
};

/// The key frames, the odometry between them and the loops: paper 2.3 (4) and (6).
///
/// Key frames form a chain, and a loop joins any two of them. Key frames between two neighbouring
/// loop ends are marginalised: each such segment of the chain is condensed to one factor. iSAM2
/// (Kaess et al., "iSAM2: Incremental smoothing and mapping using the Bayes tree", IJRR 2012)
/// solves for the loop ends and keeps its tree between loops: a loop adds its factor and splits the
/// segments that it ends in, and moved variables are relinearised. Then the segments are expanded,
/// and those that have moved are condensed again. Iterated to convergence, this is the full
/// Gauss-Newton solution over all key frames at the cost of one over the loop ends; a key frame
/// without a loop costs one product of poses. Movements below `precision` are ignored, so the cost
/// of an update depends on what the loop moves.
///
/// Loops have a Huber kernel. Unlike with Cauchy or Geman-McClure, its force does not fade with the
/// residual, so a true loop closes however large the drift; and it is bounded to that of
/// `loop_kernel` sigmas (up to three times as much where stiff odometry has drifted), so a wrong
/// loop among several true ones stays open, which `loop_chi` shows. The result is bit-identical for
/// any number of threads.
class PoseGraph {
 public:
  /// An empty graph.
  explicit PoseGraph(const GraphSettings& settings);
  PoseGraph(PoseGraph&&) noexcept;
  PoseGraph& operator=(PoseGraph&&) noexcept;
  ~PoseGraph();

  /// Adds key frame 0, whose pose is fixed.
  void add_first(const Pose& T_map_key);

  /// Adds the next key frame: `odometry.from` is the last one and `odometry.to` is size(). Its pose
  /// is that of the last one times the edge.
  /// All three `add` throw std::invalid_argument when an edge has invalid indices or numbers.
  void add_key_frame(const PoseEdge& odometry);

  /// Adds a loop between two different key frames. Poses change only in `optimise`.
  void add_loop(const PoseEdge& loop);

  /// Removes a loop; the indices of later ones decrease by one. Poses change only in `optimise`.
  void remove_loop(std::size_t loop_index);

  /// Moves all poses to the optimum. Does nothing unless loops were added or removed.
  void optimise();

  std::size_t size() const;                             ///< number of key frames
  const std::vector<Pose>& poses() const;               ///< T_map_key of each key frame
  const std::vector<PoseEdge>& odometry_edges() const;  ///< from each key frame to the next
  const std::vector<PoseEdge>& loop_edges() const;      ///< in order of addition

  /// Mahalanobis distance between a loop's measurement and the present poses, with six degrees of
  /// freedom: one true loop in a thousand exceeds 4.7.
  double loop_chi(std::size_t loop_index) const;

  /// The same for a loop that is not in the graph.
  double chi(const PoseEdge& loop) const;

  /// See core/state_archive.hpp. The state of the solver depends on the history of calls, so a
  /// graph is restored by repeating them.
  template <class Archive>
  void state(Archive& archive) {
    archive.grown(calls_);
    if constexpr (Archive::kReads) repeat_calls();
  }

 private:
  class Solver;
  struct Call {
    enum class Kind { add_first, add_key_frame, add_loop, remove_loop, optimise };

    Kind kind = Kind::optimise;
    PoseEdge edge;  // add_first: its pose; remove_loop: the index as `to`

    template <class Archive>
    void state(Archive& archive) {
      archive(kind, edge);
    }
  };

  void repeat_calls();

  std::unique_ptr<Solver> solver_;
  std::vector<Call> calls_;  // the full history
};

}  // namespace lego_loam_sc
