// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, vehicles cannot follow their plans: attitude, thrust, torques or rotor speeds would be those of
// another motion.
#include <gtest/gtest.h>

#include <cmath>

#include "support/central_difference.hpp"
#include "support/random.hpp"
#include "swarm_planner/model/dynamics.hpp"
#include "swarm_planner/model/flat_inputs.hpp"
#include "swarm_planner/model/kinematics.hpp"

namespace swarm_planner {
namespace {

const VehicleParameters kVehicle;

struct Motion {
  KinematicState x;
  Vector3 jerk;
};

/// A motion that the planner's limits allow: upright, at most 5 m/s.
Motion randomMotion(Random& random) {
  Motion motion;
  motion.x.v = random.uniform(0.0, 5.0) * random.direction();
  motion.x.a = Vector3(random.uniform(-8.0, 8.0), random.uniform(-8.0, 8.0), random.uniform(-5.0, 8.0));
  motion.jerk = random.vector(-10.0, 10.0);
  return motion;
}

TEST(FlatInputs, GiveBackThePlannedAcceleration) {
  Random random(1);
  for (int n = 0; n < 10000; ++n) {
    const Motion motion = randomMotion(random);
    const Attitude attitude = attitudeFor(motion.x.v, motion.x.a, kVehicle);
    QuadState state;
    state.v = motion.x.v;
    state.phi = attitude.phi;
    state.theta = attitude.theta;
    const QuadState rate = dynamics(state, Wrench{attitude.thrust, 0.0, 0.0}, Vector3::Zero(), kVehicle);
    EXPECT_LT((rate.v - motion.x.a).norm(), 1e-12);
  }
}

TEST(FlatInputs, GiveBackAnyAccelerationEvenUpsideDown) {
  Random random(2);
  for (int n = 0; n < 10000; ++n) {
    const Vector3 v = random.vector(-20.0, 20.0);
    const Vector3 a = random.vector(-50.0, 50.0);
    const Attitude attitude = attitudeFor(v, a, kVehicle);
    QuadState state;
    state.v = v;
    state.phi = attitude.phi;
    state.theta = attitude.theta;
    const QuadState rate = dynamics(state, Wrench{attitude.thrust, 0.0, 0.0}, Vector3::Zero(), kVehicle);
    EXPECT_LT((rate.v - a).norm(), 1e-11);
  }
}

TEST(FlatInputs, ThrustIsEquationFive) {
  const Vector3 v(1.0, -2.0, 0.5);
  const Vector3 a(0.3, 0.7, -1.1);
  const Vector3 A = thrustAcceleration(v, a, kVehicle);
  EXPECT_NEAR(A.x(), 0.3 + 0.25 / 0.468 * 1.0, 1e-12);
  EXPECT_NEAR(A.y(), 0.7 - 0.25 / 0.468 * 2.0, 1e-12);
  EXPECT_NEAR(A.z(), -1.1 + 0.25 / 0.468 * 0.5, 1e-12);
  EXPECT_NEAR(thrust(v, a, kVehicle),
              0.468 * std::sqrt(A.x() * A.x() + A.y() * A.y() + (A.z() + 9.81) * (A.z() + 9.81)), 1e-12);
  EXPECT_DOUBLE_EQ(attitudeFor(v, a, kVehicle).thrust, thrust(v, a, kVehicle));
}

TEST(FlatInputs, HoverTakesSixHundredTwentyRadiansPerSecond) {
  const FlatInputs inputs = flatInputs(Vector3::Zero(), Vector3::Zero(), Vector3::Zero(), kVehicle);
  EXPECT_EQ(inputs.attitude.phi, 0.0);
  EXPECT_EQ(inputs.attitude.theta, 0.0);
  EXPECT_FALSE(inputs.saturated);
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(inputs.rotor_speeds[i], 620.6, 0.1);
}

TEST(FlatInputs, ForwardMeansPositivePitchAndLeftNegativeRoll) {
  EXPECT_GT(attitudeFor(Vector3::Zero(), Vector3(1.0, 0.0, 0.0), kVehicle).theta, 0.05);
  EXPECT_LT(attitudeFor(Vector3::Zero(), Vector3(0.0, 1.0, 0.0), kVehicle).phi, -0.05);
}

TEST(FlatInputs, RatesAndTorquesAreTheDerivativesOfTheAttitude) {
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const Motion motion = randomMotion(random);
    const auto along = [&](double t) {
      const KinematicState x = propagate(motion.x, motion.jerk, t);
      return flatInputs(x.v, x.a, motion.jerk, kVehicle);
    };
    const FlatInputs inputs = along(0.0);
    const double h = differenceStep();
    const FlatInputs before = along(-h);
    const FlatInputs after = along(h);
    const double scale = 1.0 + std::abs(inputs.phi_rate) + std::abs(inputs.theta_rate);
    EXPECT_NEAR(inputs.phi_rate, (after.attitude.phi - before.attitude.phi) / (2.0 * h), 1e-8 * std::pow(scale, 3));
    EXPECT_NEAR(inputs.theta_rate, (after.attitude.theta - before.attitude.theta) / (2.0 * h),
                1e-8 * std::pow(scale, 3));
    EXPECT_NEAR(inputs.tau_phi / kVehicle.inertia_x, (after.phi_rate - before.phi_rate) / (2.0 * h),
                1e-8 * std::pow(scale, 4));
    EXPECT_NEAR(inputs.tau_theta / kVehicle.inertia_y, (after.theta_rate - before.theta_rate) / (2.0 * h),
                1e-8 * std::pow(scale, 4));
  }
}

TEST(FlatInputs, RotorSpeedsProduceTheWrench) {
  Random random(4);
  int unsaturated = 0;
  for (int n = 0; n < 5000; ++n) {
    const Wrench wanted{random.uniform(0.5, 11.0), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5)};
    bool saturated = false;
    const Vector4 rotors = rotorSpeeds(wanted.thrust, wanted.tau_phi, wanted.tau_theta, kVehicle, &saturated);
    EXPECT_GE(rotors.minCoeff(), 0.0);
    EXPECT_LE(rotors.maxCoeff(), kVehicle.max_rotor_speed * (1.0 + 1e-15));
    if (saturated) continue;
    ++unsaturated;
    const Wrench got = rotorWrench(rotors, kVehicle);
    EXPECT_NEAR(got.thrust, wanted.thrust, 1e-12);
    EXPECT_NEAR(got.tau_phi, wanted.tau_phi, 1e-12);
    EXPECT_NEAR(got.tau_theta, wanted.tau_theta, 1e-12);
    // Zero yaw moment: the two pairs of rotors turn against each other.
    const Vector4 squared = rotors.cwiseAbs2();
    EXPECT_NEAR(squared[0] + squared[2], squared[1] + squared[3], 1e-6);
  }
  EXPECT_GT(unsaturated, 1000);
}

