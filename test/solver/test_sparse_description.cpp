// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// A fault in a description that is told without its place, or one at a time, takes its writer an afternoon.
#include <gtest/gtest.h>

#include "swarm_planner/solver/codegen/description.hpp"
#include "swarm_planner/solver/codegen/sparse_description.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

TEST(SparseDescription, AllFaultsAreListedWithTheirPlace) {
  const std::string text = R"(
name: faulty
variables: 3
colour: red
parameters: {a: 1}
hessian: [[0, 5, 1], [0, 1, 2], [1, 0, 3], [2, 2, -1], [1, 1, b]]
linear: [1, 2]
bounds: {lower: [0, 0, 4], upper: 3}
equalities: {sum: {rows: 2, matrix: [[0, 0, 1], [0, 0, 2]]}}
inequalities: {cap: {rows: 1, matrix: [[0, 1, 2 * varies]], penalty: none_such}}
limits: {iterations: 0}
)";
  try {
    parseSparseDescription(text);
    FAIL() << "accepted";
  } catch (const DescriptionError& error) {
    const std::string message = error.what();
    for (const char* const part :
         {"colour: unknown key", "hessian[0]: entry (0, 5) lies outside 3 x 3",
          "hessian: entry (1, 0) differs from its mirror image", "hessian: entry (2, 2) is negative",
          "hessian[4][2]: ", "linear: expected 3 numbers, found 2", "bounds: lower[2] exceeds upper[2]",
          "equalities.sum.matrix[1]: entry (0, 0) is given twice", "equalities.sum: row 1 touches no variable",
          "inequalities.cap.matrix[0][2]: `varies` stands alone", "inequalities.cap: needs lower or upper",
          "no penalty is called \"none_such\"", "limits.iterations: expected a whole number from 1"}) {
      EXPECT_NE(message.find(part), std::string::npos) << "missing: " << part << "\nin:\n" << message;
    }
  }
}

}  // namespace
}  // namespace codegen
}  // namespace swarm_planner
