// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, the simulated vehicles do not obey (1) and every closed-loop figure is worthless.
#include <gtest/gtest.h>

#include <cmath>

#include "support/random.hpp"
#include "swarm_planner/model/dynamics.hpp"

namespace swarm_planner {
namespace {

const VehicleParameters kVehicle;

double hoverSpeed() { return std::sqrt(kVehicle.mass * kVehicle.gravity / (4.0 * kVehicle.force_constant)); }

TEST(Dynamics, HoversAtSixHundredTwentyRadiansPerSecond) {
  // With the labels of Table 1 as printed it would take 3,173 rad/s.
  EXPECT_NEAR(hoverSpeed(), 620.6, 0.1);
  QuadState x;
  x.p = Vector3(1.0, 2.0, 3.0);
  const QuadState rate = dynamics(x, rotorWrench(Vector4::Constant(hoverSpeed()), kVehicle), Vector3::Zero(), kVehicle);
  EXPECT_LT(rate.v.norm(), 1e-12);
  EXPECT_EQ(rate.phi_rate, 0.0);
  EXPECT_EQ(rate.theta_rate, 0.0);
}

TEST(Dynamics, LeftRotorRollsToTheRightAndBackRotorPitchesForward) {
  const auto accelerationAfter = [](int faster_rotor) {
    Vector4 rotors = Vector4::Constant(hoverSpeed());
    rotors[faster_rotor] *= 1.01;
    QuadState x;
    for (int i = 0; i < 20; ++i) x = stepRungeKutta4(x, rotors, Vector3::Zero(), 0.01, kVehicle);
    return x.v;
  };
  EXPECT_LT(accelerationAfter(0).y(), -0.01);  // left: towards -y
  EXPECT_GT(accelerationAfter(1).x(), 0.01);   // back: towards +x
  EXPECT_GT(accelerationAfter(2).y(), 0.01);   // right: towards +y
  EXPECT_LT(accelerationAfter(3).x(), -0.01);  // front: towards -x
}

TEST(Dynamics, ObeysEquationOne) {
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    QuadState x;
    x.v = random.vector(-5.0, 5.0);
    x.phi = random.uniform(-1.0, 1.0);
    x.theta = random.uniform(-1.0, 1.0);
    x.phi_rate = random.uniform(-3.0, 3.0);
    x.theta_rate = random.uniform(-3.0, 3.0);
    const Wrench wrench{random.uniform(0.0, 10.0), random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1)};
    const Vector3 wind = random.vector(-1.0, 1.0);
    const QuadState rate = dynamics(x, wrench, wind, kVehicle);
    const double ratio = wrench.thrust / kVehicle.mass;
    EXPECT_NEAR(rate.v.x() - wind.x(), std::cos(x.phi) * std::sin(x.theta) * ratio - 0.25 / 0.468 * x.v.x(), 1e-12);
    EXPECT_NEAR(rate.v.y() - wind.y(), -std::sin(x.phi) * ratio - 0.25 / 0.468 * x.v.y(), 1e-12);
    EXPECT_NEAR(rate.v.z() - wind.z(), -9.81 + std::cos(x.phi) * std::cos(x.theta) * ratio - 0.25 / 0.468 * x.v.z(),
                1e-12);
    EXPECT_NEAR(rate.phi_rate, wrench.tau_phi / 4.856e-3, 1e-12);
    EXPECT_NEAR(rate.theta_rate, wrench.tau_theta / 4.856e-3, 1e-12);
    EXPECT_EQ((rate.p - x.v).norm(), 0.0);
    EXPECT_EQ(rate.phi, x.phi_rate);
    EXPECT_EQ(rate.theta, x.theta_rate);
  }
}

TEST(Dynamics, DragSettlesAtItsTerminalVelocity) {
  // Falling without thrust: v = -g M / k_dz = -18.36 m/s.
  QuadState x;
  for (int i = 0; i < 4000; ++i) x = stepRungeKutta4(x, Vector4::Zero(), Vector3::Zero(), 0.01, kVehicle);
  EXPECT_NEAR(x.v.z(), -9.81 * 0.468 / 0.25, 1e-6);
}

/// Distance of two states, all components.
double difference(const QuadState& x, const QuadState& y) {
  return std::sqrt((x.p - y.p).squaredNorm() + (x.v - y.v).squaredNorm() + std::pow(x.phi - y.phi, 2) +
                   std::pow(x.theta - y.theta, 2));
}

TEST(Dynamics, RungeKuttaConvergesWithOrderFour) {
  const Vector4 rotors = hoverSpeed() * Vector4(1.003, 1.03, 1.001, 1.026);
  const auto fly = [&](int steps) {
    QuadState x;
    x.v = Vector3(2.0, -1.0, 0.5);
    x.phi_rate = 0.3;
    for (int i = 0; i < steps; ++i) x = stepRungeKutta4(x, rotors, Vector3(0.1, 0.2, 0.0), 1.0 / steps, kVehicle);
    return x;
  };
  const QuadState reference = fly(2048);
  for (const int steps : {8, 16, 32}) {
    const double order = std::log2(difference(fly(steps), reference) / difference(fly(2 * steps), reference));
    EXPECT_NEAR(order, 4.0, 0.2) << "steps " << steps;
  }
}

}  // namespace
}  // namespace swarm_planner
