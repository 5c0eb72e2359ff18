// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Whatever the planner believes to be clear of an obstacle or another UAV it believes because of these half-spaces:
// where one of them cuts into a body, a UAV flies into it.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "obstacles/random_bodies.hpp"
#include "support/flight_problem.hpp"
#include "support/random.hpp"
#include "support/resting_prediction.hpp"
#include "swarm_planner/obstacles/pair_ellipsoid.hpp"
#include "swarm_planner/problem/moving_body.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;
constexpr double kLevel = 1.02;

/// Real exponents of the paper's range [2, 10], any yaw and velocity.
Superellipsoid paperBody(Random& random) {
  const Vector3 radii(random.logUniform(0.3, 20.0), random.logUniform(0.3, 20.0), random.logUniform(0.3, 20.0));
  const Vector3 center = random.vector(-10.0, 10.0);
  const Vector3 exponents = random.integer(0, 1) == 0 ? random.vector(2.0, 10.0) : randomExponents(random);
  return Superellipsoid(1, center, radii, exponents, random.uniform(-M_PI, M_PI), random.vector(-3.0, 3.0));
}

/// A position relative to a body of some size: inside, outside, or in a plane or on an axis of the frame.
Vector3 randomRelative(Random& random, double size) {
  Vector3 r = random.logUniform(1e-3, 10.0) * size * random.direction();
  const int kept = random.integer(0, 2);
  for (int axis = 0; axis < 3; ++axis) {
    if (axis != kept && random.integer(0, 3) == 0) r[axis] = 0.0;
  }
  return r;
}

/// A direction across `n`.
Vector3 randomTangent(Random& random, const Vector3& n) {
  for (;;) {
    const Vector3 d = random.direction();
    const Vector3 tangent = d - d.dot(n) / n.squaredNorm() * n;
    if (tangent.norm() > 0.1) return tangent.normalized();
  }
}

/// What keeps `body` clear at time `t` after the horizon's start, as a body whose distance can be asked for.
double distanceTo(const Superellipsoid& obstacle, double t, const Vector3& position) {
  return obstacle.movedBy(t).signedDistance(position);
}

/// The pair ellipsoid about the origin as a body whose distance can be asked for.
Superellipsoid pairBody(double horizontal, double vertical) {
  return Superellipsoid(0, Vector3::Zero(), Vector3(horizontal, horizontal, vertical), Vector3::Constant(2.0), 0.0,
                        Vector3::Zero());
}

TEST(SupportingHalfSpace, HasTheWholeObstacleBehindIt) {
  Random random(1);
  for (int trial = 0; trial < 2000; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const double distance = random.logUniform(0.01, 3.0);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, distance);
    const HalfSpace half_space = body.supportingHalfSpace(randomRelative(random, obstacle.boundingRadius()));
    ASSERT_NEAR(half_space.n.norm(), 1.0, 1e-12);
    for (int i = 0; i < 50; ++i) {
      Vector3 u = obstacle.boundingRadius() * random.direction();
      u /= obstacle.gauge(u, kLevel).value;
      EXPECT_LE(half_space.n.dot(u), half_space.offset - distance + 1e-9 * obstacle.boundingRadius());
    }
  }
}

TEST(SupportingHalfSpace, KeepsTheDistanceToAnObstacle) {
  Random random(2);
  double least_excess = std::numeric_limits<double>::infinity();
  for (int trial = 0; trial < 1000; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const double distance = random.logUniform(0.01, 3.0);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, distance);
    const Vector3 r = randomRelative(random, obstacle.boundingRadius());
    const HalfSpace half_space = body.supportingHalfSpace(r);
    // The plane touches the grown body where the ray to r leaves it: about there the distance is least.
    const Vector3 touch = r / obstacle.gauge(r).value + distance * half_space.n;
    for (int i = 0; i < 20; ++i) {
      const double away = random.logUniform(1e-4, 3.0) * obstacle.boundingRadius();
      const Vector3 q = touch + away * randomTangent(random, half_space.n);
      ASSERT_NEAR(half_space.clearance(q), 0.0, 1e-8 * (1.0 + q.norm()));
      const double excess = obstacle.signedDistance(obstacle.center() + q) - distance;
      EXPECT_GE(excess, -1e-8 * (1.0 + q.norm()));
      least_excess = std::min(least_excess, excess);
    }
  }
  EXPECT_LT(least_excess, 1e-6) << "the half-spaces do not touch the bodies: they keep UAVs away for nothing";
}

