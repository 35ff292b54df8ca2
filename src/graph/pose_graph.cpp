// SPDX-License-Identifier: BSD-3-Clause
#include "graph/pose_graph.hpp"

#include <gtsam/geometry/Pose3.h>
#include <gtsam/nonlinear/NonlinearFactorGraph.h>
#include <gtsam/slam/PriorFactor.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "graph/chain_segment.hpp"
#include "graph/condensed_chain.hpp"
#include "graph/incremental_solver.hpp"
#include "graph/relative_pose_factor.hpp"

namespace lego_loam_sc {
namespace {

using gtsam::Pose3;
namespace noise = gtsam::noiseModel;

constexpr double kPriorSigma = 1e-3;  // fixes the gauge; any value yields the same poses
// A few iterations suffice, unless a residual is near the threshold of the kernel: the weight of
// such a loop converges slowly.
constexpr int kMaxIterations = 100;
// An iteration that changes poses by less than this many precisions is the last: the next would be
// some hundred times smaller.
constexpr double kConvergence = 10.0;

Pose from_gtsam(const Pose3& pose) {
  return Pose(pose.matrix());
}

void check(const PoseEdge& edge, const char* kind) {
  const bool finite = edge.T_from_to.matrix().allFinite() && edge.covariance.allFinite();
  if (finite && Eigen::LLT<Matrix6>(edge.covariance).info() == Eigen::Success) return;
  throw std::invalid_argument(std::string(kind) + " edge from key frame " +
                              std::to_string(edge.from) + " to " + std::to_string(edge.to) +
                              " needs a finite pose and a positive definite covariance");
}

}  // namespace

class PoseGraph::Solver {
 public:
  explicit Solver(const GraphSettings& settings)
      : settings_(settings), chain_(settings.precision), incremental_(settings.precision) {}

  void add_first(const Pose& T_map_key);
  void add_loop(const PoseEdge& loop);
  void remove_loop(std::ptrdiff_t index);
  void optimise();

  std::vector<Pose> poses;
  std::vector<PoseEdge> odometry;
  std::vector<PoseEdge> loops;

 private:
  double kernel_width(const PoseEdge& loop) const;
  std::vector<int> loop_ends() const;
  double update_poses(const gtsam::Values& ends);

