// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A fault that is not noticed is planned from; one that is seen where there is none grounds a UAV. So each fault here
// has a near miss that must pass.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "support/flight_problem.hpp"
#include "support/random.hpp"
#include "swarm_planner/simulation/gaussian_noise.hpp"
#include "swarm_planner/swarm/odometry_monitor.hpp"

namespace swarm_planner {
namespace {

constexpr double kCycle = 0.3;     // [s]
constexpr double kBegin = 1000.0;  // [s]

class Monitor : public ::testing::Test {
 protected:
  /// What is said of a measurement that arrives as soon as it is made.
  Reason judge(double t, const Vector3& p, const Vector3& v) {
    now_ = kBegin + t;
    return monitor_.judge({true, now_, p, v}, now_, motions_, parameters_);
  }
  /// The UAV is to fly from `p` at `v` for a horizon, then to stop.
  void commit(const Vector3& p, const Vector3& v) {
    const Trajectory plan = straightPlan(p, v, kBegin, kCycle);
    StopManoeuvre stop;
    rollOutStop(plan.knots.back(), 10, kCycle, stop);
    CommittedMotion motion;
    motion.assign(plan, stop);
    motions_.commit(motion);
  }
  /// It comes from elsewhere to `p`, so that a position that stays the same there tells something.
  void flyTo(const Vector3& p) { judge(-0.6, p - 0.6 * Vector3(3, 0, 0), Vector3(3, 0, 0)); }
  void commitRest(const Vector3& p) {
    CommittedMotion motion;
    motion.assignRest(kBegin - 100.0, p);
    motions_.commit(motion);
  }