TEST(SupportingHalfSpace, HoldsForAPositionAtTheObstaclesCentre) {
  Random random(3);
  for (int trial = 0; trial < 200; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5);
    const HalfSpace half_space = body.supportingHalfSpace(Vector3::Zero());
    ASSERT_TRUE(half_space.n.allFinite());
    EXPECT_NEAR(half_space.n.norm(), 1.0, 1e-12);
    EXPECT_LT(half_space.clearance(Vector3::Zero()), 0.0);
    EXPECT_GE(half_space.offset, obstacle.radii().minCoeff() + 0.5 - 1e-9);
  }
}

TEST(SupportingHalfSpace, KeepsClearOfThePairEllipsoid) {
  Random random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    const double horizontal = random.logUniform(0.2, 5.0);
    const double vertical = horizontal * random.logUniform(0.2, 5.0);
    PredictedMotion motion;
    predictResting(Vector3::Zero(), motion);
    const MovingBody body = MovingBody::fromUav(motion, horizontal, vertical, Vector3::UnitX());
    const Vector3 r = randomRelative(random, horizontal);
    const HalfSpace half_space = body.supportingHalfSpace(r);
    const Vector3 touch = r / pairGauge(r, horizontal, vertical);
    EXPECT_NEAR(half_space.clearance(touch), 0.0, 1e-9) << "the half-space does not touch the ellipsoid";
    for (int i = 0; i < 20; ++i) {
      const Vector3 q = touch + random.logUniform(1e-3, 10.0) * randomTangent(random, half_space.n);
      EXPECT_GE(pairGauge(q, horizontal, vertical), 1.0 - 1e-12);
    }
  }
}

// The plan's violation, its penalty and what is waived are in metres: they mean nothing if this is not a distance.
TEST(SupportingHalfSpace, ClearanceIsALowerBoundOfTheDistance) {
  Random random(5);
  for (int trial = 0; trial < 2000; ++trial) {
    const double horizontal = random.logUniform(0.2, 5.0);
    const double vertical = horizontal * random.logUniform(0.2, 5.0);
    PredictedMotion motion;
    predictResting(Vector3::Zero(), motion);
    const MovingBody uav = MovingBody::fromUav(motion, horizontal, vertical, Vector3::UnitX());
    const HalfSpace of_uav = uav.supportingHalfSpace(randomRelative(random, horizontal));
    const Vector3 r = random.logUniform(0.5, 5.0) * std::max(horizontal, vertical) * random.direction();
    if (of_uav.clearance(r) > 0.0) {
      EXPECT_LE(of_uav.clearance(r), pairBody(horizontal, vertical).signedDistance(r) + 1e-9)
          << horizontal << " by " << vertical << " m at " << r.transpose();
    }
    const Superellipsoid obstacle = paperBody(random);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5);
    const HalfSpace of_obstacle = body.supportingHalfSpace(randomRelative(random, obstacle.boundingRadius()));
    const Vector3 q = random.logUniform(0.1, 5.0) * obstacle.boundingRadius() * random.direction();
    if (of_obstacle.clearance(q) > 0.0) {
      EXPECT_LE(of_obstacle.clearance(q) + 0.5, obstacle.signedDistance(obstacle.center() + q) * (1.0 + 1e-8));
    }
  }
}

