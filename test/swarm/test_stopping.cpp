// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The stop is what a UAV does when no plan passes any more. If these fail it tumbles, overspeeds, or never comes to
// rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random.hpp"
#include "swarm_planner/model/flat_inputs.hpp"
#include "swarm_planner/swarm/flight_envelope.hpp"
#include "swarm_planner/swarm/stopping.hpp"

namespace swarm_planner {
namespace {

FlightBounds defaultBounds() { return FlightBounds(Parameters(), nullptr); }

KinematicState randomState(Random& random, double speed, double acceleration) {
  return {random.vector(-50.0, 50.0), random.uniform(0.0, speed) * random.direction(),
          random.uniform(0.0, acceleration) * random.direction()};
}

/// Largest ratio to a bound among samples 1 ms apart, by the vehicle's own model.
double sampledRatio(const FlightBounds& bounds, const KinematicState& begin, const Vector3& jerk, double dt) {
  const VehicleParameters vehicle;
  double ratio = jerk.norm() / bounds.max_jerk;
  for (int i = 0; i * 1e-3 <= dt; ++i) {
    const KinematicState x = propagate(begin, jerk, i * 1e-3);
    const Vector3 a = thrustAcceleration(x.v, x.a, vehicle);
    ratio = std::max({ratio, x.v.norm() / bounds.max_speed, x.a.norm() / bounds.max_acceleration,
                      thrust(x.v, x.a, vehicle) / vehicle.mass / bounds.max_thrust_acceleration,
                      1.0 + (bounds.min_vertical_thrust - a.z()) / vehicle.gravity});
  }
  return ratio;
}

TEST(RollOutStop, ComesToRest) {
  Random random(1);
  for (int n = 0; n < 2000; ++n) {
    const KinematicState x = randomState(random, 8.0, 12.0);
    const double dt = random.uniform(0.05, 0.5);
    StopManoeuvre stop;
    const int stages = random.integer(2, kMaxStopStages);
    rollOutStop(x, stages, dt, stop);
    ASSERT_EQ(stop.stages, stages);
    KinematicState y = x;
    for (int k = 0; k < stages; ++k) y = propagate(y, stop.jerks[static_cast<std::size_t>(k)], dt);
    ASSERT_LT((y.p - stop.restingPlace()).norm(), 1e-10);
    ASSERT_LT(y.v.norm(), 1e-10);
    ASSERT_LT(y.a.norm(), 1e-10);
    ASSERT_EQ(stop.knots[static_cast<std::size_t>(stages)].v, Vector3(Vector3::Zero()));
  }
}

TEST(RollOutStop, HasTheLeastJerk) {
  // Jerks that change nothing at the end have no component along the optimum.
  Random random(2);
  for (int n = 0; n < 500; ++n) {
    const KinematicState x = randomState(random, 8.0, 12.0);
    const double dt = random.uniform(0.05, 0.5);
    StopManoeuvre stop;
    const int stages = random.integer(3, kMaxStopStages);
    rollOutStop(x, stages, dt, stop);
    // Second differences move neither the sum nor the first moment.
    for (int k = 0; k + 2 < stages; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const Vector3 second = stop.jerks[i] - 2.0 * stop.jerks[i + 1] + stop.jerks[i + 2];
      ASSERT_LT(second.norm(), 1e-9 * (1.0 + stop.jerks[i].norm()));
    }
  }
}

TEST(RollOutStop, OfASpeedAloneTakesHalfTheTimeTimesTheSpeed) {
  StopManoeuvre stop;
  rollOutStop({Vector3::Zero(), Vector3(4.0, 0.0, 0.0), Vector3::Zero()}, 10, 0.3, stop);
  EXPECT_NEAR(stop.restingPlace().x(), 4.0 * 3.0 / 2.0, 1e-12);
  EXPECT_DOUBLE_EQ(stop.duration(), 3.0);
}

TEST(PlanStop, KeepsTheBoundsBetweenTheKnotsAndNoShorterOneDoes) {
  Random random(3);
  int feasible = 0;
  for (int n = 0; n < 2000; ++n) {
    FlightBounds bounds = defaultBounds();
    if (n % 3 == 0) bounds.max_acceleration = random.uniform(3.0, 10.0);
    const KinematicState x = randomState(random, 5.0, std::min(bounds.max_acceleration, 5.0));
    const double dt = random.uniform(0.1, 0.3);
    StopManoeuvre stop;
    planStop(x, dt, bounds, stop);
    if (!stop.within_bounds) continue;
    ++feasible;
    for (std::size_t k = 0; k < static_cast<std::size_t>(stop.stages); ++k) {
      ASSERT_LE(sampledRatio(bounds, stop.knots[k], stop.jerks[k], dt), 1.0 + 1e-8);
    }
    if (stop.stages == 2) continue;
    StopManoeuvre shorter;
    rollOutStop(x, stop.stages - 1, dt, shorter);
    double ratio = 0.0;
    for (std::size_t k = 0; k < static_cast<std::size_t>(shorter.stages); ++k) {
      ratio = std::max(ratio, envelopeRatio(bounds, shorter.knots[k], shorter.jerks[k], dt));
    }
    ASSERT_GT(ratio, 1.0);
  }
  EXPECT_GT(feasible, 1500);
}

TEST(PlanStop, TakesTheGentlestWhereNoneKeepsTheBounds) {
  FlightBounds bounds = defaultBounds();
  bounds.max_acceleration = 0.5;  // 5 m/s take 15 s with a peak of 0.5 m/s^2, 6 s are allowed
  StopManoeuvre stop;
  planStop({Vector3::Zero(), Vector3(5.0, 0.0, 0.0), Vector3::Zero()}, 0.3, bounds, stop);
  EXPECT_FALSE(stop.within_bounds);
  EXPECT_EQ(stop.stages, kMaxStopStages);
  EXPECT_LT(stop.knots[static_cast<std::size_t>(stop.stages)].v.norm(), 1e-12);
  planStop({Vector3::Zero(), Vector3(1.0, 0.0, 0.0), Vector3::Zero()}, 0.3, bounds, stop);
  EXPECT_TRUE(stop.within_bounds);
}

TEST(RollOutStopAt, ComesToRestThereWithTheLeastJerk) {
  Random random(5);
  for (int n = 0; n < 2000; ++n) {
    const KinematicState x = randomState(random, 8.0, 12.0);
    const Vector3 place = x.p + random.vector(-20.0, 20.0);
    const double dt = random.uniform(0.05, 0.5);
    const int stages = random.integer(3, kMaxStopStages);
    StopManoeuvre stop;
    rollOutStopAt(x, place, stages, dt, stop);
    double size = 1.0;
    KinematicState y = x;
    for (int k = 0; k < stages; ++k) {
      const Vector3& jerk = stop.jerks[static_cast<std::size_t>(k)];
      y = propagate(y, jerk, dt);
      size = std::max(size, jerk.norm());
    }
    ASSERT_LT((y.p - place).norm(), 1e-11 * size);
    ASSERT_LT(y.v.norm(), 1e-11 * size);
    ASSERT_LT(y.a.norm(), 1e-11 * size);
    // Third differences change neither the sum nor the first two moments: the least jerks have none.
    for (std::size_t k = 0; k + 3 < static_cast<std::size_t>(stages); ++k) {
      const Vector3 third = stop.jerks[k + 3] - stop.jerks[k] - 3.0 * (stop.jerks[k + 2] - stop.jerks[k + 1]);
      ASSERT_LT(third.norm(), 1e-9 * size);
    }
  }
}

TEST(PlanStopAt, KeepsTheBoundsOrSaysThatItIsTooFar) {
  const FlightBounds bounds = defaultBounds();
  const KinematicState x{Vector3(1.0, 2.0, 3.0), Vector3(2.0, 0.0, 0.0), Vector3::Zero()};
  for (const double away : {3.0, 8.0, 12.0}) {
    StopManoeuvre stop;
    planStopAt(x, x.p + Vector3(0.0, away, 0.0), 0.3, bounds, stop);
    ASSERT_TRUE(stop.within_bounds) << away;
    for (std::size_t k = 0; k < static_cast<std::size_t>(stop.stages); ++k) {
      ASSERT_LE(sampledRatio(bounds, stop.knots[k], stop.jerks[k], 0.3), 1.0 + 1e-8);
    }
  }
  StopManoeuvre stop;
  planStopAt(x, x.p + Vector3(0.0, 40.0, 0.0), 0.3, bounds, stop);
  EXPECT_FALSE(stop.within_bounds) << "40 m in 6 s";
}

TEST(PlanStop, FlagsAStartThatIsTooFast) {
  StopManoeuvre stop;
  planStop({Vector3::Zero(), Vector3(5.01, 0.0, 0.0), Vector3::Zero()}, 0.3, defaultBounds(), stop);
  EXPECT_FALSE(stop.within_bounds);
  planStop({Vector3::Zero(), Vector3(5.0, 0.0, 0.0), Vector3::Zero()}, 0.3, defaultBounds(), stop);
  EXPECT_TRUE(stop.within_bounds);
}

TEST(PlanStop, OfWhatIsNotFiniteIsNotWithinBounds) {
  StopManoeuvre stop;
  planStop({Vector3::Zero(), Vector3(std::nan(""), 0.0, 0.0), Vector3::Zero()}, 0.3, defaultBounds(), stop);
  EXPECT_FALSE(stop.within_bounds);
}

TEST(FlightEnvelope, AgreesWithDenseSampling) {
  Random random(4);
  int within = 0;
  int beyond = 0;
  for (int n = 0; n < 5000; ++n) {
    FlightBounds bounds = defaultBounds();
    if (n % 2 == 0) bounds.max_acceleration = 12.0;
    const KinematicState x = randomState(random, 5.2, 13.0);
    const Vector3 jerk = random.uniform(0.0, 60.0) * random.direction();
    const double dt = 0.001 * random.integer(50, 300);
    const double sampled = sampledRatio(bounds, x, jerk, dt);
    const bool kept = findBreach(bounds, x, jerk, dt).bound == FlightBound::kNone;
    if (sampled > 1.0 + 1e-8) {
      ASSERT_FALSE(kept);
      ++beyond;
    }
    if (sampled < 1.0 - 1e-3) {
      ASSERT_TRUE(kept);
      ++within;
    }
  }
  EXPECT_GT(within, 500);
  EXPECT_GT(beyond, 500);
}

TEST(FlightEnvelope, SeesWhatHappensBetweenTheKnots) {
  const FlightBounds bounds = defaultBounds();
  // 4.99 m/s at both ends, more between: a = 2 falls to -2.
  const KinematicState x{Vector3::Zero(), Vector3(4.99, 0.0, 0.0), Vector3(2.0, 0.0, 0.0)};
  const EnvelopeBreach breach = findBreach(bounds, x, Vector3(-4.0 / 0.3, 0.0, 0.0), 0.3);
  EXPECT_EQ(breach.bound, FlightBound::kSpeed);
  EXPECT_NEAR(breach.time, 0.15, 0.15);
}

TEST(FlightEnvelope, IsBreachedByWhatIsNotFinite) {
  const FlightBounds bounds = defaultBounds();
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
    for (int i = 0; i < 9; ++i) {
      KinematicState x{Vector3::Zero(), Vector3(1.0, 0.0, 0.0), Vector3::Zero()};
      Vector3 jerk = Vector3::Zero();
      EXPECT_EQ(findBreach(bounds, x, jerk, 0.3).bound, FlightBound::kNone);
      (i < 3 ? x.v : i < 6 ? x.a : jerk)[i % 3] = bad;
      EXPECT_NE(findBreach(bounds, x, jerk, 0.3).bound, FlightBound::kNone) << i;
    }
  }
}

TEST(FlightEnvelope, NamesTheBound) {
  FlightBounds bounds = defaultBounds();
  const auto bound = [&](const Vector3& v, const Vector3& a) {
    return findBreach(bounds, {Vector3::Zero(), v, a}, -a, 0.1).bound;
  };
  EXPECT_EQ(bound(Vector3(3.0, 0.0, 0.0), Vector3::Zero()), FlightBound::kNone);
  EXPECT_EQ(bound(Vector3(3.0, 4.001, 0.0), Vector3::Zero()), FlightBound::kSpeed);
  EXPECT_EQ(bound(Vector3::Zero(), Vector3(0.0, 0.0, 9.82)), FlightBound::kThrust);   // more than 2 g
  EXPECT_EQ(bound(Vector3::Zero(), Vector3(0.0, 0.0, -7.86)), FlightBound::kThrust);  // less than 0.2 g upwards
  EXPECT_EQ(bound(Vector3::Zero(), Vector3(0.0, 0.0, -7.84)), FlightBound::kNone);
  bounds.max_acceleration = 2.0;
  EXPECT_EQ(bound(Vector3::Zero(), Vector3(0.0, 2.001, 0.0)), FlightBound::kAcceleration);
}

TEST(FlightEnvelope, IsRelievedToWhatTheStartHasAndNoFurther) {
  const FlightBounds bounds = defaultBounds();
  const auto speed = [&](double start) {
    return relieveBounds(bounds, {Vector3::Zero(), Vector3(start, 0.0, 0.0), Vector3::Zero()}, 0.1).max_speed;
  };
  EXPECT_DOUBLE_EQ(speed(4.0), 5.0);
  EXPECT_DOUBLE_EQ(speed(5.2), 5.2);
  EXPECT_DOUBLE_EQ(speed(7.0), 5.5);
  const FlightBounds falling = relieveBounds(bounds, {Vector3::Zero(), Vector3::Zero(), Vector3(0, 0, -7.9)}, 0.1);
  EXPECT_NEAR(falling.min_vertical_thrust, -7.9, 1e-12);
}

}  // namespace
}  // namespace swarm_planner