  GraphSettings settings_;
  bool changed_ = false;  // loops were added or removed since the last optimisation
  gtsam::NonlinearFactor::shared_ptr gauge_;
  std::vector<gtsam::NonlinearFactor::shared_ptr> loop_factors_;
  CondensedChain chain_;
  IncrementalSolver incremental_;
};

void PoseGraph::Solver::add_first(const Pose& T_map_key) {
  poses.push_back(T_map_key);
  gauge_ = boost::make_shared<gtsam::PriorFactor<Pose3>>(0, to_gtsam(T_map_key),
                                                         noise::Isotropic::Sigma(6, kPriorSigma));
}

void PoseGraph::Solver::add_loop(const PoseEdge& loop) {
  gtsam::SharedNoiseModel model = noise::Gaussian::Covariance(swap_blocks(loop.covariance));
  if (settings_.loop_kernel > 0.0)
    model = noise::Robust::Create(noise::mEstimator::Huber::Create(kernel_width(loop)), model);
  loops.push_back(loop);
  loop_factors_.emplace_back(boost::make_shared<RelativePoseFactor>(
      loop.from, loop.to, to_gtsam(loop.T_from_to), Vector6::Zero(), model));
  changed_ = true;
}

void PoseGraph::Solver::remove_loop(std::ptrdiff_t index) {
  loops.erase(loops.begin() + index);
  loop_factors_.erase(loop_factors_.begin() + index);
  changed_ = true;
}

void PoseGraph::Solver::optimise() {
  if (!changed_) return;
  changed_ = false;
  const std::vector<int> ends = loop_ends();
  chain_.divide(ends, odometry);
  for (int iteration = 0; iteration < kMaxIterations; ++iteration) {
    chain_.condense_moved(odometry);
    gtsam::NonlinearFactorGraph graph;
    graph.push_back(gauge_);
    chain_.add_factors(graph);
    graph.push_back(loop_factors_.begin(), loop_factors_.end());
    gtsam::Values estimate;
    for (const int end : ends) estimate.insert(end, to_gtsam(poses[end]));
    estimate = incremental_.step(graph, estimate);
    chain_.expand(estimate);
    if (update_poses(estimate) < kConvergence * settings_.precision) break;
  }
}

// Only other loops may outweigh a loop, not the drift that it corrects. So the setting is raised by
// the residual of the loop in sigmas after closing, | S_loop S_odometry^-1 d | with the drift d, up
// to three times its value, so that a few true loops outweigh a wrong one.
double PoseGraph::Solver::kernel_width(const PoseEdge& loop) const {
  const auto [first, last] = std::minmax(loop.from, loop.to);
  std::vector<Link> links;
  for (int i = first; i < last; ++i) links.push_back(linearised_at_measurement(odometry[i]));
  const ChainSegment chain = condense(links, 0, last - first);
  const Pose3 measured = to_gtsam(loop.from < loop.to ? loop.T_from_to : loop.T_from_to.inverse());
  const Vector6 drift = Pose3::Logmap(chain.relative.inverse() * measured);
  const Vector6 force = chain.covariance.ldlt().solve(drift);
  const double sigmas = std::sqrt(force.dot(swap_blocks(loop.covariance) * force));
  return settings_.loop_kernel + std::min(sigmas, 2.0 * settings_.loop_kernel);
}

// In ascending order, key frame 0 included.
std::vector<int> PoseGraph::Solver::loop_ends() const {
  std::vector<int> ends = {0};
  for (const PoseEdge& loop : loops) ends.insert(ends.end(), {loop.from, loop.to});
  std::sort(ends.begin(), ends.end());
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return ends;
}

// Sets all poses from the solved loop ends and the links between them, and from odometry after the
// last end. Returns the largest change.
double PoseGraph::Solver::update_poses(const gtsam::Values& ends) {
  double largest_change = 0.0;
  Pose3 T_map_key = to_gtsam(poses[0]);
  const std::vector<Pose3>& relatives = chain_.relatives();
  for (std::size_t i = 1; i < poses.size(); ++i) {
    if (i <= relatives.size()) {
      T_map_key = ends.exists(i) ? ends.at<Pose3>(i) : T_map_key * relatives[i - 1];
    } else {
      T_map_key = T_map_key * to_gtsam(odometry[i - 1].T_from_to);
    }
    const Pose updated = from_gtsam(T_map_key);
    largest_change = std::max(largest_change, (updated.matrix() - poses[i].matrix()).norm());
    poses[i] = updated;
  }
  return largest_change;
}

PoseGraph::PoseGraph(const GraphSettings& settings) : solver_(std::make_unique<Solver>(settings)) {}
PoseGraph::PoseGraph(PoseGraph&&) noexcept = default;
PoseGraph& PoseGraph::operator=(PoseGraph&&) noexcept = default;
PoseGraph::~PoseGraph() = default;

void PoseGraph::add_first(const Pose& T_map_key) {
  if (!solver_->poses.empty()) throw std::invalid_argument("key frame 0 was added before");
  solver_->add_first(T_map_key);
  calls_.push_back({Call::Kind::add_first, {.T_from_to = T_map_key}});
}

void PoseGraph::add_key_frame(const PoseEdge& odometry) {
  const int next = static_cast<int>(size());
  if (odometry.from < 0 || odometry.from != next - 1 || odometry.to != next)
    throw std::invalid_argument("odometry edge must lead from the last key frame to the next, " +
                                std::to_string(next));
  check(odometry, "odometry");
  solver_->poses.push_back(normalized(solver_->poses.back() * odometry.T_from_to));
  solver_->odometry.push_back(odometry);
  calls_.push_back({Call::Kind::add_key_frame, odometry});
}

void PoseGraph::add_loop(const PoseEdge& loop) {
  const int count = static_cast<int>(size());
  if (loop.from < 0 || loop.to < 0 || loop.from >= count || loop.to >= count ||
      loop.from == loop.to)
    throw std::invalid_argument("loop edge must join two different key frames of the " +
                                std::to_string(count));
  check(loop, "loop");
  solver_->add_loop(loop);
  calls_.push_back({Call::Kind::add_loop, loop});
}

void PoseGraph::remove_loop(std::size_t loop_index) {
  if (loop_index >= solver_->loops.size())
    throw std::invalid_argument("there is no loop edge " + std::to_string(loop_index));
  solver_->remove_loop(static_cast<std::ptrdiff_t>(loop_index));
  calls_.push_back({Call::Kind::remove_loop, {.to = static_cast<int>(loop_index)}});
}

void PoseGraph::optimise() {
  solver_->optimise();
  calls_.push_back({});
}

void PoseGraph::repeat_calls() {
  for (const Call& call : std::exchange(calls_, {})) switch (call.kind) {
      case Call::Kind::add_first: add_first(call.edge.T_from_to); break;
      case Call::Kind::add_key_frame: add_key_frame(call.edge); break;
      case Call::Kind::add_loop: add_loop(call.edge); break;
      case Call::Kind::remove_loop: remove_loop(static_cast<std::size_t>(call.edge.to)); break;
      case Call::Kind::optimise: optimise(); break;
    }
}

std::size_t PoseGraph::size() const {
  return solver_->poses.size();
}
const std::vector<Pose>& PoseGraph::poses() const {
  return solver_->poses;
}
const std::vector<PoseEdge>& PoseGraph::odometry_edges() const {
  return solver_->odometry;
}
const std::vector<PoseEdge>& PoseGraph::loop_edges() const {
  return solver_->loops;
}

double PoseGraph::loop_chi(std::size_t loop_index) const {
  return chi(loop_edges().at(loop_index));
}

double PoseGraph::chi(const PoseEdge& loop) const {
  const Pose estimate = poses()[loop.from].inverse() * poses()[loop.to];
  const Vector6 residual = log_se3(loop.T_from_to.inverse() * estimate);
  return std::sqrt(residual.dot(loop.covariance.llt().solve(residual)));
}

}  // namespace lego_loam_sc