TEST(SegmentClearance, IsALowerBoundOfTheDistanceToAMovingObstacleAllAlong) {
  Random random(6);
  int clear = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const double distance = random.logUniform(0.05, 1.0);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, distance);
    const int k = random.integer(0, kHorizon - 1);
    const Vector3 near = obstacle.center() + k * kDt * obstacle.velocity();
    const KinematicState begin{near + random.logUniform(0.5, 2.0) * obstacle.boundingRadius() * random.direction(),
                               random.vector(-5.0, 5.0), random.vector(-5.0, 5.0)};
    const Vector3 jerk = random.vector(-20.0, 20.0);
    const SegmentPoints points = segmentPoints(begin, propagate(begin, jerk, kDt), kDt);
    const SegmentClearance segment = segmentClearance(body, k, relativePoints(body, k, points));
    if (segment.clearance < 0.0) continue;
    ++clear;
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      const double true_distance = distanceTo(obstacle, (k + s) * kDt, propagate(begin, jerk, s * kDt).p);
      EXPECT_GE(true_distance, segment.clearance + distance - 1e-8 * (1.0 + true_distance));
    }
  }
  EXPECT_GT(clear, 300);
}

TEST(SegmentClearance, IsALowerBoundOfTheDistanceToAnotherUavAllAlong) {
  Random random(7);
  int clear = 0;
  for (int trial = 0; trial < 1000; ++trial) {
    const double horizontal = random.uniform(0.5, 3.0);
    const double vertical = random.uniform(0.5, 3.0);
    const KinematicState start{random.vector(-5.0, 5.0), random.vector(-5.0, 5.0), Vector3::Zero()};
    const Trajectory other = wanderingPlan(random, start, 5.0, 0.0, kDt);
    PredictedMotion motion;
    predict(other, 0.0, kDt, motion);
    const MovingBody body = MovingBody::fromUav(motion, horizontal, vertical, Vector3::UnitX());
    const int k = random.integer(0, kHorizon - 1);
    const KinematicState begin{other.after(k * kDt).p + random.uniform(0.5, 5.0) * random.direction(),
                               random.vector(-5.0, 5.0), random.vector(-5.0, 5.0)};
    const Vector3 jerk = random.vector(-20.0, 20.0);
    const SegmentPoints points = segmentPoints(begin, propagate(begin, jerk, kDt), kDt);
    const SegmentClearance segment = segmentClearance(body, k, relativePoints(body, k, points));
    if (segment.clearance < 0.0) continue;
    ++clear;
    const Superellipsoid ellipsoid = pairBody(horizontal, vertical);
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      const Vector3 r = propagate(begin, jerk, s * kDt).p - other.after((k + s) * kDt).p;
      EXPECT_GE(pairGauge(r, horizontal, vertical), 1.0 - 1e-9);
      EXPECT_GE(ellipsoid.signedDistance(r), segment.clearance - 1e-8);
    }
  }
  EXPECT_GT(clear, 300);
}

TEST(SegmentClearance, IsNegativeForASegmentThroughTheBody) {
  Random random(8);
  for (int trial = 0; trial < 300; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5);
    const Vector3 v = random.uniform(1.0, 5.0) * random.direction();
    const Vector3 inside = obstacle.center() + 0.9 * randomOffset(random, obstacle, random.uniform(0.0, 1.0));
    const Trajectory plan = straightPlan(inside - 0.5 * kDt * v, v + obstacle.velocity(), 0.0, kDt);
    const SegmentPoints points = segmentPoints(plan.knots[0], plan.knots[1], kDt);
    EXPECT_LT(segmentClearance(body, 0, relativePoints(body, 0, points)).clearance, 0.0);
  }
}

TEST(MovingBody, MovesAsTheObstacleDoes) {
  Random random(9);
  const Superellipsoid obstacle = paperBody(random);
  const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5);
  for (int k = 0; k < kHorizon; ++k) {
    for (int i = 0; i < 4; ++i) {
      EXPECT_LT((body.point(k, i) - obstacle.movedBy((k + i / 3.0) * kDt).center()).norm(), 1e-12);
    }
  }
  EXPECT_FALSE(body.isUav());
  EXPECT_EQ(body.obstacle(), &obstacle);
}

