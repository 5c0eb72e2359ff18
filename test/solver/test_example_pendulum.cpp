// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// The description that is not a quadrotor's: coupled states, bounds, a rate cost. Its solver has to hold the pendulum
// up.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "example_pendulum.h"

namespace swarm_planner {
namespace {

class ExamplePendulum : public ::testing::Test {
 protected:
  ExamplePendulum() : tables_(new example_pendulum_tables), solver_(new example_pendulum_solver) {
    example_pendulum_default_parameters_baseline(&parameters_);
    setup_ = example_pendulum_setup_baseline(tables_.get(), &parameters_, EXAMPLE_PENDULUM_HASH);
    example_pendulum_init_baseline(solver_.get(), tables_.get());
    solver_->tolerance = 1e-10;
  }

  double solve(int method) {
    solver_->wanted_method = method;
    EXPECT_EQ(example_pendulum_solve_baseline(tables_.get(), solver_.get()), EXAMPLE_PENDULUM_SOLVED);
    EXPECT_EQ(solver_->method, method);
    return solver_->u[0][0];
  }

  /// A stage of the cart and pendulum, by the equations rather than the solver's matrices.
  void move(double force) {
    double* x = solver_->x0;
    const double dt = parameters_.dt;
    const double cart = -0.1 * x[1] - 0.98 * x[2] + force, angle = 0.2 * x[1] + 21.6 * x[2] - 2.0 * force;
    x[0] += dt * x[1];
    x[2] += dt * x[3];
    x[1] += dt * cart;
    x[3] += dt * angle;
    solver_->u_previous[0] = force;
  }

  example_pendulum_parameters parameters_{};
  std::unique_ptr<example_pendulum_tables> tables_;
  std::unique_ptr<example_pendulum_solver> solver_;
  int setup_ = -1;
};

TEST_F(ExamplePendulum, StaysUprightWithinItsForce) {
  ASSERT_EQ(setup_, EXAMPLE_PENDULUM_SOLVED);
  solver_->x0[0] = 0.5;
  solver_->x0[2] = 0.3;
  double largest_force = 0.0;
  for (int step = 0; step < 200; ++step) {
    const double exact = solve(EXAMPLE_PENDULUM_ACTIVE_SET);
    // A gap of 1e-10 at an input weight of 0.01 leaves sqrt(2e-10 / 0.01).
    EXPECT_NEAR(solve(EXAMPLE_PENDULUM_INTERIOR_POINT), exact, 1.5e-4) << "step " << step;
    largest_force = std::max(largest_force, std::abs(exact));
    move(exact);
    ASSERT_LT(std::abs(solver_->x0[2]), 0.5) << "step " << step;
  }
  EXPECT_LE(largest_force, 8.0 + 1e-9);
  EXPECT_GT(largest_force, 7.9) << "the bound is meant to be met";
  for (const double state : solver_->x0) EXPECT_NEAR(state, 0.0, 1e-2);
}

// What the test above must be able to see: without force the pendulum falls.
TEST_F(ExamplePendulum, FallsWithoutForce) {
  solver_->x0[2] = 0.3;
  for (int step = 0; step < 20; ++step) move(0.0);
  EXPECT_GT(std::abs(solver_->x0[2]), 0.5);
}

}  // namespace
}  // namespace swarm_planner
