// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace lego_loam_sc {

/// How far to travel between one search for loops and the next. All distances in m, along the path.
class SearchPacing {
 public:
  /// `spacing` between two searches, at least.
  explicit SearchPacing(double spacing) : spacing_(spacing), search_spacing_(spacing) {}

  /// Whether the next search is yet to come.
  bool pauses(double travelled) const { return travelled < next_search_; }

  /// Since the last loop that was accepted, redundant or not.
  double since_last_loop(double travelled) const { return travelled - last_loop_; }

  /// A loop was added to the graph.
  void on_added(double travelled);
  /// A loop told nothing new, at a place near which so many loops end.
  void on_redundant(double travelled, double loops_near);
  /// Candidates went through ICP and were refused.
  void on_refused(double travelled) { next_search_ = travelled + spacing_; }

  /// See core/state_archive.hpp.
  template <class Archive>
  void state(Archive& archive) {
    archive(search_spacing_, last_loop_, next_search_);
  }

 private:
  double next_search_spacing(double loops_near) const;
  void pause(double travelled, double metres);

  double spacing_;
  double search_spacing_;  // after the last loop
  double last_loop_ = -1e9;
  double next_search_ = 0.0;
};

}  // namespace lego_loam_sc