// Bodies and segments outside are skipped unseen.
TEST(MovingBody, BoxAndRadiusContainWhatIsToBeKeptClearOf) {
  Random random(10);
  for (int trial = 0; trial < 500; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const double distance = random.logUniform(0.01, 3.0);
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, distance);
    const double tolerance = 1e-9 * (1.0 + body.radius());
    for (int i = 0; i < 50; ++i) {
      Vector3 u = randomOffset(random, obstacle, 1.0);
      u /= obstacle.gauge(u, kLevel).value;
      u += distance * random.direction();
      EXPECT_LE(u.norm(), body.radius() + tolerance);
      const Vector3 position = obstacle.center() + random.uniform(0.0, kHorizon * kDt) * obstacle.velocity() + u;
      EXPECT_TRUE((position.array() >= body.box().min.array() - tolerance).all());
      EXPECT_TRUE((position.array() <= body.box().max.array() + tolerance).all());
    }
  }
}

TEST(Growth, MovesTheHalfSpaceOfEachSegmentOutUntilItEnds) {
  Random random(15);
  for (int trial = 0; trial < 300; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const DistanceGrowth growth{random.uniform(0.0, 0.3), random.uniform(0.0, 2.0)};
    MovingBody steady = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5);
    MovingBody growing = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5, growth);
    const Vector3 r = randomOffset(random, obstacle, random.uniform(0.5, 1.2));
    steady.relieve(r, 0.1);
    growing.relieve(r, 0.1);
    for (int k = 0; k < kHorizon; ++k) {
      const double expected = std::min((k + 1) * growth.per_stage, growth.limit);
      const SegmentPoints resting{r, r, r, r};
      const SegmentClearance before = segmentClearance(steady, k, resting);
      const SegmentClearance after = segmentClearance(growing, k, resting);
      EXPECT_EQ(after.half_space.n, before.half_space.n);
      EXPECT_NEAR(after.half_space.offset - before.half_space.offset, expected,
                  1e-12 * (1.0 + after.half_space.offset));
      EXPECT_NEAR(before.clearance - after.clearance, expected, 1e-12 * (1.0 + after.half_space.offset));
      const HalfSpace grown = growing.grownTo(k).supportingHalfSpace(r);
      EXPECT_NEAR(grown.offset - steady.supportingHalfSpace(r).offset, expected, 1e-12 * (1.0 + grown.offset));
      EXPECT_NEAR(growing.grownTo(k).distance(), 0.5 + expected, 1e-12);
      EXPECT_EQ(growing.grownTo(k).growth(kHorizon - 1), 0.0);
    }
  }
}

// At every stage no less than the pair ellipsoid with that much longer semi-axes.
TEST(Growth, OfAUavKeepsClearOfTheGrownEllipsoid) {
  Random random(17);
  for (int trial = 0; trial < 500; ++trial) {
    const double horizontal = random.logUniform(0.3, 4.0);
    const double vertical = random.logUniform(0.3, 4.0);
    PredictedMotion motion;
    predictResting(Vector3::Zero(), motion);
    const DistanceGrowth growth{random.uniform(0.0, 0.3), random.uniform(0.0, 2.0)};
    const MovingBody body = MovingBody::fromUav(motion, horizontal, vertical, Vector3::UnitX(), growth);
    const int k = random.integer(0, kHorizon - 1);
    const double grown = body.growth(k);
    const Vector3 r = randomRelative(random, horizontal + grown);
    if (segmentClearance(body, k, {r, r, r, r}).clearance >= 0.0) {
      ASSERT_GE(pairGauge(r, horizontal + grown, vertical + grown), 1.0 - 1e-9) << trial;
    } else {
      const double longer = 1.0 + grown / std::min(horizontal, vertical);
      ASSERT_LE(pairGauge(r, longer * horizontal, longer * vertical), 1.0 + 1e-9) << trial;
    }
  }
}

