// SPDX-License-Identifier: BSD-3-Clause
#include "app/result_tables.hpp"

#include <string_view>

#include "core/pose.hpp"
#include "core/text.hpp"

namespace lego_loam_sc {
namespace {

// Fields of one line of a CSV file.
class CsvLine {
 public:
  CsvLine& operator<<(std::string_view text) {
    if (!begins_) line_ += ',';
    begins_ = false;
    line_ += text;
    return *this;
  }
  CsvLine& operator<<(const std::string& text) { return *this << std::string_view(text); }
  CsvLine& operator<<(int value) { return *this << std::to_string(value); }
  CsvLine& operator<<(std::size_t value) { return *this << std::to_string(value); }

  std::string text() const { return line_ + "\n"; }

 private:
  std::string line_;
  bool begins_ = true;
};

}  // namespace

const char* const kScansHeader =
    "scan,stamp,status,points,ground_points,segment_points,clusters,edges_sharp,planars_flat,"
    "edges_large,planars_large,odometry_edges,odometry_planars,odometry_iterations,map_points,"
    "map_matches,map_iterations,map_rmse_m,degenerate_translations,degenerate_rotations,"
    "translation_strength,rotation_strength,elevation_bias_deg,agreeing,contradicting,prediction_m,"
    "stamp_jump_s,warnings,"
    "errors,piece,key_frame,corrected,projection_ms,segmentation_ms,features_ms,odometry_ms,"
    "mapping_ms,loops_ms,delay_ms,delay_level\n";

const char* const kLoopsHeader =
    "query,match,query_scan,match_scan,detector,distance,yaw_deg,overlap,rmse_m,x,y,z,roll_deg,"
    "pitch_deg,loop_yaw_deg,added,verdict\n";

std::string scan_line(const ScanReport& r, const HealthLog::Line& health) {
  CsvLine line;
  line << r.index << to_seconds(r.stamp_ns) << to_string(r.status) << r.points << r.ground_points
       << r.segment_points << r.clusters << r.edges_sharp << r.planars_flat << r.edges_large
       << r.planars_large << r.odometry_edges << r.odometry_planars << r.odometry_iterations
       << r.map_points << r.map_matches << r.map_iterations << to_fixed(r.map_rmse, 4)
       << r.degenerate_translations << r.degenerate_rotations
       << to_fixed(r.least_translation_strength, 1) << to_fixed(r.least_rotation_strength, 1)
       << to_fixed(r.elevation_bias_deg, 4) << r.agreeing << r.contradicting
       << to_fixed(r.prediction_m, 4) << to_fixed(r.stamp_jump_s, 3) << health.warnings
       << health.errors << r.piece << r.key_frame << (r.corrected ? 1 : 0);
  for (const double milliseconds : r.milliseconds) line << to_fixed(milliseconds, 3);
  line << to_fixed(health.delay_ms, 3) << to_string(health.delay_level);
  return line.text();
}

std::string loop_line(const LoopReport& r) {
  const LoopVerification& v = r.verification;
  const Eigen::Vector3d t = v.T_match_query.translation();
  const Eigen::Vector3d rpy = rpy_from_rotation(v.T_match_query.linear());
  CsvLine line;
  line << r.candidate.query << r.candidate.match << r.query_scan << r.match_scan
       << to_string(r.candidate.detector) << to_fixed(r.candidate.distance, 4)
       << to_fixed(degrees(r.candidate.yaw), 2) << to_fixed(v.overlap, 3) << to_fixed(v.rmse, 4)
       << to_fixed(t.x(), 4) << to_fixed(t.y(), 4) << to_fixed(t.z(), 4)
       << to_fixed(degrees(rpy.x()), 3) << to_fixed(degrees(rpy.y()), 3)
       << to_fixed(degrees(rpy.z()), 3) << (r.added ? 1 : 0) << to_string(v.verdict);
  return line.text();
}

}  // namespace lego_loam_sc
