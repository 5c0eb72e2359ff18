// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// If these fail, the closed-loop figures say nothing about real vehicles: the simulated quadrotor would not fly what
// it was asked to, would fly what no quadrotor can, or would be upset by a bad message.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <new>

#include "swarm_planner/simulation/quad_simulator.hpp"

namespace {
std::atomic<long> allocations{0};
}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// Not inlined: where a compiler sees free() but not malloc() it takes them for a mismatched pair.
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace swarm_planner {
namespace {

constexpr double kCycle = 0.3;
constexpr double kSetpointPeriod = 0.05;

/// A plan that speeds up sideways and upwards, turns and stops, within the planner's usual limits.
Trajectory smoothPlan(double epoch, const Vector3& start) {
  Trajectory plan;
  plan.epoch = epoch;
  plan.dt = kCycle;
  KinematicState x;
  x.p = start;
  // Two smooth accelerations whose jerks sum to zero, so that the plan ends at rest.
  for (int k = 0; k < kHorizon; ++k) {
    const double phase = 2.0 * M_PI * (k + 0.5) / kHorizon;
    plan.jerks[static_cast<std::size_t>(k)] =
        Vector3(4.0 * std::cos(2.0 * phase), 3.0 * std::sin(3.0 * phase), 1.5 * std::cos(phase));
  }
  rollOut(x, plan);
  return plan;
}

SetpointTrajectory sampled(const Trajectory& plan) {
  SetpointTrajectory points;
  sampleMotion(plan, plan.epoch, kSetpointPeriod, std::numeric_limits<double>::infinity(), 0.0, points);
  return points;
}

SetpointTrajectory single(double epoch, const Vector3& p) {
  SetpointTrajectory trajectory;
  trajectory.epoch = epoch;
  trajectory.points.resize(1);
  trajectory.points[0].p = p;
  return trajectory;
}

class QuadSimulatorTest : public ::testing::Test {
 protected:
  Parameters parameters_;
  Vector3 start_{1.0, -2.0, 20.0};
};

TEST_F(QuadSimulatorTest, HoversWhereItStartsUntilItIsToldOtherwise) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(100.0);
  quad.advanceTo(110.0);
  EXPECT_DOUBLE_EQ(quad.time(), 110.0);
  EXPECT_LT((quad.state().p - start_).norm(), 1e-9);
  EXPECT_NEAR(quad.thrust(), parameters_.vehicle.mass * parameters_.vehicle.gravity, 1e-9);
  EXPECT_NEAR(quad.rotorSpeeds().mean(), 620.0, 2.0);
}

TEST_F(QuadSimulatorTest, TracksAPlannedTrajectory) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(5.0);
  const Trajectory plan = smoothPlan(5.3, start_);
  ASSERT_TRUE(quad.receive(sampled(plan)));
  double worst = 0.0;
  double farthest = 0.0;
  for (double t = 5.0; t < 5.3 + plan.duration(); t += 0.01) {
    quad.advanceTo(t);
    const Vector3 wanted = t < plan.epoch ? start_ : plan.at(t).p;
    worst = std::max(worst, (quad.state().p - wanted).norm());
    farthest = std::max(farthest, (wanted - start_).norm());
    EXPECT_NEAR(quad.trackingError(), (quad.state().p - wanted).norm(), 1e-6);
  }
  EXPECT_GT(farthest, 3.0);  // it was a flight
  EXPECT_LT(worst, 0.005);
}

/// To and fro with the most jerk, each stage 0.15 s.
Trajectory jerkyPlan(double epoch, const Vector3& start, double jerk) {
  Trajectory plan;
  plan.epoch = epoch;
  plan.dt = 0.15;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    const double sign = k % 4 == 0 || k % 4 == 3 ? 1.0 : -1.0;
    plan.jerks[k] = sign * jerk * Vector3(0.6, 0.0, 0.8);
  }
  KinematicState x;
  x.p = start;
  rollOut(x, plan);
  return plan;
}

double worstErrorOf(QuadSimulator& quad, const Trajectory& plan) {
  double worst = 0.0;
  for (double t = plan.epoch; t < plan.epoch + plan.duration(); t += 0.005) {
    quad.advanceTo(t);
    worst = std::max(worst, (quad.state().p - plan.at(t).p).norm());
  }
  return worst;
}

// tracking_error of a small room is 5 mm.
TEST_F(QuadSimulatorTest, JumpsOfJerkHardlyTakeItOffItsPlan) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  const Trajectory plan = jerkyPlan(0.15, start_, 0.5 * parameters_.limits.max_jerk);
  ASSERT_TRUE(quad.receive(sampled(plan)));
  EXPECT_LT(worstErrorOf(quad, plan), 0.0025);
}

