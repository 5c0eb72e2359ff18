// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <gtest/gtest.h>

#include "support/random.hpp"
#include "swarm_planner/swarm/neighbour_lists.hpp"
#include "swarm_planner/swarm/solve_order.hpp"

namespace swarm_planner {
namespace {

std::vector<Box> randomBoxes(std::size_t count, double spread, double largest, Random& random) {
  std::vector<Box> boxes(count);
  for (Box& box : boxes) {
    const Vector3 centre = random.vector(-spread, spread);
    const Vector3 half = random.vector(0.0, 0.5 * largest);
    box.include(centre - half);
    box.include(centre + half);
  }
  return boxes;
}

std::vector<std::size_t> overlapping(const std::vector<Box>& boxes, std::size_t box) {
  std::vector<std::size_t> found;
  for (std::size_t other = 0; other < boxes.size(); ++other) {
    if (other != box && boxes[box].near(boxes[other], 0.0)) found.push_back(other);
  }
  return found;
}

std::vector<std::size_t> listed(const NeighbourLists& lists, std::size_t box) {
  return {lists.of(box).begin(), lists.of(box).end()};
}

// A neighbour that is missing here is a UAV that nobody keeps clear of.
TEST(NeighbourLists, HoldExactlyTheOverlappingBoxes) {
  Random random(1);
  NeighbourLists lists;
  for (const double spread : {3.0, 50.0, 1e6}) {
    for (const std::size_t count : {1UL, 2UL, 40UL, 300UL}) {
      const std::vector<Box> boxes = randomBoxes(count, spread, 10.0, random);
      lists.build(boxes);
      ASSERT_EQ(lists.size(), count);
      for (std::size_t box = 0; box < count; ++box) EXPECT_EQ(listed(lists, box), overlapping(boxes, box));
    }
  }
}

TEST(NeighbourLists, LeaveOutEmptyBoxes) {
  std::vector<Box> boxes(3);
  boxes[0].include(Vector3::Zero());
  boxes[2].include(Vector3::Zero());
  NeighbourLists lists;
  lists.build(boxes);
  EXPECT_EQ(listed(lists, 0), std::vector<std::size_t>{2});
  EXPECT_TRUE(listed(lists, 1).empty());
  EXPECT_EQ(listed(lists, 2), std::vector<std::size_t>{0});
}

TEST(NeighbourLists, OfNothingAreEmpty) {
  NeighbourLists lists;
  lists.build({});
  EXPECT_EQ(lists.size(), 0U);
}

// Two neighbours in one round would be planned at once, each without the other's new plan.
TEST(SolveOrder, KeepsNeighboursInTheOrderOfTheirIndices) {
  Random random(2);
  NeighbourLists lists;
  SolveOrder order;
  for (const double spread : {5.0, 40.0, 500.0}) {
    lists.build(randomBoxes(200, spread, 10.0, random));
    order.build(lists, 0);
    std::vector<int> round_of(200, -1);
    for (std::size_t round = 0; round < order.rounds(); ++round) {
      for (std::size_t position = order.roundBegin(round); position < order.roundBegin(round + 1); ++position) {
        EXPECT_EQ(round_of[order.uav(position)], -1) << "planned twice";
        round_of[order.uav(position)] = static_cast<int>(round);
      }
    }
    for (std::size_t uav = 0; uav < 200; ++uav) {
      ASSERT_GE(round_of[uav], 0) << "never planned";
      for (const std::uint32_t other : lists.of(uav)) {
        EXPECT_EQ(other < uav, round_of[other] < round_of[uav]);
        EXPECT_NE(round_of[other], round_of[uav]);
      }
    }
  }
}

/// What each UAV decides from what its neighbours have decided so far: another number for another order.
void decide(const NeighbourLists& lists, std::size_t uav, std::vector<std::uint64_t>& decisions) {
  std::uint64_t decision = uav + 1;
  for (const std::uint32_t other : lists.of(uav)) decision = 31 * decision + decisions[other];
  decisions[uav] = decision;
}

// Whoever had to be skipped for lack of time comes first in the next cycle; the order stays that of an endless round.
TEST(SolveOrder, DecidesAsOneByOneFromAnyFirstUav) {
  constexpr std::size_t kCount = 60;
  Random random(3);
  NeighbourLists lists;
  SolveOrder order;
  std::vector<std::uint64_t> from_first_uav;
  int different = 0;
  for (const double spread : {20.0, 60.0, 200.0}) {
    lists.build(randomBoxes(kCount, spread, 10.0, random));
    for (std::size_t first = 0; first < kCount; ++first) {
      std::vector<std::uint64_t> one_by_one(kCount, 0);
      for (std::size_t turn = 0; turn < kCount; ++turn) decide(lists, (first + turn) % kCount, one_by_one);
      order.build(lists, first);
      ASSERT_EQ(order.uav(0), first);
      std::vector<std::uint64_t> by_rounds(kCount, 0);
      for (std::size_t round = 0; round < order.rounds(); ++round) {
        // Backwards within a round: there the order must not matter.
        for (std::size_t position = order.roundBegin(round + 1); position-- > order.roundBegin(round);) {
          decide(lists, order.uav(position), by_rounds);
          if (position == order.roundBegin(round)) continue;
          ASSERT_LT((order.uav(position - 1) + kCount - first) % kCount,
                    (order.uav(position) + kCount - first) % kCount);
        }
      }
      ASSERT_EQ(by_rounds, one_by_one) << "from UAV " << first;
      if (first == 0) from_first_uav = by_rounds;
      different += by_rounds == from_first_uav ? 0 : 1;
    }
  }
  EXPECT_GT(different, 100) << "the order hardly matters here: this shows nothing";
}

TEST(SolveOrder, TakesOneRoundWhereNobodyMeets) {
  std::vector<Box> boxes(50);
  for (std::size_t i = 0; i < boxes.size(); ++i) boxes[i].include(Vector3(10.0 * static_cast<double>(i), 0.0, 0.0));
  NeighbourLists lists;
  lists.build(boxes);
  SolveOrder order;
  order.build(lists, 0);
  EXPECT_EQ(order.rounds(), 1U);
}

}  // namespace
}  // namespace swarm_planner
