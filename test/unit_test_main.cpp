// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Entry point of every unit test that has none of its own: not every distribution's catkin offers gtest's.
#include <gtest/gtest.h>

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