TEST(Growth, LiesWithinBoxAndRadius) {
  Random random(16);
  for (int trial = 0; trial < 300; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    const DistanceGrowth growth{random.uniform(0.0, 0.3), random.uniform(0.0, 6.0)};
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, 0.5, growth);
    const double tolerance = 1e-9 * (1.0 + body.radius());
    for (int k = 0; k < kHorizon; ++k) {
      Vector3 u = randomOffset(random, obstacle, 1.0);
      u /= obstacle.gauge(u, kLevel).value;
      u += (0.5 + body.growth(k)) * random.direction();
      EXPECT_FALSE(isBeyond(body, SegmentPoints{u, u, u, u}, -tolerance));
      const Vector3 position = obstacle.movedBy((k + random.uniform(0.0, 1.0)) * kDt).center() + u;
      EXPECT_TRUE((position.array() >= body.box().min.array() - tolerance).all());
      EXPECT_TRUE((position.array() <= body.box().max.array() + tolerance).all());
    }
  }
}

TEST(MovingBody, BoxAndRadiusContainThePairEllipsoidAlongThePlan) {
  Random random(11);
  for (int trial = 0; trial < 100; ++trial) {
    const Trajectory plan =
        wanderingPlan(random, {random.vector(-5.0, 5.0), random.vector(-5.0, 5.0), Vector3::Zero()}, 5.0, 0.0, kDt);
    PredictedMotion motion;
    predict(plan, 0.0, kDt, motion);
    const double vertical = random.uniform(0.5, 4.0);
    const MovingBody body = MovingBody::fromUav(motion, 2.0, vertical, Vector3::UnitX());
    EXPECT_TRUE(body.isUav());
    for (int i = 0; i < 50; ++i) {
      const Vector3 u = random.direction().cwiseProduct(Vector3(2.0, 2.0, vertical));
      EXPECT_LE(u.norm(), body.radius() + 1e-12);
      const Vector3 position = plan.after(random.uniform(0.0, kHorizon * kDt)).p + u;
      EXPECT_TRUE((position.array() >= body.box().min.array() - 1e-9).all());
      EXPECT_TRUE((position.array() <= body.box().max.array() + 1e-9).all());
    }
  }
}

TEST(IsBeyond, IsNeverTrueOfASegmentThatComesAsClose) {
  Random random(12);
  int beyond = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    const KinematicState begin{random.vector(-4.0, 4.0), random.vector(-10.0, 10.0), random.vector(-20.0, 20.0)};
    const Vector3 jerk = random.vector(-50.0, 50.0);
    const SegmentPoints points = segmentPoints(begin, propagate(begin, jerk, kDt), kDt);
    const Superellipsoid obstacle(0, Vector3::Zero(), random.vector(0.2, 3.0), random.vector(2.0, 8.0),
                                  random.uniform(-3.0, 3.0), Vector3::Zero());
    const MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
    const double distance = random.uniform(0.1, 2.0);
    if (!isBeyond(body, points, distance)) continue;
    ++beyond;
    for (double s = 0.0; s <= 1.0; s += 0.05) {
      EXPECT_GT(obstacle.signedDistance(propagate(begin, jerk, s * kDt).p), distance + 0.5);
    }
  }
  EXPECT_GT(beyond, 500);
}

TEST(IsBeyond, KnowsASegmentOnEitherSide) {
  const SegmentPoints right{Vector3(3, -1, 0), Vector3(3, 0, 0), Vector3(4, 0, 1), Vector3(3, 1, 0)};
  SegmentPoints left = right;
  for (Vector3& point : left) point = -point;
  PredictedMotion resting;
  predictResting(Vector3::Zero(), resting);
  const MovingBody body = MovingBody::fromUav(resting, 2.0, 2.0, Vector3::UnitX());
  for (const SegmentPoints& points : {right, left}) {
    EXPECT_TRUE(isBeyond(body, points, 0.9));
    EXPECT_FALSE(isBeyond(body, points, 1.0));
  }
}

