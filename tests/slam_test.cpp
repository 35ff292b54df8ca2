// SPDX-License-Identifier: BSD-3-Clause
#include "slam/slam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

#include "made_drive.hpp"

namespace lego_loam_sc {
namespace {

Settings with_short_loops() {
  Settings settings;
  settings.loop.min_travel = 25.0;
  return settings;
}

bool same_pose(const Pose& a, const Pose& b) {
  return std::memcmp(a.matrix().data(), b.matrix().data(), sizeof(double) * 16) == 0;
}

void expect_same(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].stamp_ns, b[i].stamp_ns);
    EXPECT_TRUE(same_pose(a[i].pose, b[i].pose)) << "pose " << i;
  }
}

void expect_same(const std::vector<PoseEdge>& a, const std::vector<PoseEdge>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].from, b[i].from);
    EXPECT_EQ(a[i].to, b[i].to);
    EXPECT_TRUE(same_pose(a[i].T_from_to, b[i].T_from_to));
    EXPECT_EQ(a[i].covariance, b[i].covariance);
  }
}

void expect_same(const std::vector<PackedPoint>& a, const std::vector<PackedPoint>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), sizeof(PackedPoint) * a.size()), 0);
}

void expect_same(const Slam& a, const Slam& b) {
  expect_same(a.odometry(), b.odometry());
  expect_same(a.trajectory(), b.trajectory());
  expect_same(a.graph().odometry_edges(), b.graph().odometry_edges());
  expect_same(a.graph().loop_edges(), b.graph().loop_edges());
  ASSERT_EQ(a.key_frames().size(), b.key_frames().size());
  for (std::size_t k = 0; k < a.key_frames().size(); ++k) {
    EXPECT_TRUE(same_pose(a.graph().poses()[k], b.graph().poses()[k]));
    const KeyFrame own = a.key_frames()[k];
    const KeyFrame other = b.key_frames()[k];
    EXPECT_EQ(own.reference_ns, other.reference_ns);
    EXPECT_EQ(own.travelled, other.travelled);
    expect_same(own.planars, other.planars);
    expect_same(own.edges, other.edges);
    expect_same(own.others, other.others);
  }
}

Scan scan_of(std::vector<Eigen::Vector3f> points, std::int64_t stamp_ns) {
  Scan scan;
  scan.stamp_ns = stamp_ns;
  scan.points = std::move(points);
  return scan;
}

std::vector<Eigen::Vector3f> repeated(const Eigen::Vector3f& point, int count) {
  return std::vector<Eigen::Vector3f>(count, point);
}

// A run over scans, with what must hold whatever they are.
std::vector<Status> statuses(Slam& slam, const std::vector<Scan>& scans) {
  std::vector<Status> result;
  std::size_t in_order = slam.trajectory().size();
  for (const Scan& scan : scans) {
    const ScanReport report = slam.process(scan);
    result.push_back(report.status);
    EXPECT_TRUE(report.T_odom_lidar.matrix().allFinite());
    EXPECT_EQ(report.stamp_ns, scan.stamp_ns);
    if (report.status != Status::out_of_order) ++in_order;
  }
  const Trajectory final_poses = slam.trajectory();
  EXPECT_EQ(final_poses.size(), in_order);
  EXPECT_EQ(slam.odometry().size(), in_order);
  for (const StampedPose& p : final_poses) {
    EXPECT_TRUE(p.pose.matrix().allFinite());
    EXPECT_NEAR(p.pose.linear().determinant(), 1.0, 1e-9);
  }
  for (std::size_t i = 1; i < final_poses.size(); ++i)
    EXPECT_GT(final_poses[i].stamp_ns, final_poses[i - 1].stamp_ns);
  return result;
}

