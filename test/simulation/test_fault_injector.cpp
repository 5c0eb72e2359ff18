// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Each kind of fault has to do what its name says, from its beginning to its end and to its UAV alone; else a rehearsal
// shows something that never happens in the field.
#include <gtest/gtest.h>

#include <cmath>

#include "swarm_planner/simulation/fault_injector.hpp"

namespace swarm_planner {
namespace {

constexpr double kBegin = 2.0, kEnd = 5.0;  // [s]

Mission twoUavs() {
  Mission mission;
  for (int i = 0; i < 2; ++i) {
    ScenarioUav uav;
    uav.name = "uav" + std::to_string(i + 1);
    uav.start = Vector3(0.0, 10.0 * i, 5.0);
    mission.scenario.uavs.push_back(uav);
  }
  return mission;
}

FaultInjection fault(FaultKind kind, double magnitude = 0.0) {
  return {kind, faultKindInfo(kind).of_uav ? "uav2" : "", kBegin, kEnd - kBegin, magnitude};
}

FaultInjector with(const FaultInjection& injection) {
  Mission mission = twoUavs();
  mission.scenario.faults = {injection};
  FaultInjector injector(mission, 3);
  injector.scheduleScenario(0.0);
  return injector;
}

/// What a UAV that flies along x at 1 m/s tells at `t`.
UavMeasurement measured(double t) { return {true, t, Vector3(t, 10.0, 5.0), Vector3::UnitX()}; }

struct Told {
  bool arrives = false;
  UavMeasurement measurement;
  QuadState state;
};

Told odometryAt(double t, FaultInjector& injector, std::size_t uav = 1) {
  Told told;
  told.measurement = measured(t);
  told.state.phi = 0.1 * t;
  injector.advanceTo(t);
  told.arrives = injector.spoilOdometry(uav, told.measurement, told.state);
  return told;
}

void expectUntouched(double t, const Told& told) {
  EXPECT_TRUE(told.arrives) << t;
  EXPECT_EQ(told.measurement.stamp, t);
  EXPECT_EQ(told.measurement.p, measured(t).p) << t;
  EXPECT_EQ(told.measurement.v, measured(t).v) << t;
  EXPECT_EQ(told.state.phi, 0.1 * t) << t;
}

TEST(FaultInjector, EveryOdometryFaultBeginsAndEndsInTimeAndIsOfItsUavAlone) {
  for (const FaultKind kind : {FaultKind::kOdometryLost, FaultKind::kOdometryStale, FaultKind::kOdometryFrozen,
                               FaultKind::kOdometryJump, FaultKind::kOdometryDrift, FaultKind::kOdometryNotFinite}) {
    FaultInjector injector = with(fault(kind, faultKindInfo(kind).default_magnitude));
    for (const double t : {0.0, 1.99}) expectUntouched(t, odometryAt(t, injector));
    for (const double t : {2.0, 2.5, 4.99}) {
      expectUntouched(t, odometryAt(t, injector, 0));
      odometryAt(t, injector);
    }
    for (const double t : {5.0, 9.0}) expectUntouched(t, odometryAt(t, injector));
  }
}

TEST(FaultInjector, LostOdometryDoesNotArrive) {
  FaultInjector injector = with(fault(FaultKind::kOdometryLost));
  EXPECT_FALSE(odometryAt(2.0, injector).arrives);
  EXPECT_FALSE(odometryAt(4.99, injector).arrives);
}

TEST(FaultInjector, StaleOdometryHasOldStampsAndNewValues) {
  FaultInjector injector = with(fault(FaultKind::kOdometryStale, 0.75));
  const Told told = odometryAt(3.0, injector);
  EXPECT_DOUBLE_EQ(told.measurement.stamp, 2.25);
  EXPECT_EQ(told.measurement.p, measured(3.0).p);
}

TEST(FaultInjector, FrozenOdometryRepeatsItsFirstValuesUnderNewStamps) {
  FaultInjector injector = with(fault(FaultKind::kOdometryFrozen));
  odometryAt(2.1, injector);
  for (const double t : {2.5, 4.9}) {
    const Told told = odometryAt(t, injector);
    EXPECT_EQ(told.measurement.stamp, t);
    EXPECT_EQ(told.measurement.p, measured(2.1).p);
    EXPECT_EQ(told.measurement.v, measured(2.1).v);
    EXPECT_EQ(told.state.phi, 0.1 * 2.1);
  }
}

TEST(FaultInjector, AJumpIsOneAndTheSameHorizontalOffset) {
  FaultInjector injector = with(fault(FaultKind::kOdometryJump, 4.0));
  const Vector3 offset = odometryAt(2.0, injector).measurement.p - measured(2.0).p;
  EXPECT_NEAR(offset.norm(), 4.0, 1e-12);
  EXPECT_EQ(offset.z(), 0.0);
  EXPECT_LT((odometryAt(4.5, injector).measurement.p - measured(4.5).p - offset).norm(), 1e-12);
}

TEST(FaultInjector, ADriftGrowsFromNothing) {
  FaultInjector injector = with(fault(FaultKind::kOdometryDrift, 0.5));
  EXPECT_LT((odometryAt(2.0, injector).measurement.p - measured(2.0).p).norm(), 1e-12);
  EXPECT_NEAR((odometryAt(3.0, injector).measurement.p - measured(3.0).p).norm(), 0.5, 1e-12);
  EXPECT_NEAR((odometryAt(4.0, injector).measurement.p - measured(4.0).p).norm(), 1.0, 1e-12);
}

TEST(FaultInjector, NotFiniteIsNotANumber) {
  FaultInjector injector = with(fault(FaultKind::kOdometryNotFinite));
  const Told told = odometryAt(3.0, injector);
  EXPECT_TRUE(told.arrives);
  EXPECT_TRUE(std::isnan(told.measurement.p.x()));
}

TEST(FaultInjector, SetpointsAreKeptFromTheirVehicleAlone) {
  for (const FaultKind kind : {FaultKind::kSetpointsLost, FaultKind::kSetpointsIgnored}) {
    FaultInjector injector = with(fault(kind));
    injector.advanceTo(1.9);
    EXPECT_TRUE(injector.setpointsReach(1));
    injector.advanceTo(3.0);
    EXPECT_FALSE(injector.setpointsReach(1));
    EXPECT_TRUE(injector.setpointsReach(0));
    injector.advanceTo(5.0);
    EXPECT_TRUE(injector.setpointsReach(1));
  }
}

QuadSimulator hoveringVehicle() {
  QuadSimulator vehicle(twoUavs().parameters, Vector3::Zero(), 0, 1);
  vehicle.resetClock(0.0);
  return vehicle;
}

/// A vehicle that is on its way along x at 2 m/s for good.
QuadSimulator flyingVehicle() {
  QuadSimulator vehicle = hoveringVehicle();
  SetpointTrajectory trajectory;
  for (int i = 0; i <= 200; ++i) {
    Setpoint point;
    point.time_from_start = 0.1 * i;
    point.p = Vector3(0.2 * i, 0.0, 0.0);
    point.v = Vector3(2.0, 0.0, 0.0);
    trajectory.points.push_back(point);
  }
  vehicle.receive(trajectory);
  return vehicle;
}

void fly(QuadSimulator& vehicle, double until, FaultInjector& injector) {
  for (int i = static_cast<int>(std::lround(100.0 * vehicle.time())) + 1; 0.01 * i <= until + 1e-9; ++i) {
    injector.advanceTo(0.01 * i);
    vehicle.advanceTo(0.01 * i);
    injector.disturb(1, vehicle);
  }
}

TEST(FaultInjector, AVehicleThatIgnoresSetpointsBrakesAndHovers) {
  FaultInjector injector = with(fault(FaultKind::kSetpointsIgnored));
  QuadSimulator vehicle = flyingVehicle();
  fly(vehicle, 1.99, injector);
  const Vector3 place = vehicle.state().p;
  const double speed = vehicle.state().v.norm();
  EXPECT_GT(speed, 1.5);
  fly(vehicle, 4.9, injector);
  EXPECT_LT(vehicle.state().v.norm(), 0.1);
  const double braking_distance = 0.5 * speed * speed / 3.0;
  EXPECT_NEAR((vehicle.state().p - place).norm(), braking_distance, 0.1);
}

TEST(FaultInjector, AVehicleWithoutNewSetpointsFliesOn) {
  FaultInjector injector = with(fault(FaultKind::kSetpointsLost));
  QuadSimulator vehicle = flyingVehicle();
  fly(vehicle, 4.9, injector);
  EXPECT_GT(vehicle.state().v.x(), 1.9);
}

TEST(FaultInjector, APushChangesTheVelocityOnce) {
  FaultInjection push = fault(FaultKind::kPush, 3.0);
  push.duration = 0.0;
  FaultInjector injector = with(push);
  QuadSimulator vehicle = hoveringVehicle();
  fly(vehicle, 1.99, injector);
  const Vector3 before = vehicle.state().v;
  fly(vehicle, 2.0, injector);
  const Vector3 kick = vehicle.state().v - before;
  EXPECT_NEAR(kick.norm(), 3.0, 0.05);
  EXPECT_NEAR(kick.z(), 0.0, 0.01);
  fly(vehicle, 8.0, injector);
  EXPECT_LT((vehicle.state().v - before).norm(), 0.1) << "pushed again";
}

TEST(FaultInjector, WindBlowsAVehicleOffItsCourseUntilItEnds) {
  FaultInjector injector = with(fault(FaultKind::kWind, 5.0));
  QuadSimulator vehicle = hoveringVehicle();
  fly(vehicle, 1.99, injector);
  EXPECT_LT(vehicle.trackingError(), 0.05);
  fly(vehicle, 4.99, injector);
  const Parameters parameters = twoUavs().parameters;
  const double expected = 5.0 * parameters.vehicle.dragOverMass().x() / parameters.simulation.position_gain;
  EXPECT_NEAR(vehicle.trackingError(), expected, 0.15);
  fly(vehicle, 9.0, injector);
  EXPECT_LT(vehicle.trackingError(), 0.05);
}

TEST(FaultInjector, LostTracksDoNotArrive) {
  FaultInjector injector = with(fault(FaultKind::kTracksLost));
  injector.advanceTo(1.0);
  EXPECT_TRUE(injector.tracksArrive());
  injector.advanceTo(3.0);
  EXPECT_FALSE(injector.tracksArrive());
  injector.advanceTo(6.0);
  EXPECT_TRUE(injector.tracksArrive());
}

TEST(FaultInjector, TracksFlickerWithTheGivenProbability) {
  FaultInjector injector = with(fault(FaultKind::kTracksFlicker, 0.3));
  const auto seenOf1000 = [&injector](double t) {
    injector.advanceTo(t);
    int seen = 0;
    for (int i = 0; i < 1000; ++i) seen += injector.trackIsSeen() ? 1 : 0;
    return seen;
  };
  EXPECT_EQ(seenOf1000(1.0), 1000);
  EXPECT_NEAR(seenOf1000(3.0), 700, 60);
  EXPECT_EQ(seenOf1000(5.0), 1000);
}

TEST(FaultInjector, ThePlannerIsDeadForAWhile) {
  FaultInjector injector = with(fault(FaultKind::kPlannerDead));
  EXPECT_TRUE(injector.plannerLives());
  injector.advanceTo(2.0);
  EXPECT_FALSE(injector.plannerLives());
  injector.advanceTo(5.0);
  EXPECT_TRUE(injector.plannerLives());
}

TEST(FaultInjector, FaultsOfOneUavAddUp) {
  Mission mission = twoUavs();
  mission.scenario.faults = {fault(FaultKind::kOdometryFrozen), fault(FaultKind::kOdometryJump, 4.0),
                             fault(FaultKind::kOdometryStale, 1.0)};
  FaultInjector injector(mission, 0);
  injector.scheduleScenario(0.0);
  odometryAt(2.0, injector);
  const Told told = odometryAt(3.0, injector);
  EXPECT_NEAR((told.measurement.p - measured(2.0).p).norm(), 4.0, 1e-12);
  EXPECT_DOUBLE_EQ(told.measurement.stamp, 2.0);
}

TEST(FaultInjector, CountsTheScenariosTimesFromTimeZeroAndItsOwnFromNow) {
  FaultInjector injector = with(fault(FaultKind::kOdometryLost));
  injector.schedule(fault(FaultKind::kTracksLost), 200.0);
  injector.scheduleScenario(100.0);
  injector.advanceTo(50.0);
  EXPECT_TRUE(odometryAt(101.9, injector).arrives);
  EXPECT_FALSE(odometryAt(102.0, injector).arrives);
  injector.scheduleScenario(190.0);  // a new run
  EXPECT_TRUE(odometryAt(103.0, injector).arrives);
  EXPECT_FALSE(odometryAt(193.0, injector).arrives);
  injector.advanceTo(203.0);
  EXPECT_FALSE(injector.tracksArrive());
  injector.clear();
  injector.advanceTo(1.0);
  EXPECT_TRUE(injector.tracksArrive());
}

TEST(FaultInjector, TheSeedGivesTheDirections) {
  const auto offset = [](std::uint64_t seed) {
    Mission mission = twoUavs();
    mission.scenario.faults = {fault(FaultKind::kOdometryJump, 4.0)};
    FaultInjector injector(mission, seed);
    injector.scheduleScenario(0.0);
    return Vector3(odometryAt(3.0, injector).measurement.p);
  };
  EXPECT_EQ(offset(1), offset(1));
  EXPECT_NE(offset(1), offset(2));
}

TEST(FaultInjector, RefusesAUavThatIsNotThere) {
  FaultInjector injector(twoUavs(), 0);
  EXPECT_THROW(injector.schedule({FaultKind::kPush, "uav3", 0.0, 0.0, 1.0}, 0.0), std::invalid_argument);
}

}  // namespace
}  // namespace swarm_planner
