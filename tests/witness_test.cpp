// SPDX-License-Identifier: BSD-3-Clause
#include "tracking/witness.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "made_scenes.hpp"

namespace lego_loam_sc {
namespace {

std::vector<Eigen::Vector3f> seen_from(const Pose& T_world_lidar) {
  return project(take_scan(hall(), made_sensor(900), T_world_lidar, {.noise = 0.01}),
                 made_sensor(900))
      .points;
}

std::vector<Eigen::Vector3f> some(const std::vector<Eigen::Vector3f>& points) {
  std::vector<Eigen::Vector3f> chosen;
  for (const std::size_t i : witnesses(points.size())) chosen.push_back(points[i]);
  return chosen;
}

TEST(Witness, AgreesAtTheTruePoseAndContradictsAWrongOne) {
  const Pose start = pose_of(-3.0, 4.0, kMadeHeight, 0.0);
  const Pose truth = pose_of(-1.0, 4.3, kMadeHeight, 12.0);
  Witness witness(row_spacing(made_sensor(900)));
  witness.add(0, seen_from(start), start);
  const std::vector<Eigen::Vector3f> points = some(seen_from(truth));
  const Testimony good = witness.hear(points, truth);
  EXPECT_LT(good.contradiction(), 0.05);
  EXPECT_GT(good.agreeing, 200);
  EXPECT_GT(witness.hear(points, start).contradiction(), good.contradiction());
  EXPECT_GT(witness.hear(points, truth * pose_of(0, 0, 0, 60)).contradiction(), 0.15);
}

TEST(Witness, SaysNothingWithoutAView) {
  const Witness witness(0.01);
  EXPECT_TRUE(std::isnan(witness.hear({}, Pose::Identity()).contradiction()));
}

TEST(Witness, FollowsItsKeyFramesWhenTheGraphMovesThem) {
  const Pose start = pose_of(-3.0, 4.0, kMadeHeight, 0.0);
  const Pose moved = pose_of(50.0, 20.0, kMadeHeight, 30.0);
  Witness witness(row_spacing(made_sensor(900)));
  witness.add(0, seen_from(start), start);
  witness.correct(std::vector<Pose>{moved});
  EXPECT_LT(witness.hear(some(seen_from(start)), moved).contradiction(), 0.05);
}

}  // namespace
}  // namespace lego_loam_sc