TEST(Slam, ADriveMayBeginAtSpeed) {
  constexpr double kSpeed = 5.0;
  const int skipped = 15;  // by then the vehicle is at speed
  const std::vector<Scan> scans = drive(skipped + 6, kSpeed);
  Slam slam(made_sensor(900), Settings{});
  for (std::size_t k = skipped; k < scans.size(); ++k)
    EXPECT_EQ(slam.process(scans[k]).status, Status::ok);
  const Trajectory trajectory = slam.trajectory();
  ASSERT_EQ(trajectory.size(), 6u);
  for (int k = 1; k < 6; ++k) {
    const Pose estimate = trajectory[0].pose.inverse() * trajectory[k].pose;
    const Pose error = truth_between(skipped, skipped + k, kSpeed).inverse() * estimate;
    EXPECT_LT(error.translation().norm(), 0.03) << k;
    EXPECT_LT(degrees(rotation_angle(error)), 0.3) << k;
  }
}

TEST(Slam, ARoundThroughTheHallStaysWithinCentimetresOfTheTruthAndClosesItsLoop) {
  constexpr double kSpeed = 5.0;
  const std::vector<Scan> scans = drive(105, kSpeed);
  Slam slam(made_sensor(900), with_short_loops());
  int accepted = 0;
  for (const Scan& scan : scans) {
    const ScanReport report = slam.process(scan);
    EXPECT_EQ(report.status, Status::ok);
    for (const LoopReport& loop : report.loops)
      accepted += loop.verification.verdict == Verdict::accepted;
  }
  EXPECT_GE(accepted, 1);
  for (int k = 0; k < static_cast<int>(scans.size()); ++k) {
    const Pose error = error_between(slam, 0, k, kSpeed);
    EXPECT_LT(error.translation().norm(), 0.10) << "scan " << k;
    EXPECT_LT(degrees(rotation_angle(error)), 0.7) << "scan " << k;
  }
}

TEST(Slam, ALoopDetectorOfOnesOwnIsAskedAndItsCandidatesAreVerified) {
  const std::vector<Scan> scans = drive(105, 5.0);
  Settings settings = with_short_loops();
  settings.loop.scan_context.enabled = false;
  settings.loop.radius_search.enabled = false;
  // Gives a key frame of the first round, wherever the query is.
  const LoopDetector detector = [](const LoopQuery& query) {
    EXPECT_EQ(query.key_frames.size(), query.T_map_key.size());
    EXPECT_GT(query.eligible, 0);
    LoopCandidate candidate;
    candidate.match = query.eligible - 1;
    return std::vector{candidate};
  };
  Slam slam(made_sensor(900), settings, 1, detector);
  int accepted = 0, refused = 0;
  for (const Scan& scan : scans) {
    for (const LoopReport& loop : slam.process(scan).loops) {
      EXPECT_EQ(loop.candidate.detector, LoopCandidate::Detector::custom);
      EXPECT_LT(loop.match_scan, loop.query_scan);
      (loop.verification.verdict == Verdict::accepted ? accepted : refused)++;
    }
  }
  EXPECT_GT(accepted + refused, 0);
  EXPECT_EQ(slam.graph().loop_edges().size(), static_cast<std::size_t>(accepted));
}

TEST(Slam, AKeyFrameThatIsNotEligibleIsRefusedByName) {
  const std::vector<Scan> scans = drive(85, 6.5);
  const LoopDetector detector = [](const LoopQuery& query) {
    LoopCandidate candidate;
    candidate.match = query.eligible;
    return std::vector{candidate};
  };
  Slam slam(made_sensor(900), with_short_loops(), 1, detector);
  const auto run = [&] {
    for (const Scan& scan : scans) slam.process(scan);
  };
  EXPECT_THROW(run(), std::invalid_argument);
}

TEST(Slam, TwoRunsAndRunsWithMoreThreadsGiveTheSameBits) {
  const std::vector<Scan> scans = drive(85, 6.5);
  const auto run = [&](int threads) {
    Slam slam(made_sensor(900), with_short_loops(), threads);
    for (const Scan& scan : scans) slam.process(scan);
    return slam;
  };
  const Slam first = run(1);
  EXPECT_GE(first.graph().loop_edges().size(), 1u);
  expect_same(first, run(1));
  expect_same(first, run(2));
  expect_same(first, run(4));
}