// What that is owed to: it turns in time. Where each jump comes as a surprise it is late.
TEST_F(QuadSimulatorTest, JumpsOfJerkThatAreNotKnownBeforeDoTakeItOffItsPlan) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  const Trajectory plan = jerkyPlan(0.15, start_, 0.5 * parameters_.limits.max_jerk);
  double worst = 0.0;
  for (std::size_t k = 0; k < kHorizon; ++k) {
    Trajectory known = plan;
    std::fill(known.jerks.begin() + static_cast<std::ptrdiff_t>(k) + 1, known.jerks.end(), plan.jerks[k]);
    rollOut(plan.knots[0], known);
    const double begin = plan.epoch + static_cast<double>(k) * plan.dt;
    quad.advanceTo(begin);
    ASSERT_TRUE(quad.receive(sampled(known)));
    for (double t = begin; t < begin + plan.dt; t += 0.005) {
      quad.advanceTo(t);
      worst = std::max(worst, (quad.state().p - plan.at(t).p).norm());
    }
  }
  EXPECT_GT(worst, 0.01);
}

TEST_F(QuadSimulatorTest, FlyingTakesNoMemory) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  ASSERT_TRUE(quad.receive(sampled(smoothPlan(0.3, start_))));
  ASSERT_TRUE(quad.receive(sampled(smoothPlan(0.6, start_))));
  const long before = allocations;
  quad.advanceTo(10.0);
  EXPECT_EQ(allocations - before, 0);
}

TEST_F(QuadSimulatorTest, SettlesAfterAStep) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  const Vector3 goal = start_ + Vector3(3.0, -2.0, 1.0);
  ASSERT_TRUE(quad.receive(single(0.0, goal)));
  double overshoot = 0.0;
  for (double t = 0.0; t < 8.0; t += 0.01) {
    quad.advanceTo(t);
    overshoot =
        std::max(overshoot, (quad.state().p - start_).dot((goal - start_).normalized()) - (goal - start_).norm());
  }
  EXPECT_LT((quad.state().p - goal).norm(), 0.01);
  EXPECT_LT(quad.state().v.norm(), 0.01);
  EXPECT_LT(overshoot, 0.25 * (goal - start_).norm());
}

TEST_F(QuadSimulatorTest, RotorsAndTiltStayWithinTheirLimitsHoweverFarTheGoal) {
  for (const Vector3& offset : {Vector3(500.0, 0.0, 0.0), Vector3(0.0, 0.0, 300.0), Vector3(-200.0, 300.0, -100.0)}) {
    QuadSimulator quad(parameters_, start_, 1);
    quad.advanceTo(0.0);
    ASSERT_TRUE(quad.receive(single(0.0, start_ + offset)));
    bool saturated = false;
    for (double t = 0.0; t < 60.0; t += 0.01) {
      quad.advanceTo(t);
      saturated = saturated || quad.saturated();
      ASSERT_LE(quad.rotorSpeeds().maxCoeff(), parameters_.vehicle.max_rotor_speed);
      ASSERT_GE(quad.rotorSpeeds().minCoeff(), 0.0);
      ASSERT_LT(std::max(std::abs(quad.state().phi), std::abs(quad.state().theta)), 1.5);
      ASSERT_TRUE(quad.state().p.allFinite());
    }
    EXPECT_LT((quad.state().p - start_ - offset).norm(), 0.05) << offset.transpose();
  }
}

TEST_F(QuadSimulatorTest, WeakRotorsAreWhatLimitsTheFlight) {
  parameters_.vehicle.max_rotor_speed = 700.0;  // little above hover
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  ASSERT_TRUE(quad.receive(single(0.0, start_ + Vector3(0.0, 0.0, 100.0))));
  quad.advanceTo(0.5);
  const double hover = 620.0 * 620.0;
  const double most = parameters_.vehicle.gravity * (700.0 * 700.0 / hover - 1.0);
  EXPECT_GT(quad.state().v.z(), 0.2 * most * 0.5);
  EXPECT_LT(quad.state().v.z(), 1.05 * most * 0.5);
}

TEST_F(QuadSimulatorTest, ComesBackAfterAGust) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  quad.setDisturbance(Vector3(2.0, -1.0, 0.0));
  quad.advanceTo(2.0);
  const double blown = (quad.state().p - start_).norm();
  EXPECT_GT(blown, 0.2);
  EXPECT_LT(blown, 1.0);
  quad.setDisturbance(Vector3::Zero());
  quad.advanceTo(8.0);
  EXPECT_LT((quad.state().p - start_).norm(), 0.01);
  EXPECT_THROW(quad.setDisturbance(Vector3(std::nan(""), 0.0, 0.0)), std::invalid_argument);
  EXPECT_THROW(quad.push(Vector3(std::nan(""), 0.0, 0.0)), std::invalid_argument);
}

