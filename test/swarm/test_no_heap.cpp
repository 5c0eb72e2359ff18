// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// A cycle that allocates can wait for another thread's lock or for memory from the system: the deadline is missed on
// the one day on which it matters. Here malloc and its family count.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "check_scene.hpp"
#include "perfect_flight.hpp"
#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/obstacles/track_memory.hpp"
#include "tight_places.hpp"

#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define SWARM_PLANNER_COUNTS_ALLOCATIONS 1
#else
#define SWARM_PLANNER_COUNTS_ALLOCATIONS 0
#endif

namespace {

/// Calls into the heap by any thread while `counting`.
std::atomic<bool> counting{false};
std::atomic<std::int64_t> calls{0};

void count() {
  if (counting.load(std::memory_order_relaxed)) calls.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

#if SWARM_PLANNER_COUNTS_ALLOCATIONS
// Take the place of the C library's own, which operator new and Eigen call too.
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* memory);

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}
void* calloc(std::size_t number, std::size_t size) {
  count();
  return __libc_calloc(number, size);
}
void* realloc(void* memory, std::size_t size) {
  count();
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}
void free(void* memory) {
  if (memory != nullptr) count();
  __libc_free(memory);
}
}
#endif

namespace swarm_planner {
namespace {

/// Runs `work` and returns how often it called into the heap.
template <class Function>
std::int64_t heapCalls(const Function& work) {
  calls = 0;
  counting = true;
  work();
  counting = false;
  return calls;
}

class NoHeap : public ::testing::Test {
 protected:
  void SetUp() override {
    if (SWARM_PLANNER_COUNTS_ALLOCATIONS == 0) GTEST_SKIP() << "allocations can be counted with glibc only";
  }
};

/// Flies `cycles` cycles and returns how often plan() called into the heap. The first cycle counts too: with several
/// threads any of them may get its first UAV in a later cycle.
std::int64_t heapCallsOfFlight(const Mission& mission, int cycles,
                               const std::function<void(int, Snapshot&)>& tamper = nullptr,
                               const std::function<void(int, SwarmPlanner&)>& command = nullptr,
                               PlanningMode mode = PlanningMode::kIterative) {
  SwarmPlanner planner(mission, mode);
  const double period = mission.parameters.time.cycle_period;
  Snapshot snapshot;
  snapshot.uavs.resize(mission.scenario.uavs.size());
  std::int64_t sum = 0;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    snapshot.now = cycle * period;
    for (std::size_t i = 0; i < snapshot.uavs.size(); ++i) {
      const bool flies = cycle > 0 && planner.report().uavs[i].planned;
      if (cycle == 0) snapshot.uavs[i].p = mission.scenario.uavs[i].start;
      if (flies) {
        const KinematicState x = planner.committed(i).at(snapshot.now);
        snapshot.uavs[i].p = x.p;
        snapshot.uavs[i].v = x.v;
      }
      snapshot.uavs[i].received = true;
      snapshot.uavs[i].stamp = snapshot.now;
    }
    snapshot.obstacles.clear();
    for (const ScenarioObstacle& obstacle : mission.scenario.obstacles) {
      TrackedObstacle track;
      track.shape = makeObstacle(obstacle).movedBy(snapshot.now);
      track.stamp = snapshot.now;
      snapshot.obstacles.push_back(track);
    }
    if (tamper) tamper(cycle, snapshot);
    if (command) command(cycle, planner);
    sum += heapCalls([&] {
      planner.plan(snapshot, snapshot.now + period);
      planner.searchGuides();
    });
  }
  return sum;
}

/// Outside of the test, so that no compiler can see that it is not needed.
std::unique_ptr<std::vector<double>> kept;

// The counter has to count: without this a wrong set-up would pass everything below.
TEST_F(NoHeap, TheCounterCounts) {
  EXPECT_EQ(heapCalls([] {}), 0);
  EXPECT_EQ(heapCalls([] { kept = std::make_unique<std::vector<double>>(1000); }), 2);
  EXPECT_EQ(kept->size(), 1000U);
  EXPECT_EQ(heapCalls([] { kept.reset(); }), 2);
  EXPECT_GT(heapCalls([] { SwarmPlanner planner(makeTestMission({Vector3::Zero()}, {Vector3::UnitX()}, 1.0)); }), 10);
}

TEST_F(NoHeap, FlyingAloneAllocatesNothing) {
  const Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(500, 0, 10)}, 3.0);
  EXPECT_EQ(heapCallsOfFlight(mission, 300), 0);
}

