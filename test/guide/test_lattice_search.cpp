// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// Ways round hand-made obstacles. If these fail, UAVs are led into obstacles, the long way round, or nowhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

#include "guide_scene.hpp"
#include "support/random.hpp"

namespace swarm_planner {
namespace {

const Workspace kHall = roomOf(Vector3(-20, -30, 0), Vector3(60, 30, 20));

TEST(LatticeSearch, GoesStraightWhereNothingIsInTheWay) {
  SearchScene scene(kHall);
  ASSERT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 4, 12), 1.0), SearchOutcome::kFound);
  EXPECT_EQ(scene.path().count, 2U);
  EXPECT_EQ(scene.expansions(), 1);
}

TEST(LatticeSearch, GoesRoundABoxMetHeadOnByTheRight) {
  SearchScene scene(kHall);
  scene.add(bodyOf(Vector3(15, 0, 10), Vector3(3, 5, 30), 10.0));
  ASSERT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.5), SearchOutcome::kFound);
  EXPECT_GT(scene.leastClearance(), -1e-3);
  EXPECT_LT(scene.path().points[1].y(), 0.0) << "of two ways that are as long, the right one";
  // Round the corners of a box that is larger by the distance.
  const double shortest = 2.0 * std::hypot(15.0 - 3.36, 5.36) + 6.72;
  EXPECT_LT(scene.path().length(), 1.02 * shortest);
}

TEST(LatticeSearch, GoesOverAWallThatIsWideAndUnderOneThatHangs) {
  SearchScene over(kHall);
  over.add(bodyOf(Vector3(15, 0, 0), Vector3(1, 28, 12), 10.0));
  ASSERT_EQ(over.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.0), SearchOutcome::kFound);
  EXPECT_GT(over.leastClearance(), -1e-3);
  EXPECT_GT(over.path().points[1].z(), 12.0);
  EXPECT_NEAR(over.path().points[1].y(), 0.0, 1.0);

  SearchScene under(kHall);
  under.add(bodyOf(Vector3(15, 0, 20), Vector3(1, 28, 12), 10.0));
  ASSERT_EQ(under.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.0), SearchOutcome::kFound);
  EXPECT_LT(under.path().points[1].z(), 8.0);
}

TEST(LatticeSearch, BacksOutOfADeadEnd) {
  SearchScene scene(kHall);
  scene.add(bodyOf(Vector3(20, 0, 10), Vector3(1, 8, 30), 10.0));
  scene.add(bodyOf(Vector3(12, 7, 10), Vector3(8, 1, 30), 10.0));
  scene.add(bodyOf(Vector3(12, -7, 10), Vector3(8, 1, 30), 10.0));
  ASSERT_EQ(scene.search(Vector3(17, 0, 10), Vector3(30, 0, 10), 1.0), SearchOutcome::kFound);
  EXPECT_GT(scene.leastClearance(), -1e-3);
  double least_x = 17.0;
  for (std::size_t i = 0; i < scene.path().count; ++i) least_x = std::min(least_x, scene.path().points[i].x());
  EXPECT_LT(least_x, 4.0);
}

TEST(LatticeSearch, PassesBehindWhatMovesAcross) {
  // In the middle of the way when the UAV would be there, on its way to positive y.
  SearchScene scene(roomOf(Vector3(-20, -30, 9), Vector3(60, 30, 11)));
  scene.add(bodyOf(Vector3(15, -10, 10), Vector3(3, 3, 3), 4.0, Vector3(0, 2, 0)));
  ASSERT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.0), SearchOutcome::kFound);
  EXPECT_GT(scene.leastClearance(), -1e-3);
  EXPECT_LT(scene.path().points[1].y(), 0.0);
  // Standing where it begins it is in nobody's way.
  SearchScene still(kHall);
  still.add(bodyOf(Vector3(15, -10, 10), Vector3(3, 3, 3), 4.0));
  ASSERT_EQ(still.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.0), SearchOutcome::kFound);
  EXPECT_EQ(still.path().count, 2U);
}

TEST(LatticeSearch, KeepsToTheWorkspaceAndSaysWhereThereIsNoWay) {
  const Workspace corridor = roomOf(Vector3(-5, -4, 8), Vector3(40, 9, 12));
  SearchScene scene(corridor);
  scene.add(bodyOf(Vector3(15, -1, 10), Vector3(2, 5, 10), 10.0));
  ASSERT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 0.7), SearchOutcome::kFound);
  EXPECT_GT(scene.path().points[1].y(), 4.0) << "the right is closed";
  EXPECT_GT(scene.leastClearance(), -1e-3);
  scene.add(bodyOf(Vector3(15, 7, 10), Vector3(2, 3, 10), 10.0));
  EXPECT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 0.7), SearchOutcome::kNoWay);
  EXPECT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 0.7, 20), SearchOutcome::kBudgetSpent);
}

