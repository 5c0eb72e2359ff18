// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// A generated solver that compiles but answers wrongly steers a vehicle wrongly: whatever structure is described,
// both methods must find the optimum, from a cold and a warm start.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

#include "solver/generated_program.hpp"
#include "solver/random_description.hpp"
#include "support/random.hpp"
#include "swarm_planner/solver/codegen/generator.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

/// Inputs of the active set, which is exact; and of the interior-point method, whose gap of 1e-9 in the cost leaves
/// sqrt(2 * 1e-9 / 0.5) in the inputs, 0.5 being the random problems' least curvature.
constexpr double kExact = 1e-8, kWithinGap = 6.4e-5;
/// Where hard rows pin the inputs its gap is 1e-12 of that at the start, which is up to 1e7: sqrt(2 * 1e-5 / 0.5).
constexpr double kWithinDigits = 6.4e-3;
constexpr int kSolved = 0, kBadData = 1, kInfeasible = 2;
constexpr int kInteriorPoint = 1;  ///< method

double largestDifference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

std::vector<KnownProblem> makeProblems(const Description& description, int count, const KnownProblemOptions& options,
                                       Random& random) {
  std::vector<KnownProblem> problems;
  for (int i = 0; i < count; ++i) problems.push_back(makeKnownProblem(description, options, random));
  return problems;
}

std::vector<ProblemData> dataOf(const std::vector<KnownProblem>& problems) {
  std::vector<ProblemData> data;
  for (const KnownProblem& problem : problems) data.push_back(problem.data);
  return data;
}

/// Cold, warm and by the interior point.
void expectOptimal(const GeneratedProgram& program, const std::vector<KnownProblem>& problems, double active_set,
                   double interior_point) {
  const auto answers = program.solve(dataOf(problems));
  for (std::size_t i = 0; i < problems.size(); ++i) {
    for (int run = 0; run < 3; ++run) {
      const SolverAnswer& answer = answers[i][static_cast<std::size_t>(run)];
      ASSERT_EQ(answer.status, kSolved) << "problem " << i << ", run " << run << ", " << program.folder();
      EXPECT_LE(largestDifference(answer.u, problems[i].u), run < 2 ? active_set : interior_point)
          << "problem " << i << ", run " << run << ", method " << answer.method << ", iterations " << answer.iterations;
    }
  }
}

TEST(QpCodegen, RandomStructuresReachTheKnownOptimum) {
  Random random(1);
  for (int i = 0; i < 25; ++i) {
    const std::string text = randomDescription(random, i);
    SCOPED_TRACE(text);
    const Description description = parseDescription(text);
    const GeneratedProgram program(description, kQuickBuild);
    expectOptimal(program, makeProblems(description, 40, {}, random), kExact, kWithinGap);
  }
}

TEST(QpCodegen, DuplicateAndOpposedRowsDoNotMislead) {
  Random random(2);
  KnownProblemOptions options;
  options.duplicates = true;
  for (int i = 0; i < 10; ++i) {
    const std::string text = randomDescription(random, i);
    SCOPED_TRACE(text);
    const Description description = parseDescription(text);
    const GeneratedProgram program(description, kQuickBuild);
    expectOptimal(program, makeProblems(description, 40, options, random), kExact, kWithinGap);
  }
}

TEST(QpCodegen, QuadraticTermsTakePartInTheOptimum) {
  Random random(9);
  KnownProblemOptions options;
  options.quadratics = 4;
  for (int i = 0; i < 5; ++i) {
    const std::string text = randomDescription(random, i);
    SCOPED_TRACE(text);
    const Description description = parseDescription(text);
    const GeneratedProgram program(description, kQuickBuild);
    expectOptimal(program, makeProblems(description, 40, options, random), kExact, kWithinGap);
    // Without rows as well: then they are all that the second method has to balance.
    options.active = options.inactive = 0;
    expectOptimal(program, makeProblems(description, 10, options, random), kExact, kWithinGap);
    options.active = 6;
    options.inactive = 20;
  }
}

/// The description with caps that any active set but the smallest meets.
Description withLeastCaps(const std::string& text) {
  return parseDescription(text.substr(0, text.find("limits:")) + "limits: {active: 1, changes: 1}\n");
}

// In flight a cap means that there is no time for more: the second method has to answer whatever the rows are like,
// also where hard ones leave it no interior.
TEST(QpCodegen, TheSecondMethodAnswersWhereTheFirstMeetsItsCap) {
  Random random(8);
  KnownProblemOptions options;
  options.active = 15;
  int second_method = 0;
  for (int i = 0; i < 10; ++i) {
    options.independent = i % 5 == 4;
    const std::string text = randomDescription(random, i);
    SCOPED_TRACE(text);
    const Description description = withLeastCaps(text);
    const GeneratedProgram program(description, kQuickBuild);
    const std::vector<KnownProblem> problems = makeProblems(description, 40, options, random);
    expectOptimal(program, problems, kWithinDigits, kWithinDigits);
    for (const auto& of_problem : program.solve(dataOf(problems))) {
      // The cap allows one change.
      if (of_problem[0].method != kInteriorPoint) {
        EXPECT_LE(of_problem[0].iterations, 1);
      }
      EXPECT_LE(of_problem[0].iterations, 300);
      second_method += of_problem[0].method == kInteriorPoint ? 1 : 0;
    }
  }
  EXPECT_GT(second_method, 300);
}

