// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// What a vehicle flies is what the next plan begins from and what the others keep clear of. If these fail, plans jump
// after a lost message, or every vehicle seems to stray.
#include <gtest/gtest.h>

#include "support/flight_problem.hpp"
#include "swarm_planner/swarm/motion_memory.hpp"

namespace swarm_planner {
namespace {

constexpr double kDt = 0.3;
constexpr double kDifference = 0.4;

/// Flies straight for a horizon from `epoch` on, then stops within three seconds.
CommittedMotion straight(double epoch, const Vector3& p, const Vector3& v) {
  const Trajectory plan = straightPlan(p, v, epoch, kDt);
  StopManoeuvre stop;
  rollOutStop(plan.knots.back(), 10, kDt, stop);
  CommittedMotion motion;
  motion.assign(plan, stop);
  return motion;
}

/// Bends away from where `motion` is at `epoch`, with a jerk of `bend` along y [m/s^3].
CommittedMotion bentOff(const CommittedMotion& motion, double epoch, double bend) {
  std::array<Vector3, kHorizon> jerks = noJerks();
  jerks[0] = bend * Vector3::UnitY();
  jerks[1] = -bend * Vector3::UnitY();
  const Trajectory plan = makePlan(motion.at(epoch), jerks, epoch, kDt);
  StopManoeuvre stop;
  rollOutStop(plan.knots.back(), 10, kDt, stop);
  CommittedMotion bent;
  bent.assign(plan, stop);
  return bent;
}

bool areClose(const KinematicState& x, const KinematicState& y) {
  return (x.p - y.p).norm() < 1e-9 && (x.v - y.v).norm() < 1e-9 && (x.a - y.a).norm() < 1e-7;
}

/// Flies a first motion from 100 s on, and a second one, bent off it, from 100.3 s on.
class TwoMotions : public ::testing::Test {
 protected:
  TwoMotions() : first_(straight(100.0, Vector3(1, 2, 3), Vector3::UnitX())), second_(bentOff(first_, 100.3, 10.0)) {
    memory_.commit(first_);
    memory_.commit(second_);
  }
  /// Odometry that shows the UAV on the first motion, so late that the two are far apart.
  void showFirst() { memory_.compare(101.5, first_.at(101.5).p, kDifference); }