TEST(LatticeSearch, TakesTheSideThatOthersLeaveFree) {
  SearchScene scene(kHall);
  scene.add(bodyOf(Vector3(15, 0, 10), Vector3(3, 5, 30), 10.0));
  PlannedFlight other;
  for (std::size_t k = 0; k < PlannedFlight::kPoints; ++k) {
    other.points[k] = Vector3(10.0 + static_cast<double>(k), -5.5, 10);
    other.box.include(other.points[k]);
  }
  scene.traffic().add(other);
  ASSERT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.5), SearchOutcome::kFound);
  EXPECT_GT(scene.path().points[1].y(), 0.0) << "another one flies round the right";
}

/// Length of the shortest way on a fine grid at z = 10 with 32 directions, infinite if there is none: Dijkstra.
double shortestOnGrid(const FreeSpace& space, const Vector3& start, const Vector3& goal) {
  constexpr int kColumns = 81, kRows = 61;
  constexpr double kCell = 0.5;
  const Vector3 origin = start - kCell * Vector3(20, 30, 0);
  const auto at = [&](int i) { return Vector3(origin + kCell * Vector3(i % kColumns, i / kColumns, 0)); };
  std::vector<double> best(kColumns * kRows, std::numeric_limits<double>::infinity());
  std::priority_queue<std::pair<double, int>, std::vector<std::pair<double, int>>, std::greater<>> open;
  best[30 * kColumns + 20] = 0.0;
  open.push({0.0, 30 * kColumns + 20});
  while (!open.empty()) {
    const auto [cost, i] = open.top();
    open.pop();
    if (cost > best[static_cast<std::size_t>(i)]) continue;
    if ((at(i) - goal).norm() < 1e-6) return cost;
    for (int dx = -3; dx <= 3; ++dx) {
      for (int dy = -3; dy <= 3; ++dy) {
        const int x = i % kColumns + dx, y = i / kColumns + dy;
        if (x < 0 || y < 0 || x >= kColumns || y >= kRows) continue;
        const auto j = static_cast<std::size_t>(y * kColumns + x);
        const double next = cost + kCell * std::hypot(dx, dy);
        if (next >= best[j] || !space.isClear({at(i), 0.0}, {at(static_cast<int>(j)), 0.0})) continue;
        best[j] = next;
        open.push({next, static_cast<int>(j)});
      }
    }
  }
  return std::numeric_limits<double>::infinity();
}

// Property: as short as the shortest way on a grid four times as fine, which has 32 directions, to within three per
// cent.
TEST(LatticeSearch, IsHardlyLongerThanTheShortestWay) {
  Random random(7);
  int detours = 0;
  for (int n = 0; n < 12; ++n) {
    SearchScene scene(roomOf(Vector3(-10, -15, 9.99), Vector3(30, 15, 10.01)));
    for (int i = 0; i < 8; ++i) {
      const Vector3 center(random.uniform(3, 17), random.uniform(-7, 7), 10);
      scene.add(bodyOf(center, Vector3(random.uniform(0.5, 2.5), random.uniform(0.5, 2.5), 9), random.uniform(2, 10)));
    }
    const Vector3 start(0, 0, 10), goal(20, 0, 10);
    if (scene.space().clearance({start, 0.0}) < 0.0 || scene.space().clearance({goal, 0.0}) < 0.0) continue;
    const double shortest = shortestOnGrid(scene.space(), start, goal);
    const SearchOutcome outcome = scene.search(start, goal, 0.5);
    ASSERT_EQ(outcome == SearchOutcome::kFound, std::isfinite(shortest)) << n;
    if (outcome != SearchOutcome::kFound) continue;
    EXPECT_GT(scene.leastClearance(), -1e-3) << n;
    EXPECT_LT(scene.path().length(), 1.03 * shortest) << n;
    if (shortest > 20.5) ++detours;
  }
  EXPECT_GT(detours, 4) << "nothing was in the way: this shows nothing";
}

TEST(LatticeSearch, GivesTheSameWayAgain) {
  SearchScene scene(kHall);
  scene.add(bodyOf(Vector3(15, 1, 10), Vector3(3, 5, 30), 3.3));
  ASSERT_EQ(scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.5), SearchOutcome::kFound);
  const GuidePath first = scene.path();
  scene.search(Vector3(0, 5, 10), Vector3(30, 0, 10), 0.9);
  scene.search(Vector3(0, 0, 10), Vector3(30, 0, 10), 1.5);
  ASSERT_EQ(scene.path().count, first.count);
  for (std::size_t i = 0; i < first.count; ++i) EXPECT_EQ(scene.path().points[i], first.points[i]);
}

}  // namespace
}  // namespace swarm_planner