TEST(QpCodegen, HardRowsThatPinTheInputsAreFollowed) {
  Random random(8);
  KnownProblemOptions options;
  options.active = 15;
  options.independent = false;
  for (int i = 0; i < 10; ++i) {
    const std::string text = randomDescription(random, i);
    SCOPED_TRACE(text);
    const Description description = parseDescription(text);
    const GeneratedProgram program(description, kQuickBuild);
    expectOptimal(program, makeProblems(description, 40, options, random), kExact, kWithinDigits);
  }
}

TEST(QpCodegen, RowsOfAnyScaleAreKept) {
  Random random(3);
  for (const double scale : {1e-6, 1e6}) {
    KnownProblemOptions options;
    options.row_scale = scale;
    for (int i = 0; i < 5; ++i) {
      const std::string text = randomDescription(random, i, scale);
      SCOPED_TRACE(text);
      const Description description = parseDescription(text);
      const GeneratedProgram program(description, kQuickBuild);
      expectOptimal(program, makeProblems(description, 20, options, random), 1e-7, kWithinGap);
    }
  }
}

TEST(QpCodegen, StandsAloneAndPassesTheSanitizers) {
  Random random(4);
  const Description description = parseDescription(randomDescription(random, 0));
  EXPECT_EQ(GeneratedProgram(description, "-O2").undefinedSymbols(), "");
  EXPECT_EQ(GeneratedProgram(description, "-O3 -ffreestanding").undefinedSymbols(), "");
  const GeneratedProgram checked(description, "-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all");
  expectOptimal(checked, makeProblems(description, 20, {}, random), kExact, kWithinGap);
}

// A ground station is not always built with gcc, nor for x86.
TEST(QpCodegen, EveryCompilerTakesTheSourceWithoutAWarning) {
  Random random(10);
  int found = 0;
  for (int i = 0; i < 2; ++i) {
    const GeneratedProgram program(parseDescription(randomDescription(random, i)), kQuickBuild);
    for (const std::string compiler : {"gcc", "clang", "aarch64-linux-gnu-gcc"}) {
      if (std::system(("command -v " + compiler + " >/dev/null").c_str()) != 0) continue;
      ++found;
      EXPECT_EQ(program.undefinedSymbols(compiler + " -O2"), "") << compiler;
    }
  }
  EXPECT_GE(found, 2);
}

TEST(QpCodegen, SameDescriptionSameBytes) {
  Random random(5), again(5);
  const GeneratedCode first = generate(parseDescription(randomDescription(random, 0)));
  const GeneratedCode second = generate(parseDescription(randomDescription(again, 0)));
  EXPECT_EQ(first.header, second.header);
  EXPECT_EQ(first.source, second.source);
}

TEST(QpCodegen, BadDataGetsAStatusAndNoNumbers) {
  Random random(6);
  const Description description = parseDescription(randomDescription(random, 1));
  const GeneratedProgram program(description, "-O2");
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e308}) {
    std::vector<ProblemData> data;
    for (int place = 0; place < 4; ++place) {
      data.push_back(makeKnownProblem(description, {}, random).data);
      ASSERT_FALSE(data.back().rows.empty());
      if (place == 0) data.back().x0[0] = bad;
      if (place == 1) data.back().state_linear.back() = bad;
      if (place == 2) data.back().rows[0].normal[0] = bad;
      if (place == 3) data.back().rows[0].offset = bad;
    }
    for (const auto& of_problem : program.solve(data)) {
      for (const SolverAnswer& answer : of_problem) {
        if (!std::isfinite(bad)) {
          EXPECT_EQ(answer.status, kBadData);
        }
        for (const double u : answer.u) EXPECT_TRUE(std::isfinite(u));
        for (const double x : answer.x) EXPECT_TRUE(std::isfinite(x));
      }
    }
  }
}

TEST(QpCodegen, ContradictingHardRowsAreReported) {
  Random random(7);
  const Description description = parseDescription(randomDescription(random, 1));
  const GeneratedProgram program(description, "-O2");
  ProblemData data = makeKnownProblem(description, {}, random).data;
  ProblemData::Row row = data.rows[0];
  data.rows.clear();
  row.penalty = 0;
  row.offset = 1.0;
  data.rows.push_back(row);
  for (double& n : row.normal) n = -n;
  data.rows.push_back(row);  // n . y >= 1 and -n . y >= 1
  const auto answers = program.solve({data});
  EXPECT_EQ(answers[0][0].status, kInfeasible);
  EXPECT_NE(answers[0][2].status, kSolved);
}

}  // namespace
}  // namespace codegen
}  // namespace swarm_planner