// UAVs that begin apart and come together: more and more of them have to be kept clear of.
TEST_F(NoHeap, UavsThatConvergeAllocateNothing) {
  const Mission mission = makeMission(circleSwap(12, 60.0, 1), {}, "circle_swap");
  EXPECT_EQ(heapCallsOfFlight(mission, 150), 0);
}

TEST_F(NoHeap, TheSwarmAmongMovingObstaclesAllocatesNothing) {
  EXPECT_EQ(heapCallsOfFlight(makeMission(paperSix(), {}, "paper_six"), 350), 0);
}

TEST_F(NoHeap, SeveralThreadsAllocateNothing) {
  const Mission mission = makeMission(paperScaling(16), {{"threads", 3}}, "paper_16");
  EXPECT_EQ(heapCallsOfFlight(mission, 60), 0);
}

TEST_F(NoHeap, FallbacksAllocateNothing) {
  // Odometry comes and goes, tracks grow old, UAVs are blown into each other.
  const auto tamper = [](int cycle, Snapshot& snapshot) {
    if (cycle < 5) return;
    if (cycle % 7 == 0) snapshot.uavs[1].received = false;
    if (cycle % 11 == 0) snapshot.uavs[2].p.x() = std::nan("");
    if (cycle % 13 < 3) snapshot.uavs[3].stamp -= 2.0;
    if (cycle % 17 == 0) snapshot.uavs[4].p = snapshot.uavs[5].p;
    if (cycle % 5 == 0) snapshot.obstacles.clear();
  };
  EXPECT_EQ(heapCallsOfFlight(makeMission(paperSix(), {}, "paper_six"), 300, tamper), 0);
}

// The commands themselves come between cycles and may; what they set off may not.
TEST_F(NoHeap, CarryingOutCommandsAllocatesNothing) {
  Random random(5);
  const auto command = [&random](int cycle, SwarmPlanner& planner) {
    const auto order = kFlightCommands[static_cast<std::size_t>(random.integer(0, 5))];
    for (std::size_t uav = static_cast<std::size_t>(cycle) % 3; uav < planner.uavCount(); uav += 3) {
      if (cycle % 8 == 0) planner.command(uav, order);
    }
  };
  EXPECT_EQ(heapCallsOfFlight(makeMission(circleSwap(12, 8.0, 1), {}, "circle_swap"), 300, nullptr, command), 0);
}

TEST_F(NoHeap, GivingWayAllocatesNothing) { EXPECT_EQ(heapCallsOfFlight(throughTheOpening(6), 150), 0); }

TEST_F(NoHeap, LandingInACrowdAllocatesNothing) {
  const auto command = [](int cycle, SwarmPlanner& planner) {
    for (std::size_t uav = 0; uav < planner.uavCount() && cycle == 8; ++uav) {
      planner.command(uav, FlightCommand::kLand);
    }
  };
  EXPECT_EQ(heapCallsOfFlight(makeMission(circleSwap(12, 8.0, 1), {}, "circle_swap"), 100, nullptr, command), 0);
}

TEST_F(NoHeap, LostAndForeignUavsAllocateNothing) {
  // One goes, frozen where it is not to be, one jumps for good, one belongs to somebody else.
  Scenario scenario = circleSwap(12, 10.0, 1);
  scenario.uavs[3].external = true;
  const auto tamper = [](int cycle, Snapshot& snapshot) {
    if (cycle == 19) snapshot.uavs[1].p.z() += 1.0;
    if (cycle >= 20) snapshot.uavs[1].received = false;
    if (cycle >= 30) snapshot.uavs[2].p.x() += 50.0;
    if (cycle >= 40) snapshot.uavs[3].received = false;
  };
  EXPECT_EQ(heapCallsOfFlight(makeMission(scenario, {}, "circle_swap"), 100, tamper), 0);
}

TEST_F(NoHeap, ObstaclesThatAppearInFlightAllocateNothing) {
  const Mission mission = makeTestMission({Vector3(0, 0, 10)}, {Vector3(200, 0, 10)}, 3.0);
  const auto tamper = [](int cycle, Snapshot& snapshot) {
    for (int i = 0; i < std::min(cycle / 2, 50); ++i) {
      TrackedObstacle track;
      track.shape = Superellipsoid(i, Vector3(4.0 * i, i % 2 == 0 ? 6.0 : -6.0, 10), Vector3::Constant(1.0),
                                   Vector3::Constant(2.0), 0.0, Vector3::Zero());
      track.stamp = snapshot.now;
      snapshot.obstacles.push_back(track);
    }
  };
  EXPECT_EQ(heapCallsOfFlight(mission, 120, tamper), 0);
}

