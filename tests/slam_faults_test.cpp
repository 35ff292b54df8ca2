// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <vector>

#include "made_drive.hpp"

namespace lego_loam_sc {
namespace {

constexpr double kSpeed = 3.0;
constexpr std::int64_t kHourNs = 3'600'000'000'000;

/// A drive of made scans with faults put into it.
struct FaultyRun {
  std::vector<ScanReport> reports;
  Trajectory trajectory;
};

FaultyRun run(const std::vector<Scan>& scans, const SensorModel& sensor = made_sensor(900)) {
  Slam slam(sensor, {});
  FaultyRun result;
  for (const Scan& scan : scans) {
    result.reports.push_back(slam.process(scan));
    EXPECT_TRUE(result.reports.back().T_odom_lidar.matrix().allFinite());
  }
  result.trajectory = slam.trajectory();
  for (const StampedPose& p : result.trajectory) EXPECT_TRUE(p.pose.matrix().allFinite());
  return result;
}

int count(const FaultyRun& run, Status status) {
  int n = 0;
  for (const ScanReport& report : run.reports) n += report.status == status;
  return n;
}

int count_jumps(const FaultyRun& run) {
  int n = 0;
  for (const ScanReport& report : run.reports) n += report.stamp_jump_s != 0.0;
  return n;
}

// Metres between where the run is at pose `index` and the truth is after `seconds`, both counted
// from the first scan.
double error_after(const FaultyRun& run, int index, double seconds) {
  const Pose estimate = run.trajectory[0].pose.inverse() * run.trajectory[index].pose;
  const Pose truth = truth_at(0.0, kSpeed).inverse() * truth_at(seconds, kSpeed);
  return (truth.inverse() * estimate).translation().norm();
}

double error_at(const FaultyRun& run, int scan) {
  return error_after(run, scan, scan * kPeriod);
}

std::vector<Scan> with(std::vector<Scan> scans, const std::function<void(int, Scan&)>& fault) {
  for (int k = 0; k < static_cast<int>(scans.size()); ++k) fault(k, scans[k]);
  return scans;
}

void leave(Scan& scan, const std::function<bool(std::size_t)>& keep) {
  Scan kept;
  kept.stamp_ns = scan.stamp_ns;
  for (std::size_t i = 0; i < scan.size(); ++i) {
    if (!keep(i)) continue;
    kept.points.push_back(scan.points[i]);
    kept.intensity.push_back(scan.intensity[i]);
    kept.ring.push_back(scan.ring[i]);
    kept.offset_ns.push_back(scan.offset_ns[i]);
  }
  scan = kept;
}

TEST(SlamFaults, BadScansAmongGoodOnesArePredictedAndCostNothingElse) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const auto fill = [](Scan& scan, const Eigen::Vector3f& point) {
    for (Eigen::Vector3f& p : scan.points) p = point;
  };
  const std::vector<std::function<void(Scan&)>> faults = {
      [](Scan& scan) { leave(scan, [](std::size_t) { return false; }); },
      [](Scan& scan) { leave(scan, [](std::size_t i) { return i == 0; }); },
      [&](Scan& scan) { fill(scan, {nan, nan, nan}); },
      [&](Scan& scan) { fill(scan, {5, 1, 0}); },
      [&](Scan& scan) { fill(scan, {1e30f, 1e30f, 1e30f}); },
      [&](Scan& scan) { fill(scan, {0, 0, 0}); },
  };
  const std::vector<Scan> scans = drive(30, kSpeed);
  const FaultyRun whole = run(scans);
  for (std::size_t f = 0; f < faults.size(); ++f) {
    const FaultyRun faulty = run(with(scans, [&](int k, Scan& scan) {
      if (k == 15 || k == 22) faults[f](scan);
    }));
    for (int k = 0; k < 30; ++k) {
      const Status status = faulty.reports[k].status;
      const bool predicted = status == Status::too_few_points || status == Status::lost;
      EXPECT_TRUE(k == 15 || k == 22 ? predicted : status == Status::ok)
          << "fault " << f << ", scan " << k << ": " << to_string(status);
    }
    EXPECT_LT(error_at(faulty, 15), 0.1) << f;  // predicted
    EXPECT_LT(error_at(faulty, 29), error_at(whole, 29) + 0.02) << f;
  }
}

TEST(SlamFaults, OneRingAloneEndsNothing) {
  const FaultyRun faulty = run(with(drive(30, kSpeed), [](int k, Scan& scan) {
    if (k == 15) leave(scan, [&](std::size_t i) { return scan.ring[i] == 7; });
  }));
  EXPECT_LT(error_at(faulty, 15), 0.05);  // walls all round hold a single ring
  EXPECT_EQ(faulty.reports[29].status, Status::ok);
  EXPECT_LT(error_at(faulty, 29), 0.1);
}

TEST(SlamFaults, ZerosForNoReturnAmongTheReturnsChangeNothing) {
  const std::vector<Scan> scans = drive(12, kSpeed);
  const FaultyRun whole = run(scans);
  const FaultyRun padded = run(with(scans, [](int, Scan& scan) {
    for (int i = 0; i < 500; ++i) {
      scan.points.push_back(
          i % 2 == 0 ? Eigen::Vector3f(0, 0, 0)
                     : Eigen::Vector3f::Constant(std::numeric_limits<float>::quiet_NaN()));
      scan.intensity.push_back(0);
      scan.ring.push_back(static_cast<std::uint16_t>(i % 16));
      scan.offset_ns.push_back(i % 3 == 0 ? 0 : 2'000'000'000);
    }
  }));
  ASSERT_EQ(padded.trajectory.size(), whole.trajectory.size());
  for (std::size_t k = 0; k < whole.trajectory.size(); ++k)
    EXPECT_EQ(padded.trajectory[k].pose.matrix(), whole.trajectory[k].pose.matrix()) << k;
}

TEST(SlamFaults, StampsThatJumpAnHourAreBridgedAndKept) {
  const std::vector<Scan> scans = drive(24, kSpeed);
  const FaultyRun whole = run(scans);
  for (const std::int64_t jump : {kHourNs, -kHourNs}) {
    const FaultyRun faulty = run(with(scans, [&](int k, Scan& scan) {
      if (k >= 14) scan.stamp_ns += jump;
    }));
    EXPECT_EQ(count(faulty, Status::ok), 24);
    EXPECT_EQ(count_jumps(faulty), 1);
    EXPECT_DOUBLE_EQ(faulty.reports[14].stamp_jump_s, 1e-9 * static_cast<double>(jump) + 0.1);
    EXPECT_EQ(faulty.trajectory[23].stamp_ns, scans[23].stamp_ns + jump);
    EXPECT_LT(error_at(faulty, 23), error_at(whole, 23) + 0.02);
  }
}

TEST(SlamFaults, OneWrongStampCostsNoScan) {
  const FaultyRun faulty = run(with(drive(24, kSpeed), [](int k, Scan& scan) {
    if (k == 14) scan.stamp_ns += kHourNs;
  }));
  EXPECT_EQ(count(faulty, Status::ok), 24);
  EXPECT_EQ(count_jumps(faulty), 2);
  EXPECT_LT(error_at(faulty, 23), 0.1);
}

TEST(SlamFaults, StampsThatRepeatOrComeLateAreRefusedOneByOne) {
  std::vector<Scan> scans = drive(24, kSpeed);
  scans[14].stamp_ns = scans[13].stamp_ns;
  scans[18].stamp_ns = scans[15].stamp_ns;
  const FaultyRun faulty = run(scans);
  EXPECT_EQ(count(faulty, Status::out_of_order), 2);
  EXPECT_EQ(count(faulty, Status::ok), 22);
  ASSERT_EQ(faulty.trajectory.size(), 22u);
  EXPECT_LT(error_after(faulty, 21, 23 * kPeriod), 0.1);
}

TEST(SlamFaults, StampsBeyondAllTimeAreRefused) {
  std::vector<Scan> scans = drive(14, kSpeed);
  scans[0].stamp_ns = std::numeric_limits<std::int64_t>::min();
  scans[11].stamp_ns = std::numeric_limits<std::int64_t>::max();
  const FaultyRun faulty = run(scans);
  EXPECT_EQ(count(faulty, Status::out_of_order), 2);
  EXPECT_EQ(count(faulty, Status::ok), 12);
}

TEST(SlamFaults, AGapOfASecondIsBridgedByTheMotionBeforeIt) {
  std::vector<Scan> scans = drive(40, kSpeed);
  scans.erase(scans.begin() + 20, scans.begin() + 30);
  const FaultyRun faulty = run(scans);
  EXPECT_EQ(count(faulty, Status::ok), 30);
  EXPECT_LT(error_after(faulty, 29, 39 * kPeriod), 0.1);
}

TEST(SlamFaults, AGapOfTenSecondsAtRestIsBridged) {
  std::vector<Scan> scans = drive(14, 0.0);
  for (int k = 7; k < 14; ++k) scans[k].stamp_ns += 10'000'000'000;
  const FaultyRun faulty = run(scans);
  EXPECT_EQ(count(faulty, Status::ok), 14);
  EXPECT_EQ(count_jumps(faulty), 1);
  EXPECT_LT(faulty.trajectory.back().pose.translation().norm(), 0.02);
}

TEST(SlamFaults, HalfOfTheSweepIsEnough) {
  const FaultyRun faulty = run(with(drive(30, kSpeed), [](int k, Scan& scan) {
    if (k >= 10)
      leave(scan, [&](std::size_t i) { return (k < 20 ? 1.0f : -1.0f) * scan.points[i].y() > 0; });
  }));
  EXPECT_EQ(count(faulty, Status::ok), 30);
  EXPECT_LT(error_at(faulty, 29), 0.1);
}

// A second sensor on the same vehicle, 1.5 m behind and facing backwards, came into the stream.
TEST(SlamFaults, AnotherSensorsScansInBetweenAreNoSilentError) {
  const SensorModel sensor = made_sensor(900);
  const Scene scene = hall();
  const Pose T_first_second = pose_of(-1.5, 0, 0.3, 180.0);
  std::vector<Scan> scans;
  for (const Scan& scan : drive(30, kSpeed)) {
    scans.push_back(scan);
    const double at = 1e-9 * static_cast<double>(scan.stamp_ns) + 0.05;
    if (scans.size() > 20)
      scans.push_back(take_sweep(
          scene, sensor,
          [&](double seconds) { return Pose(truth_at(at + seconds, kSpeed) * T_first_second); },
          {.stamp_ns = scan.stamp_ns + 50'000'000, .noise = kNoise, .seed = 5}));
  }
  const FaultyRun faulty = run(scans);
  int first = 0;  // number of the scan among those of the first sensor
  for (std::size_t k = 0; k < scans.size(); ++k) {
    const bool second = scans[k].stamp_ns % kPeriodNs != 0;
    if (second) {
      EXPECT_EQ(faulty.reports[k].status, Status::lost) << k;
      continue;
    }
    EXPECT_EQ(faulty.reports[k].status, Status::ok) << k;
    EXPECT_LT(error_after(faulty, static_cast<int>(k), first++ * kPeriod), 0.1) << k;
  }
}

// The sensor file says 0.1 s for a turn.
TEST(SlamFaults, OtherRatesThanTheSensorFilesWork) {
  for (const double rate : {5.0, 10.0, 20.0}) {
    SensorModel turning = made_sensor(900);
    turning.period = 1.0 / rate;
    const Scene scene = hall();
    std::vector<Scan> scans;
    const int last = static_cast<int>(3 * rate);
    for (int k = 0; k <= last; ++k)
      scans.push_back(take_sweep(
          scene, turning, [&](double seconds) { return truth_at(k / rate + seconds, kSpeed); },
          {.stamp_ns = std::llround(k * 1e9 / rate), .noise = kNoise, .seed = 3}));
    const FaultyRun faulty = run(scans, made_sensor(900));
    EXPECT_EQ(count(faulty, Status::ok), last + 1) << rate;
    EXPECT_LT(error_after(faulty, last, 3.0), 0.1) << rate;
  }
}

}  // namespace
}  // namespace lego_loam_sc