// A UAV that starts too close, as noise of its odometry easily makes it, must not be told that it cannot move.
TEST(Relief, WaivesTheMarginAtTheStartOnly) {
  const Superellipsoid obstacle(1, Vector3::Zero(), Vector3::Constant(5.0), Vector3::Constant(2.0), 0.0,
                                Vector3::Zero());
  constexpr double kMargin = 0.2;
  const auto reliefAt = [&](double gap, int k) {
    MovingBody body = MovingBody::fromObstacle(obstacle, kDt, 1.0, 0.5);
    body.relieve(Vector3(5.0 + gap, 0, 0), kMargin);
    return body.relief(k);
  };
  EXPECT_EQ(reliefAt(0.6, 0), 0.0) << "nothing to waive";
  EXPECT_NEAR(reliefAt(0.4, 0), 0.1, 1e-12) << "as much as is missing";
  EXPECT_EQ(reliefAt(0.1, 0), kMargin) << "never more than the margin";
  EXPECT_EQ(reliefAt(-4.9, 0), kMargin) << "not even inside";
  for (int k = 1; k < kHorizon; ++k) EXPECT_LE(reliefAt(0.1, k), reliefAt(0.1, k - 1));
  EXPECT_LT(reliefAt(0.1, 4), 0.5 * kMargin);
  for (int k = 5; k < kHorizon; ++k) EXPECT_EQ(reliefAt(0.1, k), 0.0) << "the distance is demanded again";
}

TEST(Relief, LeavesTheDistanceToAnObstacleWithoutTheMargin) {
  Random random(13);
  constexpr double kMargin = 0.2;
  constexpr double kRadius = 0.3;
  for (int trial = 0; trial < 500; ++trial) {
    const Superellipsoid obstacle = paperBody(random);
    MovingBody body = MovingBody::fromObstacle(obstacle, kDt, kLevel, kRadius + kMargin);
    const Vector3 r = randomOffset(random, obstacle, random.uniform(0.5, 1.2));
    body.relieve(r, kMargin);
    const SegmentPoints resting{r, r, r, r};
    const SegmentClearance segment = segmentClearance(body, 0, resting);
    if (segment.clearance < 0.0) continue;
    EXPECT_GE(obstacle.signedDistance(obstacle.center() + r), kRadius - 1e-9 * obstacle.boundingRadius());
  }
}

// The margin of a pair that keeps more (or less) distance above each other than beside each other.
TEST(Relief, LeavesThePairEllipsoidWithoutTheMargin) {
  Random random(14);
  int relieved = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    const double margin = random.uniform(0.02, 0.2);
    const double horizontal = random.uniform(0.3, 3.0);
    const double vertical = random.uniform(0.3, 3.0);
    PredictedMotion motion;
    predictResting(Vector3::Zero(), motion);
    MovingBody body = MovingBody::fromUav(motion, horizontal + margin, vertical + margin, Vector3::UnitX());
    Vector3 r = random.direction();
    r *= random.uniform(0.8, 1.0) / pairGauge(r, horizontal + margin, vertical + margin);
    body.relieve(r, margin);
    const SegmentPoints resting{r, r, r, r};
    if (segmentClearance(body, 0, resting).clearance < 0.0) continue;
    ++relieved;
    EXPECT_GE(pairGauge(r, horizontal, vertical), 1.0 - 1e-9)
        << horizontal << " by " << vertical << " m, margin " << margin << " m: counts as clear at " << r.transpose();
  }
  EXPECT_GT(relieved, 50);
}

TEST(MovingBody, CoincidentUavsPartInOppositeDirections) {
  PredictedMotion motion;
  predictResting(Vector3(3, 4, 5), motion);
  const HalfSpace first = MovingBody::fromUav(motion, 2.0, 1.0, Vector3::UnitX()).supportingHalfSpace(Vector3::Zero());
  const HalfSpace second =
      MovingBody::fromUav(motion, 2.0, 1.0, -Vector3::UnitX()).supportingHalfSpace(Vector3::Zero());
  EXPECT_EQ(first.n, -second.n);
  EXPECT_GT(first.n.x(), 0.0);
  for (const HalfSpace& half_space : {first, second}) {
    EXPECT_LT(half_space.clearance(Vector3::Zero()), 0.0);
    EXPECT_NEAR(half_space.clearance((half_space.n.x() > 0.0 ? 2.0 : -2.0) * Vector3::UnitX()), 0.0, 1e-12);
  }
}

}  // namespace
}  // namespace swarm_planner