TEST(FlatInputs, RotorsSaturateAndSaySo) {
  bool saturated = false;
  Vector4 rotors = rotorSpeeds(20.0, 0.0, 0.0, kVehicle, &saturated);
  EXPECT_TRUE(saturated);
  EXPECT_NEAR(rotors.minCoeff(), kVehicle.max_rotor_speed, 1e-9);

  rotors = rotorSpeeds(1.0, 2.0, 0.0, kVehicle, &saturated);
  EXPECT_TRUE(saturated);
  EXPECT_EQ(rotors[2], 0.0);

  rotorSpeeds(4.6, 0.01, -0.01, kVehicle, &saturated);
  EXPECT_FALSE(saturated);
}

TEST(FlatInputs, FreeFallIsFinite) {
  const FlatInputs inputs = flatInputs(Vector3::Zero(), -kVehicle.gravity * upward(), Vector3(1.0, 2.0, 3.0), kVehicle);
  EXPECT_NEAR(inputs.attitude.thrust, 0.0, 1e-12);
  EXPECT_EQ(inputs.phi_rate, 0.0);
  EXPECT_EQ(inputs.tau_theta, 0.0);
  EXPECT_TRUE(inputs.rotor_speeds.allFinite());
}

TEST(FlatInputs, FlyAPlannedSegmentThroughTheDynamics) {
  // The whole chain: rotor speeds from the plan alone, integrated through (1), stay on the planned segment.
  KinematicState plan;
  plan.v = Vector3(2.0, -1.0, 0.3);
  plan.a = Vector3(1.0, 0.5, -0.5);
  const Vector3 jerk(-3.0, 2.0, 1.0);
  const FlatInputs start = flatInputs(plan.v, plan.a, jerk, kVehicle);
  QuadState state;
  state.p = plan.p;
  state.v = plan.v;
  state.phi = start.attitude.phi;
  state.theta = start.attitude.theta;
  state.phi_rate = start.phi_rate;
  state.theta_rate = start.theta_rate;

  constexpr double kStep = 1e-3;
  for (int i = 0; i < 300; ++i) {
    // Inputs of the step's middle: the speeds are constant over it.
    const KinematicState middle = propagate(plan, jerk, (i + 0.5) * kStep);
    const FlatInputs inputs = flatInputs(middle.v, middle.a, jerk, kVehicle);
    ASSERT_FALSE(inputs.saturated);
    state = stepRungeKutta4(state, inputs.rotor_speeds, Vector3::Zero(), kStep, kVehicle);
  }
  const KinematicState end = propagate(plan, jerk, 0.3);
  EXPECT_LT((state.p - end.p).norm(), 1e-6);
  EXPECT_LT((state.v - end.v).norm(), 1e-6);
}

}  // namespace
}  // namespace swarm_planner
