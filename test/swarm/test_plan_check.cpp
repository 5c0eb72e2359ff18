// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The check is the last word before a plan flies: what it lets through is flown, whatever the solver did. If these fail
// UAVs collide, or stand still in front of nothing.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <limits>

#include "check_scene.hpp"

namespace swarm_planner {
namespace {

/// Samples may fall short of what is proven by this: the check's tolerances.
constexpr double kAllowance = 3.0 * kDistanceTolerance;

/// Counts what the check says about scenes against what dense samples say.
struct Tally {
  int accepted = 0;
  int refused_unsafe = 0;
  int safe = 0;  ///< by samples, with more than a centimetre to spare
  int refused_safe = 0;
  int undecided = 0;

  void add(CheckScene& scene, const char* what, int n) {
    const CheckVerdict verdict = scene.check();
    const SampledSlack sampled = sampledSlack(scene);
    if (!verdict.accepted() && verdict.reason < CheckReason::kObstacle) return;  // a bound, which is not meant here
    if (verdict.accepted()) {
      ++accepted;
      ASSERT_GE(sampled.slack, -kAllowance) << what << " " << n << " at " << sampled.time << " s";
    } else if (sampled.slack < 0.0) {
      ++refused_unsafe;
    }
    undecided += verdict.undecided ? 1 : 0;
    if (sampled.slack < 0.01) return;
    ++safe;
    refused_safe += verdict.accepted() ? 0 : 1;
  }