TEST_F(QuadSimulatorTest, GustsShakeAHoveringVehicleAsLinearTheoryPredicts) {
  parameters_.simulation.wind = 1.0;
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  Vector3 square = Vector3::Zero();
  int count = 0;
  for (double t = 0.1; t < 2000.0; t += 0.1, ++count) {
    quad.advanceTo(t);
    square += (quad.state().p - start_).cwiseAbs2();
  }
  // d^2 p / dt^2 + velocity_gain dp / dt + position_gain p = (k_d / M) w, and w a first-order process.
  const double k = parameters_.simulation.position_gain, c = parameters_.simulation.velocity_gain;
  const double rate = 1.0 / parameters_.simulation.gust_time;
  const double gain = (rate + c) / (k * c * (rate * rate + rate * c + k));
  for (int axis = 0; axis < 3; ++axis) {
    const double expected = parameters_.vehicle.dragOverMass()(axis) * std::sqrt(gain);
    EXPECT_NEAR(std::sqrt(square(axis) / count), expected, 0.15 * expected);
  }
}

TEST_F(QuadSimulatorTest, WindActsThroughTheDragAlone) {
  parameters_.simulation.wind = 5.0;
  parameters_.vehicle.drag_x = parameters_.vehicle.drag_y = 0.0;
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  quad.advanceTo(5.0);
  EXPECT_GT(quad.wind().head<2>().norm(), 0.1);
  EXPECT_LT((quad.state().p - start_).head<2>().norm(), 1e-6);
  EXPECT_GT(std::abs(quad.state().p.z() - start_.z()), 0.01);
}

TEST_F(QuadSimulatorTest, EveryUavHasGustsOfItsOwnThatFollowTheSeed) {
  parameters_.simulation.wind = 2.0;
  const auto flight = [this](std::uint64_t seed, std::size_t index) {
    QuadSimulator quad(parameters_, start_, seed, index);
    quad.advanceTo(0.0);
    quad.advanceTo(3.0);
    return Vector3(quad.state().p);
  };
  EXPECT_EQ(flight(1, 0), flight(1, 0));
  EXPECT_NE(flight(1, 0), flight(2, 0));
  EXPECT_NE(flight(1, 0), flight(1, 1));
}

TEST_F(QuadSimulatorTest, FliesOnWithTheOldTrajectoryUntilTheNewOnesEpoch) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  ASSERT_TRUE(quad.receive(single(0.0, start_ + Vector3(1.0, 0.0, 0.0))));
  ASSERT_TRUE(quad.receive(single(2.0, start_ + Vector3(0.0, 5.0, 0.0))));
  quad.advanceTo(1.99);
  EXPECT_EQ(quad.setpoint().p, start_ + Vector3(1.0, 0.0, 0.0));
  quad.advanceTo(2.01);
  EXPECT_EQ(quad.setpoint().p, start_ + Vector3(0.0, 5.0, 0.0));
}

TEST_F(QuadSimulatorTest, HoldsTheLastPositionAfterTheEnd) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  const Trajectory plan = smoothPlan(0.3, start_);
  ASSERT_TRUE(quad.receive(sampled(plan)));
  quad.advanceTo(plan.epoch + plan.duration() + 6.0);
  EXPECT_LT((quad.state().p - plan.knots.back().p).norm(), 0.01);
  EXPECT_LT(quad.state().v.norm(), 0.01);
}

TEST_F(QuadSimulatorTest, RefusesWhatCannotBeFlownAndGoesOn) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(0.0);
  const Vector3 goal = start_ + Vector3(1.0, 0.0, 0.0);
  ASSERT_TRUE(quad.receive(single(0.0, goal)));
  const SetpointTrajectory good = sampled(smoothPlan(0.3, start_));
  const auto spoiled = [&good](auto&& spoil) {
    SetpointTrajectory bad = good;
    spoil(bad);
    return bad;
  };
  EXPECT_FALSE(quad.receive(SetpointTrajectory{}));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.epoch = nan; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[3].p.y() = nan; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[3].v.z() = infinity; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[3].a.x() = nan; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[3].p.x() = 1e300; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[3].time_from_start = nan; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[3].time_from_start = x.points[2].time_from_start; })));
  EXPECT_FALSE(quad.receive(spoiled([&](auto& x) { x.points[0].time_from_start = -0.1; })));
  quad.advanceTo(10.0);
  EXPECT_LT((quad.state().p - goal).norm(), 0.01);
}