// Written and read again after every 20 scans, in a process that knows nothing else.
TEST(Slam, ARunThatIsReadFromItsStateGoesOnToTheSameBits) {
  const std::vector<Scan> scans = drive(105, 6.5);
  Slam whole(made_sensor(900), with_short_loops());
  Slam resumed(made_sensor(900), with_short_loops());
  std::string growth;
  GrownCounts counts;
  for (std::size_t k = 0; k < scans.size(); ++k) {
    whole.process(scans[k]);
    resumed.process(scans[k]);
    if (k % 20 != 5) continue;
    StateWriter writer(counts, [&](std::string_view bytes) { growth += bytes; });
    ASSERT_TRUE(resumed.write(writer));
    StateReader reader(writer.bytes(), growth);
    Slam next(made_sensor(900), with_short_loops());
    next.read(reader);
    EXPECT_EQ(reader.counts(), writer.counts());
    counts = reader.counts();
    resumed = std::move(next);
  }
  EXPECT_GE(whole.graph().loop_edges().size(), 1u);
  expect_same(whole, resumed);
}

TEST(Slam, AStateThatIsCutOffIsRefused) {
  const std::vector<Scan> scans = drive(3, 3.0);
  Slam slam(made_sensor(900), {});
  StateWriter early;
  slam.process(scans[0]);
  EXPECT_FALSE(slam.write(early));
  slam.process(scans[1]);
  std::string growth;
  StateWriter writer({}, [&](std::string_view bytes) { growth += bytes; });
  ASSERT_TRUE(slam.write(writer));
  for (std::size_t size = 0; size < writer.bytes().size(); size += 1 + size / 3) {
    StateReader reader(std::string_view(writer.bytes()).substr(0, size), growth);
    Slam next(made_sensor(900), {});
    EXPECT_THROW(next.read(reader), StateError) << size;
  }
}

TEST(Slam, ScansWithoutUsablePointsArePredicted) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  for (const Eigen::Vector3f& point :
       {Eigen::Vector3f(nan, nan, nan), Eigen::Vector3f(0, 0, 0), Eigen::Vector3f(1e30f, 1e30f, 0),
        Eigen::Vector3f(infinity, 0, 0), Eigen::Vector3f(5, nan, 1), Eigen::Vector3f(0, 0, -5),
        Eigen::Vector3f(0.1f, 0, 0), Eigen::Vector3f(500, 0, 0)}) {
    Slam slam(made_sensor(900), {});
    std::vector<Scan> scans;
    for (int k = 0; k < 3; ++k) scans.push_back(scan_of(repeated(point, 500), k * kPeriodNs));
    for (const Status status : statuses(slam, scans)) EXPECT_EQ(status, Status::too_few_points);
  }
}

TEST(Slam, EmptyScansOnePointAndOneRingDoNotEndARun) {
  const SensorModel sensor = made_sensor(900);
  std::vector<Eigen::Vector3f> ring;
  for (int column = 0; column < sensor.columns; ++column)
    ring.push_back(5.0f * beam(column_azimuth(sensor, column), radians(1.0)).cast<float>());
  std::vector<Scan> scans;
  for (int k = 0; k < 12; ++k)
    scans.push_back(scan_of(k % 4 == 0   ? std::vector<Eigen::Vector3f>{}
                            : k % 4 == 1 ? repeated({5, 1, 0.1f}, 1)
                            : k % 4 == 2 ? ring
                                         : repeated({6.0f, 0.5f, 0.1051f}, 1000),
                            k * kPeriodNs));
  Slam slam(sensor, {});
  const std::vector<Status> status = statuses(slam, scans);
  for (int k = 0; k < 12; k += 4) {
    EXPECT_EQ(status[k], Status::too_few_points);
    EXPECT_EQ(status[k + 1], Status::too_few_points);
  }
}

