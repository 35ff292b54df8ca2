// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "made_scenes.hpp"
#include "sim/random.hpp"
#include "slam/slam.hpp"

namespace lego_loam_sc {
namespace {

// A vehicle goes round a block, and its way is lost: by a covered lens, a gap in the recording or
// somebody who carries it elsewhere.

constexpr double kSpeed = 6.0;   // m/s
constexpr double kSide = 40.0;   // m; of the block, along the middle of the street
constexpr double kCorner = 8.0;  // m; radius
const double kLap = 4.0 * (kSide - 2.0 * kCorner) + 2.0 * M_PI * kCorner;

// Houses, walls and poles on both sides of the street, no two places alike.
Scene block() {
  Scene scene;
  scene.plane({0, 0, 0}, Eigen::Vector3d::UnitZ());
  scene.box({-kSide, -kSide, -1}, {kSide, kSide, 12});
  const double inner = 0.5 * kSide - 6.0;
  scene.box({-inner, -inner, 0}, {inner, inner, 9});
  Random random(17);
  const auto between = [&](double low, double high) { return random.uniform(low, high); };
  for (int side = 0; side < 4; ++side) {
    const auto add = [&](double along, double across, double length, double depth, double height) {
      Eigen::Vector2d low(along, across), high(along + length, across + depth);
      for (int turn = 0; turn < side; ++turn) {
        low = Eigen::Vector2d(-low.y(), low.x());
        high = Eigen::Vector2d(-high.y(), high.x());
      }
      scene.box({std::min(low.x(), high.x()), std::min(low.y(), high.y()), 0},
                {std::max(low.x(), high.x()), std::max(low.y(), high.y()), height});
    };
    for (double at = -kSide; at < kSide - 5.0;) {
      const double length = between(3.0, 9.0);
      add(at, -0.5 * kSide - between(10.0, 16.0), length, 4.0, between(2.0, 9.0));
      at += length + between(1.0, 5.0);
    }
    for (double at = -inner; at < inner - 2.0; at += between(3.0, 8.0))
      add(at, -inner - between(0.3, 2.0), between(0.3, 2.0), 2.0, between(1.0, 5.0));
  }
  return scene;
}

// T_world_lidar after so many metres along the middle of the street.
Pose round_the_block(double metres) {
  const double straight = kSide - 2.0 * kCorner;
  const double arc = 0.5 * M_PI * kCorner;
  double rest = std::fmod(metres, kLap);
  Pose pose = pose_of(-0.5 * straight, -0.5 * kSide, kMadeHeight);
  while (rest > 0.0) {
    const double ahead = std::min(rest, straight);
    pose = pose * pose_of(ahead, 0, 0);
    rest -= ahead;
    const double turned = std::min(rest, arc) / kCorner;
    pose = pose * pose_of(kCorner * std::sin(turned), kCorner * (1.0 - std::cos(turned)), 0,
                          degrees(turned));
    rest -= turned * kCorner;
  }
  return pose;
}

// A drive of a sensor with 16 beams and 600 columns.
class LostDrive {
 public:
  // For so many metres, at a speed in m/s.
  void on(double metres, double speed = kSpeed, bool blind = false) {
    for (const double end = metres_ + metres; metres_ < end; metres_ += speed * kTurn) {
      Scan scan;
      if (!blind)
        scan =
            take_sweep(scene_, sensor_,
                       [&](double seconds) { return round_the_block(metres_ + speed * seconds); },
                       {.stamp_ns = stamp_ns_, .noise = 0.01, .seed = 3});
      scan.stamp_ns = stamp_ns_;
      reports.push_back(slam.process(scan));
      truth_.push_back(metres_);
      stamp_ns_ += std::llround(1e9 * kTurn);
    }
  }
  // Without a scan.
  void wait(double seconds) { stamp_ns_ += std::llround(1e9 * seconds); }
  void carry(double metres) { metres_ += metres; }