TEST_F(QuadSimulatorTest, MeasuresTheTruthWithoutNoise) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(3.0);
  const UavMeasurement measured = quad.measure();
  EXPECT_TRUE(measured.received);
  EXPECT_EQ(measured.stamp, 3.0);
  EXPECT_EQ(measured.p, quad.state().p);
  EXPECT_EQ(measured.v, quad.state().v);
}

TEST_F(QuadSimulatorTest, NoiseHasTheStatedDeviationAndFollowsTheSeed) {
  parameters_.simulation.position_noise = 0.1;
  parameters_.simulation.velocity_noise = 0.3;
  QuadSimulator quad(parameters_, start_, 7), same(parameters_, start_, 7), other(parameters_, start_, 8);
  constexpr int kCount = 20000;
  Vector3 mean = Vector3::Zero(), square = Vector3::Zero(), velocity_square = Vector3::Zero();
  for (int i = 0; i < kCount; ++i) {
    const UavMeasurement measured = quad.measure();
    const UavMeasurement repeated = same.measure();
    ASSERT_EQ(measured.p, repeated.p);
    ASSERT_EQ(measured.v, repeated.v);
    ASSERT_NE(measured.p, other.measure().p);
    mean += (measured.p - start_) / kCount;
    square += (measured.p - start_).cwiseAbs2() / kCount;
    velocity_square += measured.v.cwiseAbs2() / kCount;
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean(axis), 0.0, 4.0 * 0.1 / std::sqrt(kCount));
    EXPECT_NEAR(std::sqrt(square(axis)), 0.1, 0.1 * 4.0 / std::sqrt(2.0 * kCount));
    EXPECT_NEAR(std::sqrt(velocity_square(axis)), 0.3, 0.3 * 4.0 / std::sqrt(2.0 * kCount));
  }
}

TEST_F(QuadSimulatorTest, TheBiasIsConstantOfTheStatedLengthAndInAnyDirection) {
  parameters_.simulation.position_bias = 0.2;
  Vector3 mean = Vector3::Zero(), square = Vector3::Zero();
  constexpr std::size_t kCount = 3000;
  for (std::size_t uav = 0; uav < kCount; ++uav) {
    QuadSimulator quad(parameters_, start_, 7, uav);
    const Vector3 bias = quad.measure().p - start_;
    ASSERT_NEAR(bias.norm(), 0.2, 1e-9);
    ASSERT_EQ(quad.measure().p - start_, bias);
    ASSERT_EQ(quad.measure().v, Vector3::Zero());
    mean += bias / (0.2 * kCount);
    square += bias.cwiseAbs2() / (0.04 * kCount);
  }
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(mean(axis), 0.0, 4.0 / std::sqrt(3.0 * kCount));
    EXPECT_NEAR(square(axis), 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / kCount));
  }
}

TEST_F(QuadSimulatorTest, OneDisturbanceLeavesTheNumbersOfTheOthersAlone) {
  const auto measured = [this](double position_noise, double velocity_noise, double bias, double wind) {
    parameters_.simulation.position_noise = position_noise;
    parameters_.simulation.velocity_noise = velocity_noise;
    parameters_.simulation.position_bias = bias;
    parameters_.simulation.wind = wind;
    QuadSimulator quad(parameters_, start_, 7);
    quad.measure();
    return quad.measure();
  };
  const Vector3 noise = measured(0.1, 0.0, 0.0, 0.0).p - start_;
  const Vector3 bias = measured(0.0, 0.0, 0.2, 0.0).p - start_;
  const UavMeasurement all = measured(0.1, 0.3, 0.2, 1.0);
  EXPECT_GT(noise.norm(), 0.0);
  EXPECT_LT((all.p - start_ - noise - bias).norm(), 1e-12);
  EXPECT_EQ(all.v, measured(0.0, 0.3, 0.0, 0.0).v);
}

TEST_F(QuadSimulatorTest, TimeThatGoesBackOrIsNotANumberChangesNothing) {
  QuadSimulator quad(parameters_, start_, 1);
  quad.advanceTo(10.0);
  quad.advanceTo(5.0);
  quad.advanceTo(std::nan(""));
  EXPECT_EQ(quad.time(), 10.0);
  ASSERT_TRUE(quad.receive(single(20.0, start_ + Vector3(9.0, 0.0, 0.0))));
  quad.resetClock(5.0);
  quad.advanceTo(30.0);
  EXPECT_LT((quad.state().p - start_).norm(), 1e-6);  // the trajectory belonged to the old time
}

}  // namespace
}  // namespace swarm_planner