TEST(Slam, ARunGoesOnAfterEmptyScans) {
  constexpr double kSpeed = 3.0;
  std::vector<Scan> scans = drive(30, kSpeed);
  for (const int k : {10, 11, 20}) scans[k] = scan_of({}, scans[k].stamp_ns);
  Slam slam(made_sensor(900), {});
  const std::vector<Status> status = statuses(slam, scans);
  for (int k = 0; k < 30; ++k)
    EXPECT_EQ(status[k], k == 10 || k == 11 || k == 20 ? Status::too_few_points : Status::ok) << k;
  EXPECT_LT(error_between(slam, 0, 29, kSpeed).translation().norm(), 0.10);
  // The prediction carries the motion on through the gap.
  EXPECT_LT(error_between(slam, 0, 11, kSpeed).translation().norm(), 0.15);
}

TEST(Slam, ARunBeginsWhenTheFirstScansAreEmpty) {
  std::vector<Scan> scans = drive(12, 3.0);
  for (int k = 0; k < 3; ++k) scans[k] = scan_of({}, scans[k].stamp_ns);
  Slam slam(made_sensor(900), {});
  const std::vector<Status> status = statuses(slam, scans);
  for (int k = 0; k < 12; ++k)
    EXPECT_EQ(status[k], k < 3 ? Status::too_few_points : Status::ok) << k;
  EXPECT_LT(error_between(slam, 3, 11, 3.0).translation().norm(), 0.10);
}

TEST(Slam, AScanThatIsNotAfterTheOneBeforeIsIgnored) {
  std::vector<Scan> scans = drive(12, 3.0);
  Slam expected(made_sensor(900), {});
  for (const Scan& scan : scans) expected.process(scan);

  Slam slam(made_sensor(900), {});
  scans.insert(scans.begin() + 8, scans[7]);
  scans.insert(scans.begin() + 5, scans[2]);
  const std::vector<Status> status = statuses(slam, scans);
  for (int k = 0; k < 14; ++k) EXPECT_EQ(status[k] == Status::out_of_order, k == 5 || k == 9) << k;
  expect_same(slam, expected);
}

TEST(Slam, AScanFromAnotherPlaceIsLostAndChangesNothingElse) {
  std::vector<Scan> scans = drive(20, 3.0);
  scans[12] = take_scan(street(), made_sensor(900), pose_of(2, 0, kMadeHeight, 70.0),
                        {.stamp_ns = scans[12].stamp_ns, .noise = kNoise});
  Slam slam(made_sensor(900), {});
  const std::vector<Status> status = statuses(slam, scans);
  EXPECT_EQ(status[12], Status::lost);
  EXPECT_EQ(status[19], Status::ok);
  EXPECT_LT(error_between(slam, 0, 19, 3.0).translation().norm(), 0.10);
}

TEST(Slam, ASensorAtRestStaysWhereItIs) {
  std::vector<Scan> scans;
  for (int k = 0; k < 30; ++k)
    scans.push_back(take_scan(hall(), made_sensor(900), pose_of(3, 4, kMadeHeight, 30.0),
                              {.stamp_ns = k * kPeriodNs, .noise = kNoise, .seed = 4}));
  Slam slam(made_sensor(900), {});
  for (const Status status : statuses(slam, scans)) EXPECT_EQ(status, Status::ok);
  EXPECT_EQ(slam.key_frames().size(), 1u);
  for (const StampedPose& p : slam.trajectory()) {
    EXPECT_LT(p.pose.translation().norm(), 0.02);
    EXPECT_LT(degrees(rotation_angle(p.pose)), 0.1);
  }
}

TEST(Slam, TheHeightOfTheSensorIsEstimatedWhenItIsNotKnown) {
  const std::vector<Scan> scans = drive(3, 3.0);
  Slam slam(made_sensor(900), {});
  EXPECT_EQ(slam.sensor_height(), 0.0);
  for (const Scan& scan : scans) slam.process(scan);
  EXPECT_NEAR(slam.sensor_height(), kMadeHeight, 0.05);
}

TEST(Slam, SettingsOutOfRangeAreRefused) {
  Settings settings;
  settings.mapping.voxel_size = -1.0;
  EXPECT_THROW(Slam(made_sensor(), settings), std::invalid_argument);
  SensorModel sensor = made_sensor();
  sensor.elevation_deg.clear();
  EXPECT_THROW(Slam(sensor, {}), std::invalid_argument);
}

}  // namespace
}  // namespace lego_loam_sc