  int scans() const { return static_cast<int>(reports.size()); }
  int count(Status status, int from) const {
    return static_cast<int>(std::count_if(reports.begin() + from, reports.end(),
                                          [&](const auto& r) { return r.status == status; }));
  }

  // The largest error of the final positions from a scan on, m.
  double largest_error(int from) const {
    const Trajectory trajectory = slam.trajectory();
    double largest = 0.0;
    for (int k = from; k < scans(); ++k) {
      const Pose truth = round_the_block(0).inverse() * round_the_block(truth_[k]);
      const Pose estimate = trajectory[0].pose.inverse() * trajectory[k].pose;
      largest = std::max(largest, (truth.inverse() * estimate).translation().norm());
    }
    return largest;
  }

  Slam slam{made_sensor(600), {}};
  std::vector<ScanReport> reports;

 private:
  static constexpr double kTurn = 0.1;  // s

  Scene scene_ = block();
  SensorModel sensor_ = made_sensor(600);
  std::int64_t stamp_ns_ = 0;
  double metres_ = 0.0;
  std::vector<double> truth_;
};

// From scan `from` on, the way is reported lost at once and found again within `scans`.
void expect_found_again(const LostDrive& drive, int from, int scans) {
  EXPECT_EQ(drive.reports[from].status, Status::lost);
  EXPECT_EQ(drive.count(Status::lost, 0), drive.count(Status::lost, from));
  EXPECT_EQ(drive.count(Status::lost, from + scans), 0);
  EXPECT_EQ(drive.slam.maps(), 1);
  // The first sweep after a blind time is de-skewed with the speed from before it.
  EXPECT_LT(drive.largest_error(from + scans), 0.25);
}

TEST(SlamLost, ABlindMinuteThenAKnownPlaceIsFoundAgain) {
  LostDrive drive;
  drive.on(0.5 * kLap);
  const int blind = drive.scans();
  constexpr double kMinute = 60.0;
  drive.on(1.6 * kLap, 1.6 * kLap / kMinute, true);
  const int sight = drive.scans();
  EXPECT_NEAR(sight - blind, 600, 1);
  drive.on(0.2 * kLap, 0.6 * kSpeed);
  EXPECT_EQ(drive.count(Status::too_few_points, 0), sight - blind);
  expect_found_again(drive, sight, 10);
  EXPECT_EQ(drive.reports.back().piece, 1);
}

TEST(SlamLost, SightInAnUnknownPlaceBeginsAPieceThatALoopJoins) {
  LostDrive drive;
  drive.on(0.2 * kLap);
  drive.on(0.3 * kLap, kSpeed, true);
  const int sight = drive.scans();
  drive.on(0.35 * kLap);
  EXPECT_EQ(drive.slam.maps(), 2);
  EXPECT_EQ(drive.reports.back().piece, 1);
  EXPECT_GT(drive.largest_error(sight), 10.0);  // nobody knows yet
  drive.on(0.35 * kLap);
  expect_found_again(drive, sight, 10);
}

TEST(SlamLost, ASensorThatWasCarriedToAKnownPlaceIsFoundAgain) {
  LostDrive drive;
  drive.on(0.6 * kLap);
  const int carried = drive.scans();
  drive.carry(0.6 * kLap);
  drive.on(0.2 * kLap);
  expect_found_again(drive, carried, 10);
}

TEST(SlamLost, AfterAGapOfTenSecondsOnTheMoveTheKnownPlaceIsFoundAgain) {
  LostDrive drive;
  drive.on(0.9 * kLap);
  const int gap = drive.scans();
  drive.wait(10.0);
  drive.carry(10.0 * kSpeed);
  drive.on(0.2 * kLap);
  EXPECT_NEAR(drive.reports[gap].stamp_jump_s, 10.1, 1e-6);
  expect_found_again(drive, gap, 10);
}

}  // namespace
}  // namespace lego_loam_sc