  CommittedMotion first_;
  CommittedMotion second_;
  MotionMemory memory_;
};

TEST(MotionMemory, OfNothingIsEmpty) {
  MotionMemory memory;
  EXPECT_TRUE(memory.empty());
  EXPECT_FALSE(memory.expectedAt(100.0));
  EXPECT_EQ(memory.older(), nullptr);
}

TEST(MotionMemory, OfOneMotionHasNoOther) {
  MotionMemory memory;
  const CommittedMotion motion = straight(100.0, Vector3::Zero(), Vector3::UnitX());
  memory.commit(motion);
  EXPECT_FALSE(memory.empty());
  EXPECT_EQ(memory.older(), nullptr);
  memory.compare(102.0, Vector3(50, 0, 0), kDifference);
  EXPECT_FALSE(memory.newestIsLost()) << "there is nothing else that it could fly";
  EXPECT_TRUE(areClose(*memory.expectedAt(101.0), motion.at(101.0)));
  EXPECT_FALSE(memory.expectedAt(99.9)) << "nothing is known of before";
}

TEST_F(TwoMotions, AreTheNewestAndTheOneBefore) {
  EXPECT_TRUE(areClose(memory_.newest().at(104.0), second_.at(104.0)));
  ASSERT_NE(memory_.older(), nullptr);
  EXPECT_TRUE(areClose(memory_.older()->at(104.0), first_.at(104.0)));
  EXPECT_EQ(&memory_.flown(), &memory_.newest());
}

TEST_F(TwoMotions, WereFlownOneAfterTheOther) {
  EXPECT_TRUE(areClose(*memory_.expectedAt(100.2), first_.at(100.2)));
  EXPECT_TRUE(areClose(*memory_.expectedAt(101.2), second_.at(101.2)));
  EXPECT_GT((first_.at(101.2).p - second_.at(101.2).p).norm(), 0.1) << "they hardly differ: this shows nothing";
}

// The UAV is elsewhere: what it was to fly before tells nothing of where it is, but it may still try.
TEST_F(TwoMotions, LeaveTheOneFlownAsTheOlderWhenTheUavStartsAnew) {
  const CommittedMotion third = straight(102.0, Vector3(50, 0, 0), Vector3::UnitY());
  memory_.startAnew(third);
  EXPECT_TRUE(areClose(memory_.newest().at(103.0), third.at(103.0)));
  ASSERT_NE(memory_.older(), nullptr);
  EXPECT_TRUE(areClose(memory_.older()->at(103.0), second_.at(103.0)));
  EXPECT_FALSE(memory_.expectedAt(101.9));
  EXPECT_TRUE(areClose(*memory_.expectedAt(102.5), third.at(102.5)));
}

TEST_F(TwoMotions, AreToldApartByOdometry) {
  const Vector3 p = second_.at(101.5).p;
  const Vector3 off = (first_.at(101.5).p - p).normalized();
  const double apart = (first_.at(101.5).p - p).norm();
  ASSERT_GT(apart, 2.0 * kDifference);
  memory_.compare(101.5, p, kDifference);
  EXPECT_FALSE(memory_.newestIsLost());
  // Nearer to the older one, but not by so much that noise could not be why.
  memory_.compare(101.5, p + 0.5 * (apart + 0.9 * kDifference) * off, kDifference);
  EXPECT_FALSE(memory_.newestIsLost());
  memory_.compare(101.5, p + 0.5 * (apart + 1.1 * kDifference) * off, kDifference);
  EXPECT_TRUE(memory_.newestIsLost());
  EXPECT_EQ(&memory_.flown(), memory_.older());
  EXPECT_TRUE(areClose(*memory_.expectedAt(101.5), first_.at(101.5)));
  memory_.compare(101.6, second_.at(101.6).p, kDifference);
  EXPECT_FALSE(memory_.newestIsLost()) << "it did arrive, late";
}

TEST_F(TwoMotions, AreNotToldApartByOdometryFromBeforeTheNewest) {
  // There the newest is but its first piece drawn out backwards.
  ASSERT_GT((second_.at(100.0).p - first_.at(100.0).p).norm(), 0.02);
  memory_.compare(100.0, first_.at(100.0).p, 0.01);
  EXPECT_FALSE(memory_.newestIsLost()) << "it was not to fly the newest yet";
}

// The plan that follows a lost one begins on what is flown: that is the alternative from then on, not the lost one.
TEST_F(TwoMotions, LeaveTheOneFlownAsTheOlderAfterTheNextCommit) {
  showFirst();
  ASSERT_TRUE(memory_.newestIsLost());
  const CommittedMotion third = bentOff(first_, 101.8, -10.0);
  memory_.commit(third);
  EXPECT_FALSE(memory_.newestIsLost());
  EXPECT_TRUE(areClose(memory_.newest().at(104.0), third.at(104.0)));
  ASSERT_NE(memory_.older(), nullptr);
  EXPECT_TRUE(areClose(memory_.older()->at(104.0), first_.at(104.0)));
  EXPECT_TRUE(areClose(*memory_.expectedAt(101.7), first_.at(101.7))) << "that is what it flew until then";
}

TEST_F(TwoMotions, LeaveTheOneFlownAloneWhenTheUavGoesOn) {
  showFirst();
  memory_.goOn(101.8);
  EXPECT_FALSE(memory_.newestIsLost());
  EXPECT_EQ(memory_.older(), nullptr) << "what was lost will not come any more";
  EXPECT_TRUE(areClose(memory_.newest().at(104.0), first_.at(104.0)));
}

TEST_F(TwoMotions, LoseOnlyWhatHasEndedWhenTheUavGoesOn) {
  memory_.goOn(101.3);  // three pieces and a third have gone by
  EXPECT_NEAR(memory_.newest().epoch(), 101.2, 1e-9);
  EXPECT_EQ(memory_.newest().pieces(), second_.pieces() - 3);
  ASSERT_NE(memory_.older(), nullptr) << "it may still be the one that is flown";
  for (const double t : {101.2, 101.3, 103.0, 110.0, 200.0}) {
    EXPECT_TRUE(areClose(memory_.newest().at(t), second_.at(t))) << t;
  }
  for (const double t : {100.4, 101.0, 101.15}) {
    EXPECT_TRUE(areClose(*memory_.expectedAt(t), second_.at(t))) << t << ": old odometry is still to be understood";
  }
  EXPECT_TRUE(areClose(*memory_.expectedAt(100.1), first_.at(100.1)));
}

// An epoch that rounding puts just before a knot must not leave a piece of no length behind.
TEST_F(TwoMotions, LoseAPieceThatEndsAtTheEpoch) {
  memory_.goOn(100.3 + 2.0 * kDt - 1e-12);
  EXPECT_EQ(memory_.newest().pieces(), second_.pieces() - 2);
  memory_.goOn(100.3);
  EXPECT_EQ(memory_.newest().pieces(), second_.pieces() - 2) << "nothing comes back, nothing more is lost";
}

TEST_F(TwoMotions, RestForGoodAfterTheirEnd) {
  memory_.goOn(500.0);
  EXPECT_EQ(memory_.newest().pieces(), 0);
  EXPECT_EQ(memory_.newest().at(600.0).p, second_.restingPlace());
  memory_.goOn(501.0);
  EXPECT_EQ(memory_.newest().at(600.0).p, second_.restingPlace());
}

TEST_F(TwoMotions, AreForgotten) {
  showFirst();
  memory_.clear();
  EXPECT_TRUE(memory_.empty());
  EXPECT_FALSE(memory_.newestIsLost());
  EXPECT_FALSE(memory_.expectedAt(101.0));
  memory_.commit(straight(200.0, Vector3::Zero(), Vector3::UnitX()));
  EXPECT_EQ(memory_.older(), nullptr);
  EXPECT_FALSE(memory_.expectedAt(100.1)) << "what was flown then is forgotten too";
}

// Seconds of odometry delay over many cycles: what is expected is always the motion that was flown at that time.
TEST(MotionMemory, KnowsWhatWasFlownSomeCyclesAgo) {
  Random random(1);
  MotionMemory memory;
  std::vector<CommittedMotion> flown{straight(100.0, Vector3::Zero(), Vector3::UnitX())};
  memory.commit(flown.back());
  for (int cycle = 1; cycle < 60; ++cycle) {
    const double epoch = 100.0 + 0.3 * cycle;
    if (random.integer(0, 2) == 0) {
      memory.goOn(epoch);
    } else {
      flown.push_back(bentOff(flown.back(), epoch, random.uniform(-5.0, 5.0)));
      memory.commit(flown.back());
    }
    for (double age = 0.0; age < 1.5 && age < 0.3 * cycle; age += 0.07) {
      const double t = epoch + 0.2 - age;
      std::size_t at = flown.size() - 1;
      while (flown[at].epoch() > t) --at;
      const std::optional<KinematicState> expected = memory.expectedAt(t);
      ASSERT_TRUE(expected) << cycle << " " << age;
      ASSERT_LT((expected->p - flown[at].at(t).p).norm(), 1e-8) << cycle << " " << age;
      ASSERT_LT((expected->v - flown[at].at(t).v).norm(), 1e-8) << cycle << " " << age;
    }
  }
}

// A UAV that rests for long is sent its rest in every cycle: what it flew before the stop is no place to keep clear of.
TEST(MotionMemory, TheOlderMotionIsInFlightForTwoCyclesOnly) {
  constexpr double kPeriod = 0.3;
  MotionMemory memory;
  CommittedMotion rest;
  rest.assignRest(0.3, Vector3(0, 0, 1));
  memory.commit(rest);
  EXPECT_EQ(memory.olderInFlight(0.3, kPeriod), nullptr);
  rest.assignRest(0.6, Vector3(0, 0, 2));
  memory.commit(rest);
  EXPECT_EQ(memory.olderInFlight(0.6, kPeriod), memory.older());
  ASSERT_NE(memory.older(), nullptr);
  memory.goOn(0.9);
  EXPECT_EQ(memory.olderInFlight(0.9, kPeriod), memory.older());
  for (double epoch : {1.2, 1.5, 30.0}) {
    memory.goOn(epoch);
    EXPECT_EQ(memory.olderInFlight(epoch, kPeriod), nullptr) << epoch;
    EXPECT_NE(memory.older(), nullptr) << "odometry may still tell that it is flown";
  }
  memory.commit(rest);
  rest.assignRest(30.3, Vector3(0, 0, 3));
  memory.commit(rest);
  EXPECT_NE(memory.olderInFlight(30.3, kPeriod), nullptr);
}

}  // namespace
}  // namespace swarm_planner