// A wall of boxes with gaps: guides are made, kept, changed and dropped.
TEST_F(NoHeap, FlyingAlongGuidesAllocatesNothing) {
  Mission mission =
      makeTestMission({Vector3(0, -3, 10), Vector3(0, 3, 10)}, {Vector3(60, -3, 10), Vector3(60, 3, 10)}, 3.0);
  for (int i = 0; i < 3; ++i) {
    ScenarioObstacle box;
    box.id = i;
    box.center = Vector3(20 + 10 * i, i == 1 ? 3 : -3, 10);
    box.radii = Vector3(2, 6, 9);
    box.exponents = Vector3::Constant(10.0);
    mission.scenario.obstacles.push_back(box);
  }
  int guided = 0;
  const auto count = [&guided](int, SwarmPlanner& planner) { guided += planner.guide(0) != nullptr ? 1 : 0; };
  EXPECT_EQ(heapCallsOfFlight(mission, 120, nullptr, count), 0);
  EXPECT_GT(guided, 10);
}

TEST_F(NoHeap, RememberingTracksAllocatesNothing) {
  constexpr int kCapacity = 100;
  TrackMemory memory(1.0, kCapacity);
  Random random(2);
  std::size_t most = 0;
  for (int n = 0; n < 300; ++n) {
    std::vector<TrackedObstacle> tracks(static_cast<std::size_t>(random.integer(0, kCapacity)));
    for (TrackedObstacle& track : tracks) {
      track.shape = Superellipsoid(random.integer(1, kCapacity), random.vector(-9.0, 9.0), Vector3::Ones(),
                                   Vector3::Constant(2.0), 0.0, Vector3::Zero());
      track.stamp = 0.3 * n - random.uniform(-0.2, 1.2);
    }
    EXPECT_EQ(heapCalls([&] { memory.update(tracks, 0.3 * n); }), 0);
    most = std::max(most, memory.tracks().size());
  }
  EXPECT_GT(most, 80U);
}

// Twice as many as there is room for, with ids that never come again.
TEST_F(NoHeap, ForgettingTheFarthestTracksAllocatesNothing) {
  constexpr std::size_t kCapacity = 50;
  const std::vector<Vector3> places{Vector3::Zero(), Vector3(5.0, 0.0, 0.0)};
  TrackMemory memory(1.0, kCapacity, places.size());
  Random random(3);
  std::size_t gone = 0;
  for (int n = 0; n < 100; ++n) {
    std::vector<TrackedObstacle> tracks(kCapacity);
    for (std::size_t i = 0; i < kCapacity; ++i) {
      tracks[i].shape = Superellipsoid(1000 * n + static_cast<int>(i), random.vector(-9.0, 9.0), Vector3::Ones(),
                                       Vector3::Constant(2.0), 0.0, Vector3::Zero());
      tracks[i].stamp = 0.1 * n;
    }
    EXPECT_EQ(heapCalls([&] {
                memory.update(tracks, 0.1 * n);
                gone += memory.keepNearest(places);
              }),
              0);
    EXPECT_LE(memory.tracks().size(), kCapacity);
  }
  EXPECT_GT(gone, 1000U);
}

TEST_F(NoHeap, CheckingPlansAllocatesNothing) {
  Random random(1);
  int accepted = 0;
  for (int n = 0; n < 100; ++n) {
    CheckScene scene;
    scene.planRandomly(random, 5.5);
    for (int i = 0; i < 3; ++i) scene.addRandomObstacle(random, random.uniform(0.45, 3.0));
    for (int i = 0; i < 5; ++i) scene.addRandomUav(random, random.uniform(1.1, 3.0));
    bool passed = false;
    EXPECT_EQ(heapCalls([&] { passed = scene.check().accepted(); }), 0);
    accepted += passed ? 1 : 0;
  }
  EXPECT_GT(accepted, 5);
  EXPECT_LT(accepted, 95);
}

TEST_F(NoHeap, PlanningTheSwarmAtOnceAllocatesNothing) {
  EXPECT_EQ(heapCallsOfFlight(makeMission(crossing(), {}, "crossing"), 60, nullptr, nullptr, PlanningMode::kJoint), 0);
  EXPECT_EQ(heapCallsOfFlight(makeMission(paperSix(), {}, "paper_six"), 60, nullptr, nullptr, PlanningMode::kJoint), 0);
  EXPECT_EQ(heapCallsOfFlight(makeMission(circleSwap(16, 10.0, 1), {{"threads", 2}}, "circle_swap"), 30, nullptr,
                              nullptr, PlanningMode::kGroups),
            0);
}

}  // namespace
}  // namespace swarm_planner