  void print(const char* what) const {
    std::printf("  %s: accepted %d, refused and unsafe %d, refused though 1 cm clear %d of %d, undecided %d\n", what,
                accepted, refused_unsafe, refused_safe, safe, undecided);
  }
};

/// In a third of the scenes a motion before that was about where the plan starts.
void varyTheRule(Random& random, CheckScene& scene) {
  if (random.integer(0, 2) == 0) scene.committed = scene.start.p + random.vector(-0.1, 0.1);
}

TEST(PlanCheck, AcceptsNothingThatSamplesFindTooCloseToAnObstacle) {
  Random random(1);
  Tally tally;
  for (int n = 0; n < 900; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    varyTheRule(random, scene);
    for (int i = random.integer(1, 2); i > 0; --i) scene.addRandomObstacle(random, random.uniform(0.4, 1.0));
    tally.add(scene, "obstacles", n);
  }
  tally.print("obstacles");
  EXPECT_GT(tally.accepted, 150);
  EXPECT_GT(tally.refused_unsafe, 300);
  EXPECT_LT(tally.undecided, 10);
  EXPECT_LT(tally.refused_safe, 0.02 * tally.safe);
}

TEST(PlanCheck, AcceptsNothingThatSamplesFindTooCloseToAUav) {
  Random random(2);
  Tally tally;
  for (int n = 0; n < 3000; ++n) {
    CheckScene scene;
    scene.limits.pair_vertical = n % 2 == 0 ? 2.0 : 3.0;
    scene.planRandomly(random, 4.0);
    varyTheRule(random, scene);
    for (int i = random.integer(1, 3); i > 0; --i) scene.addRandomUav(random, random.uniform(1.05, 1.6));
    tally.add(scene, "uavs", n);
  }
  tally.print("UAVs");
  EXPECT_GT(tally.accepted, 500);
  EXPECT_GT(tally.refused_unsafe, 500);
  EXPECT_LT(tally.undecided, 10);
  EXPECT_LT(tally.refused_safe, 0.02 * tally.safe);
}

// Curves that touch what is demanded to a tenth of a millimetre: the proofs must tell the two sides apart.
TEST(PlanCheck, TellsTouchingFromCuttingIn) {
  Random random(3);
  int touching = 0;
  int accepted = 0;
  int undecided = 0;
  for (int n = 0; n < 300; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    scene.addRandomObstacle(random, random.uniform(0.6, 0.8));
    PredictedObstacle& obstacle = scene.surroundings.obstacles[0];
    const SampledSlack sampled = sampledSlack(scene);
    // At the start less may be demanded.
    if (sampled.slack <= -0.25 || sampled.waived || sampled.time == 0.0) continue;
    obstacle.least_distance += sampled.slack - 1e-4;  // 0.1 mm to spare
    const CheckVerdict verdict = scene.check();
    const bool judged = verdict.accepted() || verdict.reason >= CheckReason::kObstacle;
    if (!judged || sampledSlack(scene).waived) continue;
    ++touching;
    accepted += verdict.accepted() ? 1 : 0;
    undecided += verdict.undecided ? 1 : 0;
    obstacle.least_distance += 2e-4;
    if (sampledSlack(scene).waived) continue;
    ASSERT_FALSE(scene.check().accepted()) << n;
  }
  std::printf("  0.1 mm to spare: accepted %d of %d, undecided %d\n", accepted, touching, undecided);
  EXPECT_GT(touching, 100);
  EXPECT_GT(accepted, 0.98 * touching);
}

TEST(PlanCheck, CatchesAnObstacleMovedByFiveCentimetres) {
  Random random(4);
  int moved = 0;
  for (int n = 0; n < 1500; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 4.0);
    scene.addRandomObstacle(random, random.uniform(0.5, 0.6));
    if (!scene.check().accepted()) continue;
    const SampledSlack sampled = sampledSlack(scene);
    if (sampled.slack > 0.045 || sampled.waived) continue;
    PredictedObstacle& obstacle = scene.surroundings.obstacles[0];
    const Superellipsoid& body = *obstacle.body;
    const double age = scene.motion.epoch() - obstacle.stamp;
    const Vector3 point = scene.motion.after(sampled.time).p - (sampled.time + age) * body.velocity();
    Vector3 slope;
    for (int i = 0; i < 3; ++i) {
      slope[i] = body.signedDistance(point + 1e-5 * Vector3::Unit(i)) - body.signedDistance(point);
    }
    scene.bodies.emplace_back(1, body.center() + 0.05 * slope.normalized(), body.radii(), body.exponents(), body.yaw(),
                              body.velocity());
    obstacle.body = &scene.bodies.back();
    if (sampledSlack(scene).waived) continue;
    const CheckVerdict verdict = scene.check();
    ASSERT_FALSE(verdict.accepted()) << n;
    ASSERT_EQ(verdict.body, 0);
    ++moved;
  }
  std::printf("  obstacles moved: %d\n", moved);
  EXPECT_GT(moved, 50);
}

TEST(PlanCheck, CatchesANeighbourDelayedByOneStage) {
  // It crosses 2.4 m ahead at 4 m/s; 0.3 s later it is 1.2 m less, and closer than 2.2 m.
  const Trajectory plan = straightPlan(Vector3::Zero(), Vector3(4.0, 0.0, 0.0), 10.0, 0.3);
  CheckScene scene;
  scene.plan(plan);
  scene.addUav(straightPlan(Vector3(8.0, -12.0, 0.0), Vector3(0.0, 4.0, 0.0), 10.0, 0.3));
  EXPECT_TRUE(scene.check().accepted());
  CheckScene delayed;
  delayed.plan(plan);
  delayed.addUav(straightPlan(Vector3(8.0, -12.0, 0.0), Vector3(0.0, 4.0, 0.0), 10.3, 0.3));
  EXPECT_TRUE(delayed.check().accepted());  // that way it passes behind

  Random random(5);
  int caught = 0;
  for (int n = 0; n < 3000; ++n) {
    CheckScene before;
    before.planRandomly(random, 4.0);
    before.addRandomUav(random, random.uniform(1.1, 1.3));
    if (!before.check().accepted()) continue;
    Trajectory late = before.trajectory;
    late.epoch -= late.dt;  // the other one is late by a stage
    CheckScene after;
    after.limits = before.limits;
    after.plan(late);
    after.addMotion(before.others.back());
    const SampledSlack sampled = sampledSlack(after);
    if (sampled.slack >= -kAllowance) continue;
    ASSERT_FALSE(after.check().accepted()) << n;
    ++caught;
  }
  std::printf("  neighbours delayed into the way: %d\n", caught);
  EXPECT_GT(caught, 100);
}

TEST(PlanCheck, CatchesEveryChangedNumber) {
  Random random(6);
  CheckScene scene;
  scene.planRandomly(random, 3.0);
  ASSERT_TRUE(scene.check().accepted());
  const Trajectory good = scene.trajectory;
  for (std::size_t k = 0; k <= kHorizon; ++k) {
    for (int i = 0; i < 9; ++i) {
      const auto number = [&]() -> double& {
        KinematicState& x = scene.trajectory.knots[k];
        return (i < 3 ? x.p : i < 6 ? x.v : x.a)[i % 3];
      };
      number() += 1e-5;
      ASSERT_EQ(scene.check().reason, CheckReason::kDiscontinuous) << k << " " << i;
      number() = std::nan("");
      ASSERT_EQ(scene.check().reason, CheckReason::kNotFinite);
      number() = std::numeric_limits<double>::infinity();
      ASSERT_EQ(scene.check().reason, CheckReason::kNotFinite);
      scene.trajectory = good;
    }
  }
  for (std::size_t k = 0; k < kHorizon; ++k) {
    scene.trajectory.jerks[k].y() += 1e-4;
    ASSERT_EQ(scene.check().reason, CheckReason::kDiscontinuous) << k;
    scene.trajectory.jerks[k].y() = std::nan("");
    ASSERT_EQ(scene.check().reason, CheckReason::kNotFinite);
    scene.trajectory = good;
  }
  for (const double bad : {0.0, -0.3, std::nan(""), std::numeric_limits<double>::infinity()}) {
    scene.trajectory.dt = bad;
    ASSERT_EQ(scene.check().reason, CheckReason::kNotFinite);
    scene.trajectory = good;
  }
  scene.trajectory.epoch = std::nan("");
  ASSERT_EQ(scene.check().reason, CheckReason::kNotFinite);
  scene.trajectory = good;
  scene.start.v.x() += 1e-5;
  ASSERT_EQ(scene.check().reason, CheckReason::kDiscontinuous);
  scene.start.v.x() = std::nan("");
  ASSERT_EQ(scene.check().reason, CheckReason::kNotFinite);
}

TEST(PlanCheck, CatchesNumbersThatAreNotFiniteInTheSurroundings) {
  CheckScene scene;
  scene.plan(straightPlan(Vector3::Zero(), Vector3::UnitX(), 0.0, 0.3));
  CommittedMotion bad;
  bad.assignRest(0.0, Vector3(100.0, std::nan(""), 0.0));
  scene.addMotion(bad);
  EXPECT_EQ(scene.check().reason, CheckReason::kNotFinite);
  EXPECT_EQ(scene.check().body, 0);
  scene.surroundings.uavs.clear();
  EXPECT_TRUE(scene.check().accepted());
  scene.addObstacle(
      Superellipsoid(1, Vector3(50.0, 50.0, 0.0), Vector3::Ones(), Vector3::Constant(2.0), 0.0, Vector3::Zero()));
  EXPECT_TRUE(scene.check().accepted());
  scene.surroundings.obstacles[0].stamp = std::nan("");
  EXPECT_EQ(scene.check().reason, CheckReason::kNotFinite);
}

TEST(PlanCheck, EachBoundBreaksWhenExceededALittle) {
  const auto reason = [](const Vector3& v, const Vector3& a, const Vector3& jerk, const FlightBounds& bounds) {
    CheckScene scene;
    std::array<Vector3, kHorizon> jerks = noJerks();
    jerks[0] = jerk;
    jerks[1] = -a / 0.1 - jerk;
    scene.limits.bounds = bounds;
    scene.plan(makePlan({Vector3::Zero(), v, a}, jerks, 0.0, 0.1));
    return scene.check().reason;
  };
  FlightBounds bounds = defaultCheckLimits().bounds;
  bounds.max_jerk = std::numeric_limits<double>::infinity();
  const Vector3 zero = Vector3::Zero();
  EXPECT_EQ(reason(Vector3(3.0, 4.0, 0.0), zero, zero, bounds), CheckReason::kAccepted);
  EXPECT_EQ(reason(Vector3(3.0, 4.00001, 0.0), zero, zero, bounds), CheckReason::kSpeed);
  // From rest upwards: 2 g of thrust is 1 g of acceleration at no speed.
  EXPECT_EQ(reason(zero, Vector3(0, 0, 9.7), Vector3(0, 0, -10), bounds), CheckReason::kAccepted);
  EXPECT_EQ(reason(zero, Vector3(0, 0, 9.82), Vector3(0, 0, -10), bounds), CheckReason::kThrust);
  EXPECT_EQ(reason(zero, Vector3(0, 0, -7.84), Vector3(0, 0, 10), bounds), CheckReason::kAccepted);
  EXPECT_EQ(reason(zero, Vector3(0, 0, -7.86), Vector3(0, 0, 10), bounds), CheckReason::kThrust);
  bounds.max_jerk = 10.0;
  EXPECT_EQ(reason(Vector3(1.0, 0.0, 0.0), zero, Vector3(6.0, 7.9, 0.0), bounds), CheckReason::kAccepted);
  EXPECT_EQ(reason(Vector3(1.0, 0.0, 0.0), zero, Vector3(6.0, 8.1, 0.0), bounds), CheckReason::kJerk);
  bounds.max_jerk = 30.0;
  bounds.max_acceleration = 3.0;
  EXPECT_EQ(reason(zero, Vector3(2.9999, 0, 0), zero, bounds), CheckReason::kAccepted);
  EXPECT_EQ(reason(zero, Vector3(2.9999, 0, 0), Vector3(0.01, 0, 0), bounds), CheckReason::kAcceleration);
  bounds.max_acceleration = 0.5;
  EXPECT_EQ(reason(Vector3(4.0, 0.0, 0.0), zero, zero, bounds), CheckReason::kNoStop);
}

TEST(PlanCheck, KeepsTheWorkspaceBetweenTheKnotsAndInTheStop) {
  const auto reason = [](double y_most, double x_most) {
    CheckScene scene;
    scene.limits.bounds.workspace.min = Vector3(-1.0, -1.0, -1.0);
    scene.limits.bounds.workspace.max = Vector3(x_most, y_most, 1.0);
    // y rises to 0.5 m after 1 s and falls again.
    std::array<Vector3, kHorizon> jerks = noJerks();
    scene.plan(makePlan({Vector3::Zero(), Vector3(1.0, 1.0, 0.0), Vector3(0.0, -1.0, 0.0)}, jerks, 0.0, 0.08));
    return scene.check();
  };
  EXPECT_TRUE(reason(0.501, 10.0).accepted());
  EXPECT_EQ(reason(0.4999, 10.0).reason, CheckReason::kWorkspace);
  EXPECT_NEAR(reason(0.4999, 10.0).time, 1.0, 0.08);
  EXPECT_TRUE(reason(0.501, 2.2).accepted());
  EXPECT_EQ(reason(0.501, 1.62).reason, CheckReason::kWorkspace);  // the plan ends at 1.6 m, its stop beyond
}

TEST(PlanCheck, KnowsTheLeastDistanceOfUavsHeadOn) {
  // They pass at exactly `abreast` metres, 6 m/s apart.
  const auto verdict = [](double abreast, double vertical, double epoch) {
    CheckScene scene;
    scene.limits.pair_vertical = 1.2;
    scene.plan(straightPlan(Vector3(-10.0, 0.0, 0.0), Vector3(3.0, 0.0, 0.0), 1e9, 0.3));
    scene.addUav(straightPlan(Vector3(10.0, abreast, vertical), Vector3(-3.0, 0.0, 0.0), 1e9 + epoch, 0.15));
    return scene.check();
  };
  EXPECT_TRUE(verdict(2.2 + 1e-5, 0.0, 0.0).accepted());
  EXPECT_TRUE(verdict(2.2 + 1e-5, 0.0, -0.7).accepted());
  EXPECT_FALSE(verdict(2.2 - 1e-5, 0.0, -0.7).accepted());
  const CheckVerdict refused = verdict(2.2 - 1e-5, 0.0, 0.0);
  EXPECT_EQ(refused.reason, CheckReason::kUav);
  EXPECT_NEAR(refused.time, 20.0 / 6.0, 0.15);
  EXPECT_FALSE(refused.undecided);
  EXPECT_TRUE(verdict(0.0, 1.2 + 1e-5, 0.0).accepted());
  EXPECT_FALSE(verdict(0.0, 1.2 - 1e-5, 0.0).accepted());
}

TEST(PlanCheck, KnowsTheLeastDistanceFromASphereAndAWall) {
  const auto passing = [](double y, const Vector3& radii, double exponent, double velocity) {
    CheckScene scene;
    scene.plan(straightPlan(Vector3(-10.0, 0.0, 0.0), Vector3(4.0, 0.0, 0.0), 1e9, 0.3));
    scene.addObstacle(
        Superellipsoid(1, Vector3(0.0, y, 0.0), radii, Vector3::Constant(exponent), 0.0, Vector3(velocity, 0.0, 0.0)));
    return scene.check();
  };
  for (const double velocity : {0.0, 1.0, -1.0}) {
    EXPECT_TRUE(passing(1.5 + 1e-5, Vector3::Ones(), 2.0, velocity).accepted());
    EXPECT_EQ(passing(1.5 - 1e-5, Vector3::Ones(), 2.0, velocity).reason, CheckReason::kObstacle);
    // Along a wall for 20 m.
    EXPECT_TRUE(passing(1.5 + 1e-5, Vector3(8.0, 1.0, 3.0), 10.0, velocity).accepted());
    EXPECT_EQ(passing(1.5 - 1e-5, Vector3(8.0, 1.0, 3.0), 10.0, velocity).reason, CheckReason::kObstacle);
  }
}

// Where growth ends within a piece, what is demanded lies above its chord.
TEST(PlanCheck, DemandsEnoughWhereGrowthEnds) {
  Random random(11);
  int refused = 0;
  int spared = 0;
  int accepted = 0;
  for (int n = 0; n < 400; ++n) {
    CheckScene scene;
    scene.limits.look_ahead = 1.0;
    scene.planRandomly(random, 4.0);
    scene.addRandomObstacle(random, random.uniform(0.8, 1.5));
    PredictedObstacle& obstacle = scene.surroundings.obstacles[0];
    obstacle.growth_rate = random.uniform(0.1, 0.5);
    // It ends near where the clearance is least.
    obstacle.growth_time =
        std::max(sampledSlack(scene).time + scene.motion.epoch() - obstacle.stamp + random.uniform(-0.1, 0.1), 0.0);
    const double least = obstacle.least_distance + sampledSlack(scene).slack;
    if (least < 0.05) continue;
    obstacle.least_distance = least + 1e-4;
    const SampledSlack short_of = sampledSlack(scene);
    if (short_of.waived || short_of.slack > -5e-5) continue;
    ASSERT_FALSE(scene.check().accepted()) << n;
    ++refused;
    if (least < 0.2) continue;
    obstacle.least_distance = least - obstacle.growth_rate * scene.trajectory.dt - 1e-3;
    const CheckVerdict verdict = scene.check();
    if (verdict.reason != CheckReason::kAccepted && verdict.reason < CheckReason::kObstacle) continue;
    ++spared;
    accepted += verdict.accepted() ? 1 : 0;
  }
  std::printf("  refused %d; with a piece's growth to spare accepted %d of %d\n", refused, accepted, spared);
  EXPECT_GT(refused, 50);
  EXPECT_GT(spared, 30);
  EXPECT_EQ(accepted, spared);
}

TEST(PlanCheck, LooksAheadAtTheRestingPlace) {
  CheckScene scene;
  scene.plan(straightPlan(Vector3::Zero(), Vector3::UnitX(), 0.0, 0.3));
  ASSERT_TRUE(scene.check().accepted());
  const double rests = scene.motion.duration();
  const Vector3 place = scene.motion.restingPlace();
  // It arrives 15 s after the UAV has come to rest.
  const Vector3 velocity(0.0, -2.0, 0.0);
  const double away = 1.0 + 0.5 + 2.0 * (rests + 15.0);
  scene.addObstacle(
      Superellipsoid(1, place + Vector3(0.0, away, 0.0), Vector3::Ones(), Vector3::Constant(2.0), 0.0, velocity));
  const CheckVerdict verdict = scene.check();
  EXPECT_EQ(verdict.reason, CheckReason::kRestingPlace);
  EXPECT_GE(verdict.time, rests + 14.9);
  EXPECT_LE(verdict.time, rests + 20.0);
  scene.limits.look_ahead = 14.9;
  EXPECT_TRUE(scene.check().accepted());
  scene.limits.look_ahead = 15.1;
  EXPECT_FALSE(scene.check().accepted());
  scene.surroundings.obstacles[0].valid_until = rests + 10.0;
  EXPECT_TRUE(scene.check().accepted());
}

TEST(PlanCheck, SeesAUavThatComesToTheRestingPlace) {
  CheckScene scene;
  scene.plan(makePlan({Vector3::Zero(), Vector3::Zero(), Vector3::Zero()}, noJerks(), 0.0, 0.15));
  scene.addUav(straightPlan(Vector3(12.0, 1.0, 0.0), Vector3(-2.0, 0.0, 0.0), 0.0, 0.3));
  const CheckVerdict verdict = scene.check();
  EXPECT_EQ(verdict.reason, CheckReason::kUav);
  EXPECT_GT(verdict.time, scene.motion.duration());
}

}  // namespace
}  // namespace swarm_planner
