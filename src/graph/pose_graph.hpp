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
/// those of GraphSettings, for a scan matcher's covariance speaks of the noise of its points and
/// knows nothing of moving objects, distortion and a wrong calibration.
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
/// Key frames form a chain, and a loop joins any two of them. Where no loop ends, the chain has
/// nothing to decide, so each stretch between two neighbouring loop ends is condensed to one
/// factor. iSAM2 (Kaess et al., "iSAM2: Incremental smoothing and mapping using the Bayes tree",
/// IJRR 2012) holds the loop ends and keeps its tree from one loop to the next: a loop adds its
/// factor and splits the stretches that it ends in, and what has moved is linearised anew. Then the
/// stretches are expanded, and those that have moved are condensed anew in their turn. Repeated
/// until nothing moves, this is the full Gauss-Newton solution over all key frames at the cost of
/// one over the loop ends; a key frame without a loop costs one product of poses. What moves by
/// less than `precision` counts as still: an update then costs what the loop moves.
///
/// A loop pulls with a Huber kernel: however far apart drift has taken its ends, its pull never
/// fades as that of Cauchy or Geman-McClure does, so a true loop closes; and it never grows beyond
/// that of `loop_kernel` sigmas (up to three times as much where stiff odometry has drifted), so a
/// wrong loop among several true ones stays open, which `loop_chi` shows. The result is the same
/// for any number of threads, to the bit.
class PoseGraph {
 public:
  /// Without key frames.
  explicit PoseGraph(const GraphSettings& settings);
  PoseGraph(PoseGraph&&) noexcept;
  PoseGraph& operator=(PoseGraph&&) noexcept;
  ~PoseGraph();

  /// Key frame 0; its pose is held for good.
  void add_first(const Pose& T_map_key);

  /// The next key frame: `odometry.from` is the last one and `odometry.to` is size(). Its pose is
  /// the last one's times the edge.
  /// All three `add` throw std::invalid_argument when indices or numbers of the edge are wrong.
  void add_key_frame(const PoseEdge& odometry);

  /// Joins two different key frames; moves nothing before `optimise`.
  void add_loop(const PoseEdge& loop);

  /// Takes a loop out; those after it move up by one. Moves nothing before `optimise`.
  void remove_loop(std::size_t loop_index);

  /// Brings all poses to the optimum. Does nothing unless loops have come or gone.
  void optimise();

  std::size_t size() const;                             ///< number of key frames
  const std::vector<Pose>& poses() const;               ///< T_map_key of each key frame
  const std::vector<PoseEdge>& odometry_edges() const;  ///< from each key frame to the next
  const std::vector<PoseEdge>& loop_edges() const;      ///< in the order in which they came

  /// Mahalanobis distance between a loop's measurement and the present poses. Of six degrees of
  /// freedom: above 4.7 once in a thousand true loops.
  double loop_chi(std::size_t loop_index) const;

  /// The same of a loop that the graph need not hold.
  double chi(const PoseEdge& loop) const;

  /// See core/state_archive.hpp. What the solver keeps depends on all that it was told, so a graph
  /// is read by telling it everything again.
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
    PoseEdge edge;  // of the first key frame the pose, of a loop to be removed the number as `to`

    template <class Archive>
    void state(Archive& archive) {
      archive(kind, edge);
    }
  };

  void repeat_calls();

  std::unique_ptr<Solver> solver_;
  std::vector<Call> calls_;  // all, in their order
};

}  // namespace lego_loam_sc