  Parameters parameters_;
  MotionMemory motions_;
  OdometryMonitor monitor_;
  double now_ = kBegin;
};

const Vector3 kPlace(1, 2, 10);
const Vector3 kFast(3, 0, 0);

TEST_F(Monitor, SaysWhatCannotBeUsedAtAll) {
  EXPECT_EQ(monitor_.judge({}, kBegin, motions_, parameters_), Reason::kWaitingForOdometry);
  EXPECT_FALSE(monitor_.trusted());
  const UavMeasurement good{true, kBegin, kPlace, kFast};
  UavMeasurement bad = good;
  bad.p.y() = std::nan("");
  EXPECT_EQ(monitor_.judge(bad, kBegin, motions_, parameters_), Reason::kOdometryNotFinite);
  bad = good;
  bad.v.z() = 1e9;
  EXPECT_EQ(monitor_.judge(bad, kBegin, motions_, parameters_), Reason::kOdometryNotFinite);
  EXPECT_EQ(monitor_.judge(good, kBegin - 0.06, motions_, parameters_), Reason::kOdometryFromFuture);
  EXPECT_EQ(monitor_.judge(good, kBegin - 0.04, motions_, parameters_), Reason::kNone);
  EXPECT_EQ(monitor_.judge(good, kBegin + 0.49, motions_, parameters_), Reason::kNone);
  EXPECT_EQ(monitor_.judge(good, kBegin + 0.51, motions_, parameters_), Reason::kOdometryStale);
  ASSERT_TRUE(monitor_.trusted());
  EXPECT_EQ(monitor_.trusted()->p, kPlace);
}

// ---- Frozen

TEST_F(Monitor, NoticesAtOnceThatAFastUavsPositionIsFrozen) {
  commit(kPlace, kFast);
  flyTo(kPlace);
  EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
  EXPECT_EQ(judge(0.3, kPlace, kFast), Reason::kOdometryFrozen);
  EXPECT_EQ(judge(5.0, kPlace, kFast), Reason::kOdometryFrozen);
  EXPECT_EQ(monitor_.trusted()->stamp, kBegin) << "what came later repeats it";
  EXPECT_EQ(judge(5.3, kPlace + 5.3 * kFast, kFast), Reason::kNone) << "it does not come back";
}

TEST_F(Monitor, LetsPositionsPassThatDifferInTheLastBit) {
  commit(kPlace, kFast);
  flyTo(kPlace);
  double x = kPlace.x();
  for (int i = 0; i < 4; ++i) {
    EXPECT_NE(judge(kCycle * i, Vector3(x, 2, 10), kFast), Reason::kOdometryFrozen);
    x = std::nextafter(x, 10.0);
  }
}

// Frozen while it hovered: the velocity says nothing, the motion does. For a moment the UAV may only be late.
TEST_F(Monitor, NoticesByTheMotionThatAHoveringUavsPositionIsFrozen) {
  commit(kPlace, kFast);
  flyTo(kPlace);
  for (const double t : {0.0, 0.3, 0.6, 0.9, 1.2}) EXPECT_EQ(judge(t, kPlace, Vector3::Zero()), Reason::kNone) << t;
  for (const double t : {1.5, 1.8, 9.0}) EXPECT_EQ(judge(t, kPlace, Vector3::Zero()), Reason::kOdometryFrozen) << t;
  EXPECT_EQ(judge(11.0, kPlace, Vector3::Zero()), Reason::kNone) << "without setpoints it will never move";
}

TEST_F(Monitor, NoticesAFrozenPositionBesideALiveVelocity) {
  commit(kPlace, kFast);
  flyTo(kPlace);
  for (int i = 0; i < 5; ++i) EXPECT_NE(judge(kCycle * i, kPlace, (1.0 + 0.01 * i) * kFast), Reason::kOdometryFrozen);
  EXPECT_EQ(judge(1.5, kPlace, kFast), Reason::kOdometryFrozen);
}

// On the ground, motors off, whatever it is told to fly.
// What comes after it may be another lie, but for what is on the motion.
TEST_F(Monitor, DoubtsWhereAFrozenPositionGoesOn) {
  for (const bool back : {true, false}) {
    monitor_ = OdometryMonitor();
    motions_.clear();
    commit(kPlace, kFast);
    flyTo(kPlace);
    judge(0.0, kPlace, kFast);
    ASSERT_EQ(judge(0.3, kPlace, kFast), Reason::kOdometryFrozen);
    ASSERT_EQ(judge(2.7, kPlace, kFast), Reason::kOdometryFrozen);
    const Vector3 next = back ? Vector3(kPlace + 3.0 * kFast) : Vector3(kPlace + Vector3(0.1, 0, 0));
    EXPECT_EQ(judge(3.0, next, kFast), back ? Reason::kNone : Reason::kOdometryJumps);
  }
}

// It stands on its way, where it has stopped on its own meanwhile; but not at the end of a jump.
TEST_F(Monitor, BelievesAUavThatHasStoppedWhileItsOdometryLied) {
  struct Case {
    double along;  ///< the way, where it stands, as the time when it was to be there [s]: it may have braked before 0.6
    double aside;  ///< [m]
  };
  for (const auto [along, aside] : {Case{0.9, 0.2}, Case{0.3, 0.2}, Case{0.9, 2.0}}) {
    monitor_ = OdometryMonitor();
    motions_.clear();
    commit(kPlace, kFast);
    flyTo(kPlace);
    const Vector3 jump(0, 20, 0);
    for (double t = 0.0; t < 0.7; t += 0.3) EXPECT_EQ(judge(t, kPlace + t * kFast, kFast), Reason::kNone);
    const Vector3 stand = kPlace + along * kFast + Vector3(0, aside, 0);
    for (double t = 0.9; t < 2.5; t += 0.3) {
      EXPECT_EQ(judge(t, stand + jump + 0.01 * t * kFast, Vector3::Zero()), Reason::kOdometryJumps);
    }
    for (double t = 2.7; t < 5.0; t += 0.3) {
      const bool believed = aside < 1.0 && t > 3.65;  // after a second
      EXPECT_EQ(judge(t, stand + 0.01 * t * kFast, Vector3::Zero()), believed ? Reason::kNone : Reason::kOdometryJumps);
      EXPECT_EQ(monitor_.stood().has_value(), aside < 1.0 && !believed) << "others keep clear of it at once";
    }
  }
}

// The UAV is where it is to be; its odometry has led its motion astray by what has been taken for noise until then.
TEST_F(Monitor, DoesNotBelieveADriftAgainThatGoesOn) {
  commit(kPlace, kFast);
  flyTo(kPlace);
  bool told = false;
  for (double t = 0.0; t < 5.5; t += 0.3) {
    const Reason reason = judge(t, kPlace + t * (kFast + Vector3(0, 0.8, 0)), kFast);
    EXPECT_TRUE(!told || reason == Reason::kOdometryDrifts) << t;
    told = reason == Reason::kOdometryDrifts;
  }
  EXPECT_TRUE(told);
  EXPECT_EQ(judge(5.7, kPlace + 5.7 * kFast, kFast), Reason::kNone) << "its end";
}

TEST_F(Monitor, LetsAUavRestThatHasNotSetOffYet) {
  commit(kPlace, kFast);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(judge(kCycle * i, kPlace, Vector3::Zero()), Reason::kNone) << i;
}

TEST_F(Monitor, LetsAUavRestWithoutNoiseForEver) {
  commitRest(kPlace);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(judge(kCycle * i, kPlace, Vector3::Zero()), Reason::kNone) << i;
}

TEST_F(Monitor, LetsAUavRestThatHasNoMotionYet) {
  for (int i = 0; i < 100; ++i) ASSERT_EQ(judge(kCycle * i, kPlace, Vector3::Zero()), Reason::kNone) << i;
  commit(kPlace, Vector3(0.02, 0, 0));  // 12 cm in six seconds: no more than noise
  for (int i = 100; i < 200; ++i) ASSERT_EQ(judge(kCycle * i, kPlace, Vector3::Zero()), Reason::kNone) << i;
}

// Its setpoints may come late even after a long rest.
TEST_F(Monitor, LetsAUavThatHasRestedSetOffLate) {
  commitRest(kPlace);
  for (int i = 0; i < 100; ++i) ASSERT_EQ(judge(kCycle * i - 30.0, kPlace, Vector3::Zero()), Reason::kNone) << i;
  commit(kPlace, kFast);
  for (const double t : {0.0, 0.3, 0.6, 0.9}) EXPECT_EQ(judge(t, kPlace, Vector3::Zero()), Reason::kNone) << t;
  EXPECT_EQ(judge(1.2, kPlace + Vector3(0.1, 0, 0), Vector3(1, 0, 0)), Reason::kNone);
}

// It was carried elsewhere and is to rest there now.
TEST_F(Monitor, DoesNotHoldAnOldMotionAgainstAUav) {
  const Vector3 elsewhere = kPlace + Vector3(1.2, 0, 0);
  for (const bool is_told : {true, false}) {
    monitor_ = OdometryMonitor();
    motions_.clear();
    commitRest(kPlace);
    EXPECT_EQ(judge(0.0, kPlace, Vector3::Zero()), Reason::kNone);
    EXPECT_EQ(judge(0.3, elsewhere, Vector3::Zero()), Reason::kNone);
    motions_.clear();
    commitRest(elsewhere);
    if (is_told) monitor_.forgetMotion();
    for (int i = 2; i < 6; ++i) judge(kCycle * i, elsewhere, Vector3::Zero());
    EXPECT_EQ(judge(1.8, elsewhere, Vector3::Zero()), is_told ? Reason::kNone : Reason::kOdometryFrozen);
  }
}

// ---- Jumps

TEST_F(Monitor, NoticesAJumpAndItsEnd) {
  EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
  EXPECT_EQ(judge(0.3, kPlace + Vector3(0.9, 5, 0), kFast), Reason::kOdometryJumps);
  EXPECT_EQ(monitor_.trusted()->p, kPlace);
  EXPECT_EQ(judge(0.6, kPlace + Vector3(1.8, 0, 0), kFast), Reason::kNone);
}

TEST_F(Monitor, BelievesAJumpThatLasts) {
  parameters_.input.relocalisation_time = 1.0;
  const Vector3 elsewhere = kPlace + Vector3(0, 50, 0);
  EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
  for (const double t : {0.3, 0.6, 0.9, 1.2}) EXPECT_EQ(judge(t, elsewhere + t * kFast, kFast), Reason::kOdometryJumps);
  EXPECT_EQ(judge(1.5, elsewhere + 1.5 * kFast, kFast), Reason::kNone);
  EXPECT_EQ(judge(1.8, elsewhere + 1.8 * kFast, kFast), Reason::kNone);
}

// A step to the side becomes a possible flight when enough time has passed: it must not be taken for one.
TEST_F(Monitor, DoesNotTakeAJumpForAFlightLater) {
  commit(kPlace, kFast);
  for (const double side : {1.6, 3.0, 6.0}) {
    monitor_ = OdometryMonitor();
    EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
    for (double t = 0.3; t < 9.0; t += kCycle) {
      ASSERT_EQ(judge(t, kPlace + t * kFast + Vector3(0, side, 0), kFast), Reason::kOdometryJumps) << side << " " << t;
    }
  }
}

// The motion brakes meanwhile; what tracking was off before may have stayed or gone.
TEST_F(Monitor, BelievesAtOnceWhatIsAsFarOffTheMotionAsBefore) {
  commit(kPlace, kFast);
  const Vector3 off(0, 0.9, 0);
  for (const double share : {1.0, 0.5, 0.0, -1.0, 2.0}) {
    monitor_ = OdometryMonitor();
    EXPECT_EQ(judge(0.0, kPlace + off, kFast), Reason::kNone);
    EXPECT_EQ(judge(0.3, kPlace + Vector3(0, 0, 8), kFast), Reason::kOdometryJumps);
    EXPECT_EQ(judge(3.0, kPlace + 3.0 * kFast + share * off, kFast) == Reason::kNone, share >= 0.0 && share <= 1.0)
        << share;
  }
}

// ---- Drift

TEST_F(Monitor, NoticesADriftThatTheVelocityDoesNotHave) {
  commit(kPlace, kFast);
  double noticed = -1.0;
  for (double t = 0.0; t < 6.0; t += kCycle) {
    const Reason reason = judge(t, kPlace + t * kFast + t * Vector3(0, 1, 0), kFast);
    if (reason == Reason::kNone) continue;
    ASSERT_EQ(reason, Reason::kOdometryDrifts) << t;
    if (noticed < 0.0) noticed = t;
  }
  EXPECT_NEAR(noticed, 1.2, kCycle);
  EXPECT_EQ(judge(6.1, motions_.newest().at(kBegin + 6.1).p, kFast), Reason::kNone) << "it does not come back";
}

TEST_F(Monitor, LetsAUavPassThatIsBlownOffOrHasNoVelocity) {
  commit(kPlace, kFast);
  const Vector3 blown(0, 2, 0);
  for (double t = 0.0; t < 6.0; t += kCycle) {
    ASSERT_EQ(judge(t, kPlace + t * (kFast + blown), kFast + blown), Reason::kNone) << t;
  }
  monitor_ = OdometryMonitor();
  for (double t = 0.0; t < 6.0; t += kCycle) {
    ASSERT_EQ(judge(t, kPlace + t * kFast, Vector3::Zero()), Reason::kNone) << t;
  }
}

// However long ago the last believed measurement is by then.
TEST_F(Monitor, NeverBelievesAPositionThatKeepsJumping) {
  EXPECT_EQ(judge(0.0, kPlace, Vector3::Zero()), Reason::kNone);
  Random random(1);
  for (int i = 1; i < 1000; ++i) {
    const double side = i % 2 == 0 ? 20.0 : -20.0;
    ASSERT_EQ(judge(kCycle * i, kPlace + side * Vector3::UnitY() + random.vector(-1.0, 1.0), Vector3::Zero()),
              Reason::kOdometryJumps)
        << i;
  }
}

// ... but one that is back on the motion, at once.
TEST_F(Monitor, BelievesAtOnceWhatIsBackOnTheMotion) {
  for (const bool has_motion : {false, true}) {
    monitor_ = OdometryMonitor();
    if (has_motion) commit(kPlace, kFast);
    EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
    double side = 20.0;
    for (int i = 1; i < 10; ++i) {
      side = -side;
      EXPECT_EQ(judge(kCycle * i, kPlace + Vector3(0, side, 0), kFast), Reason::kOdometryJumps) << i;
    }
    const Reason back = judge(3.0, kPlace + 3.0 * kFast + Vector3(0.1, -0.1, 0.1), kFast);
    EXPECT_EQ(back, has_motion ? Reason::kNone : Reason::kOdometryJumps);
  }
}

// Full thrust sideways from full speed to standstill and back is a flight; noise of the size that is planned for three
// times over is noise.
TEST_F(Monitor, LetsTheHardestFlightPass) {
  Vector3 p = kPlace;
  double v = 5.0;
  ASSERT_EQ(judge(0.0, p, Vector3(v, 0, 0)), Reason::kNone);
  for (int i = 1; i < 100; ++i) {
    const double next = i % 2 == 0 ? 5.0 : 5.0 - 17.0 * kCycle;
    p.x() += 0.5 * kCycle * (v + next);
    v = next;
    ASSERT_EQ(judge(kCycle * i, p, Vector3(v, 0, 0)), Reason::kNone) << i;
  }
}

TEST_F(Monitor, LetsNoisePass) {
  GaussianNoise noise(2);
  const double sigma = parameters_.input.odometry_noise;
  for (int i = 0; i < 20000; ++i) {
    ASSERT_EQ(judge(kCycle * i, kPlace + noise.vector(sigma), noise.vector(sigma)), Reason::kNone) << i;
  }
}

TEST_F(Monitor, LetsAGapPassInWhichTheUavFlewOn) {
  EXPECT_EQ(judge(0.0, kPlace, 5.0 / 3.0 * kFast), Reason::kNone);
  EXPECT_EQ(judge(4.0, kPlace + Vector3(20, 0, 0), 5.0 / 3.0 * kFast), Reason::kNone);
}

// In a gap nearly every place could have been flown to: what counts is where the UAV was to fly.
TEST_F(Monitor, DoubtsWhoIsBackElsewhereAfterAGap) {
  commit(kPlace, kFast);
  for (const double aside : {0.9, 1.2}) {
    monitor_ = OdometryMonitor();
    EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
    const bool believed = aside < parameters_.input.off_plan_distance;
    const auto seen = [&](double t) { return judge(t, kPlace + t * kFast + Vector3(0, aside, 0), kFast); };
    EXPECT_EQ(seen(2.0), believed ? Reason::kNone : Reason::kOdometryJumps);
    EXPECT_EQ(monitor_.seenElsewhere() != nullptr, !believed) << "others keep clear of there, too";
    if (believed) continue;
    EXPECT_EQ(seen(2.3), Reason::kOdometryJumps);
    EXPECT_NE(monitor_.seenElsewhere(), nullptr);
    EXPECT_EQ(judge(2.6, kPlace + Vector3(0, 50, 0), kFast), Reason::kOdometryJumps);
    EXPECT_EQ(monitor_.seenElsewhere(), nullptr) << "nobody flies that: it lies";
    EXPECT_EQ(judge(2.9, kPlace + 2.9 * kFast, kFast), Reason::kNone) << "back on its motion";
  }
}

// Its newest trajectory did not arrive, and nobody could see that.
TEST_F(Monitor, BelievesAfterAGapWhoFliesTheMotionBefore) {
  commit(kPlace, kFast);
  for (const bool is_known : {true, false}) {
    if (!is_known) motions_.clear();
    commit(kPlace, Vector3(0, 3, 0));
    monitor_ = OdometryMonitor();
    EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
    EXPECT_EQ(judge(2.0, kPlace + 2.0 * kFast, kFast), is_known ? Reason::kNone : Reason::kOdometryJumps);
  }
}

// ---- Stamps

TEST_F(Monitor, NoticesStampsThatGoBackUntilTheyGoOn) {
  const auto at = [&](double t, double stamp) {
    return monitor_.judge({true, kBegin + stamp, kPlace + stamp * kFast, kFast}, kBegin + t, motions_, parameters_);
  };
  EXPECT_EQ(at(0.0, 0.0), Reason::kNone);
  EXPECT_EQ(at(0.3, 0.3), Reason::kNone);
  EXPECT_EQ(at(0.6, 0.15), Reason::kOdometryBackwards);
  EXPECT_EQ(at(0.61, 0.15), Reason::kOdometryBackwards) << "the same message again";
  EXPECT_EQ(at(0.9, 0.9), Reason::kNone);
}

TEST_F(Monitor, CallsStampsThatStandStillTooOld) {
  EXPECT_EQ(judge(0.0, kPlace, kFast), Reason::kNone);
  const UavMeasurement still{true, kBegin, kPlace + kFast, kFast};
  EXPECT_EQ(monitor_.judge(still, kBegin + 0.4, motions_, parameters_), Reason::kNone);
  EXPECT_EQ(monitor_.judge(still, kBegin + 0.6, motions_, parameters_), Reason::kOdometryStale);
}

// ---- Off plan

TEST_F(Monitor, TellsADeviationThatLastsAndCountsAnew) {
  parameters_.input.off_plan_distance = 1.5;
  const auto note = [&](double t, double deviation) {
    return monitor_.noteDeviation(deviation, kBegin + t, parameters_.input);
  };
  for (const double t : {0.0, 0.3, 0.6, 0.9}) EXPECT_FALSE(note(t, 1.6)) << t;
  EXPECT_TRUE(note(1.2, 1.6));
  EXPECT_FALSE(note(1.5, 1.6));
  EXPECT_FALSE(note(1.8, 0.0));
  // A gust that ends, and one that is not strong enough.
  for (const double t : {2.0, 2.9}) EXPECT_FALSE(note(t, 3.0)) << t;
  EXPECT_FALSE(note(2.95, 1.0));
  EXPECT_FALSE(note(3.1, 3.0));
  for (double t = 4.0; t < 20.0; t += kCycle) EXPECT_FALSE(note(t, 1.4)) << t;
}

}  // namespace
}  // namespace swarm_planner
