// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// A generated sparse solver that answers wrongly steers several vehicles wrongly: whatever problem is described, it
// must find the optimum, or say that there is none.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <sstream>

#include "solver/generated_program.hpp"
#include "solver/sparse_problem.hpp"
#include "solver/sparse_program.hpp"
#include "support/random.hpp"
#include "swarm_planner/solver/codegen/generator.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

/// Of cost, stationarity, violations and complementarity, relative: ten times the solver's own tolerance.
constexpr double kAccuracy = 1e-8;
constexpr int kSolved = 0, kBadData = 1, kInfeasible = 2, kNotConvex = 4, kNoMinimum = 6;

std::vector<KnownSparseProblem> makeProblems(const SparseDescription& description, int count,
                                             const KnownSparseOptions& options, Random& random) {
  std::vector<KnownSparseProblem> problems;
  for (int i = 0; i < count; ++i) problems.push_back(makeKnownSparseProblem(description, options, random));
  return problems;
}

std::vector<SparseProgram::Answers> solve(const SparseProgram& program,
                                          const std::vector<KnownSparseProblem>& problems) {
  std::vector<SparseData> data;
  for (const KnownSparseProblem& problem : problems) data.push_back(problem.data);
  return program.solve(data);
}

void expectOptimal(const SparseDescription& description, const SparseProgram& program,
                   const std::vector<KnownSparseProblem>& problems, double accuracy) {
  const auto answers = solve(program, problems);
  for (std::size_t i = 0; i < problems.size(); ++i) {
    for (const SparseAnswer* answer : {&answers[i].cold, &answers[i].warm}) {
      const char* const start = answer == &answers[i].cold ? "cold" : "warm";
      ASSERT_EQ(answer->status, kSolved) << "problem " << i << ", " << start << ", " << program.folder();
      EXPECT_LE(optimalityError(description, problems[i], *answer), accuracy) << "problem " << i << ", " << start;
    }
  }
}

/// Solves one problem of a description with the data that it begins with, changed by `change`.
template <typename Change>
SparseAnswer solveOne(const std::string& text, const Change& change) {
  const SparseDescription d = parseSparseDescription(text);
  SparseData data;
  const auto values = [](const std::vector<Datum>& from) {
    std::vector<double> to;
    for (const Datum& datum : from) to.push_back(datum.value.value());
    return to;
  };
  data.linear = values(d.linear);
  data.lower = values(d.lower);
  data.upper = values(d.upper);
  data.row_lower = values(d.row_lower);
  data.row_upper = values(d.row_upper);
  for (const int penalty : d.row_penalty) data.row_penalty.push_back(penalty + 1);
  for (const SparseEntry& e : d.hessian.entries) data.hessian.resize(data.hessian.size() + (e.datum.varies ? 1 : 0));
  for (const SparseEntry& e : d.matrix.entries) data.matrix.resize(data.matrix.size() + (e.datum.varies ? 1 : 0));
  change(data);
  return SparseProgram(d, kQuickBuild).solve({data})[0].cold;
}

SparseAnswer solveOne(const std::string& text) {
  return solveOne(text, [](SparseData&) {});
}

TEST(QpCodegenSparse, RandomProblemsReachTheKnownOptimum) {
  Random random(1);
  for (int i = 0; i < 14; ++i) {
    const std::string text = randomSparseDescription(random, i);
    SCOPED_TRACE(text);
    const SparseDescription description = parseSparseDescription(text);
    const SparseProgram program(description, kQuickBuild);
    expectOptimal(description, program, makeProblems(description, 40, {}, random), kAccuracy);
  }
}

TEST(QpCodegenSparse, SmallProblemsWithManyActiveRowsToo) {
  Random random(2);
  RandomSparseOptions small;
  small.most_variables = 4;
  KnownSparseOptions many;
  many.active = 0.8;
  for (int i = 0; i < 10; ++i) {
    const std::string text = randomSparseDescription(random, i, small);
    SCOPED_TRACE(text);
    const SparseDescription description = parseSparseDescription(text);
    const SparseProgram program(description, kQuickBuild);
    expectOptimal(description, program, makeProblems(description, 40, many, random), kAccuracy);
  }
}

TEST(QpCodegenSparse, DataOfUnequalScaleAreEquilibrated) {
  Random random(3);
  RandomSparseOptions varying;
  varying.varying = true;
  KnownSparseOptions scaled;
  scaled.scales = 1e3;  // entries of H and A from 1e-6 to 1e6
  for (int i = 0; i < 6; ++i) {
    const std::string text = randomSparseDescription(random, i, varying);
    SCOPED_TRACE(text);
    const SparseDescription description = parseSparseDescription(text);
    const SparseProgram program(description, kQuickBuild);
    expectOptimal(description, program, makeProblems(description, 30, scaled, random), 1e-6);
  }
}

TEST(QpCodegenSparse, WarmStartsSaveSteps) {
  Random random(4);
  const SparseDescription description = parseSparseDescription(randomSparseDescription(random, 0));
  const SparseProgram program(description, kQuickBuild);
  int cold = 0, warm = 0;
  for (const auto& answers : solve(program, makeProblems(description, 40, {}, random))) {
    cold += answers.cold.iterations;
    warm += answers.warm.iterations;
  }
  EXPECT_LT(warm, 0.6 * cold);
}

/// The point of the plane n . x = d nearest to c, where rows come twice and opposed, so that no point has room.
TEST(QpCodegenSparse, DuplicateAndOpposedRowsDoNotMislead) {
  const SparseAnswer answer = solveOne(R"(
name: pinned
variables: 3
hessian: [{at: [0, 0], block: {identity: 3}}]
linear: [-1, -2, -3]
inequalities:
  plane: {rows: 1, matrix: [{at: [0, 0], block: [[1, 2, 2]]}], lower: 20}
  again: {rows: 1, matrix: [{at: [0, 0], block: [[1, 2, 2]]}], lower: 20}
  opposed: {rows: 1, matrix: [{at: [0, 0], block: [[-1, -2, -2]]}], lower: -20}
  beyond: {rows: 1, matrix: [{at: [0, 0], block: [[1, 2, 2]]}], upper: 21}
)");
  ASSERT_EQ(answer.status, kSolved);
  const double expected[] = {2.0, 4.0, 5.0};  // c + n (d - n . c) / n . n
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(answer.x[i], expected[i], 1e-7);
}

TEST(QpCodegenSparse, DependentEqualitiesAreFollowed) {
  const SparseAnswer answer = solveOne(R"(
name: dependent
variables: {x: 2, y: 1}
hessian: [[x, x, 1], [x + 1, x + 1, 1]]
linear: {y: 1}
bounds: {lower: {y: -4}}
equalities:
  sum: {rows: 1, matrix: [[0, x, 1], [0, x + 1, 1]], right: 2}
  twice: {rows: 1, matrix: [[0, x, 2], [0, x + 1, 2]], right: 4}
)");
  ASSERT_EQ(answer.status, kSolved);
  EXPECT_NEAR(answer.x[0], 1.0, 1e-8);
  EXPECT_NEAR(answer.x[1], 1.0, 1e-8);
  EXPECT_NEAR(answer.x[2], -4.0, 1e-7);
  EXPECT_NEAR(answer.bound_multiplier[2], 1.0, 1e-7);
}

/// A gap of 1e-9 of a cost of up to 50 leaves sqrt(2 * 5e-8 / 0.1) in the inputs, 0.1 being their least curvature.
constexpr double kWithinGap = 1e-3;

/// A double integrator with bounded force that must keep to one side of a wall.
class StageStructured {
 public:
  static constexpr int kHorizon = 12;

  static std::string stageText() {
    return R"(
name: by_stages
horizon: 12
states: 2
inputs: 1
dynamics: {A: [[1, 0.2], [0, 1]], B: [[0.02], [0.2]]}
cost: {state: {diagonal: [1, 0.1]}, terminal: {diagonal: [5, 1]}, input: [[0.1]], input_linear: true}
penalties: {wall: {linear: 3, quadratic: 50}}
outputs:
  force: {input: [[1]], bounds: {lower: [-2], upper: [2]}}
  place: {state: [[1, 0]], rows: {most_per_stage: 1, penalty: wall}}
)";
  }

  /// The same with the variables x_1, ..., x_N (two each) and u_0, ..., u_{N-1}.
  static std::string sparseText() {
    return R"(
name: by_sparsity
variables: {x: 24, u: 12}
hessian:
  - {at: [x, x], block: {diagonal: [1, 0.1]}, repeat: 11}
  - {at: [x + 22, x + 22], block: {diagonal: [5, 1]}}
  - {at: [u, u], size: [12, 12], diagonals: {0: 0.1}}
linear: varies
bounds: {lower: {u: -2}, upper: {u: 2}}
penalties: {wall: {linear: 3, quadratic: 50}}
equalities:
  dynamics:
    rows: 24
    matrix:
      - {at: [0, x], block: {identity: 24}}
      - {at: [2, x], block: [[-1, -0.2], [0, -1]], repeat: 11}
      - {at: [0, u], block: [[-0.02], [-0.2]], repeat: 12}
    right: varies
inequalities:
  wall: {rows: 12, matrix: [{at: [0, x], block: [[1, 0]], repeat: 12}], lower: varies, penalty: wall}
)";
  }
};

TEST(QpCodegenSparse, AgreesWithTheKindWithStages) {
  const Description by_stages = parseDescription(StageStructured::stageText());
  const SparseDescription by_sparsity = parseSparseDescription(StageStructured::sparseText());
  Random random(5);
  constexpr int kHorizon = StageStructured::kHorizon;
  std::vector<ProblemData> stage_problems;
  std::vector<SparseData> sparse_problems;
  for (int i = 0; i < 20; ++i) {
    ProblemData p;
    p.x0 = {random.uniform(-3.0, 3.0), random.uniform(-1.0, 1.0)};
    p.u_previous = {0.0};
    SparseData s;
    for (int k = 0; k < 2 * kHorizon; ++k) p.state_linear.push_back(random.uniform(-2.0, 2.0));
    for (int k = 0; k < kHorizon; ++k) p.input_linear.push_back(random.uniform(-0.2, 0.2));
    s.linear = p.state_linear;
    s.linear.insert(s.linear.end(), p.input_linear.begin(), p.input_linear.end());
    s.lower.assign(3 * kHorizon, -kUnbounded);
    s.upper.assign(3 * kHorizon, kUnbounded);
    std::fill(s.lower.begin() + 2 * kHorizon, s.lower.end(), -2.0);
    std::fill(s.upper.begin() + 2 * kHorizon, s.upper.end(), 2.0);
    s.row_lower.assign(2 * kHorizon, 0.0);
    s.row_lower[0] = p.x0[0] + 0.2 * p.x0[1];
    s.row_lower[1] = p.x0[1];
    for (int k = 1; k <= kHorizon; ++k) {
      p.rows.push_back({1, k, 1, {1.0}, random.uniform(-1.0, 1.0)});
      s.row_lower.push_back(p.rows.back().offset);
    }
    s.row_upper.assign(3 * kHorizon, kUnbounded);
    s.row_penalty.assign(2 * kHorizon, 0);
    s.row_penalty.resize(3 * kHorizon, 1);
    stage_problems.push_back(p);
    sparse_problems.push_back(s);
  }
  const auto expected = GeneratedProgram(by_stages, kQuickBuild).solve(stage_problems);
  const auto found = SparseProgram(by_sparsity, kQuickBuild).solve(sparse_problems);
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(expected[i][0].status, kSolved);
    ASSERT_EQ(found[i].cold.status, kSolved);
    for (std::size_t k = 0; k < kHorizon; ++k) {
      EXPECT_NEAR(found[i].cold.x[2 * kHorizon + k], expected[i][0].u[k], kWithinGap)
          << "problem " << i << ", input " << k;
    }
  }
}

/// Variables of `uavs` vehicles at `stages` stages, [p v a j] each: dynamics of each vehicle, half-spaces for each, and
/// a row per stage for each pair.
std::string jointText(int uavs, int stages) {
  std::ostringstream out;
  out << "name: joint\nvariables: " << 12 * uavs * stages
      << "\nparameters: {dt: 0.3}\nhessian:\n  - {at: [0, 0], block: {diagonal: [1, 1, 1, 0.1, 0.1, 0.1, 0, 0, 0, 0.2, "
         "0.2, 0.2]}, repeat: "
      << uavs * stages << "}\nlinear: varies\nbounds: {lower: varies, upper: varies}\n"
      << "penalties: {slack: {linear: 50, quadratic: 100}}\nequalities:\n";
  for (int v = 0; v < uavs; ++v) {
    const int first = 12 * stages * v;
    out << "  dynamics_" << v << ":\n    rows: " << 9 * stages << "\n    right: varies\n    matrix:\n      - {at: [0, "
        << first << "], block: {identity: 9}, repeat: " << stages << ", step: [9, 12]}\n      - {at: [0, " << first + 9
        << "], block: {kron: [[[-dt^3 / 6], [-dt^2 / 2], [-dt]], {identity: 3}]}, repeat: " << stages
        << ", step: [9, 12]}\n      - {at: [9, " << first
        << "], block: {kron: [[[-1, -dt, -dt^2 / 2], [0, -1, -dt], [0, 0, -1]], {identity: 3}]}, repeat: " << stages - 1
        << ", step: [9, 12]}\n";
  }
  out << "inequalities:\n";
  for (int v = 0; v < uavs; ++v) {
    out << "  half_spaces_" << v << ":\n    rows: " << 6 * stages
        << "\n    lower: varies\n    penalty: slack\n    matrix: [{at: [0, " << 12 * stages * v
        << "], size: [6, 3], value: varies, repeat: " << stages << ", step: [6, 12]}]\n";
    for (int w = 0; w < v; ++w) {
      out << "  pair_" << v << "_" << w << ":\n    rows: " << stages
          << "\n    lower: varies\n    penalty: slack\n    matrix:\n";
      for (const int one : {v, w}) {
        out << "      - {at: [0, " << 12 * stages * one << "], size: [1, 3], value: varies, repeat: " << stages
            << ", step: [1, 12]}\n";
      }
    }
  }
  return out.str();
}

TEST(QpCodegenSparse, AJointProblemCompilesAndIsSolved) {
  Random random(6);
  const SparseDescription description = parseSparseDescription(jointText(6, 20));
  const SparseStructure structure = analyse(description);
  EXPECT_LT(structure.factor.entries(), structure.natural_entries / 4);
  EXPECT_LT(structure.factor.operations(), structure.natural_operations / 5);
  const SparseProgram program(description, kQuickBuild);
  KnownSparseOptions options;
  options.independent = false;
  options.active = 0.05;
  expectOptimal(description, program, makeProblems(description, 2, options, random), kAccuracy);
}

TEST(QpCodegenSparse, MinimumDegreeLeavesAnArrowWithoutFill) {
  constexpr int kSize = 30;
  Graph arrow(kSize);
  for (int i = 1; i < kSize; ++i) {
    arrow[0].push_back(i);
    arrow[static_cast<std::size_t>(i)].push_back(0);
  }
  std::vector<int> natural(kSize);
  for (int i = 0; i < kSize; ++i) natural[static_cast<std::size_t>(i)] = i;
  EXPECT_EQ(factorSymbolically(arrow, natural).entries(), kSize * (kSize - 1) / 2);
  const std::vector<int> order = minimumDegreeOrder(arrow, std::vector<bool>(kSize, true));
  EXPECT_EQ(factorSymbolically(arrow, order).entries(), kSize - 1);
}

TEST(QpCodegenSparse, ContradictionsAreReported) {
  const std::string head =
      "name: contradiction\nvariables: 2\nhessian: [{at: [0, 0], block: {identity: 2}}]\n"
      "penalties: {soft: {linear: 1, quadratic: 1}}\n";
  const std::string sum = "rows: 1, matrix: [[0, 0, 1], [0, 1, 1]], ";
  EXPECT_EQ(solveOne(head + "inequalities: {a: {" + sum + "lower: 1}, b: {" + sum + "upper: 0.5}}").status,
            kInfeasible);
  EXPECT_EQ(solveOne(head + "equalities: {a: {" + sum + "right: 1}, b: {" + sum + "right: 2}}").status, kInfeasible);
  EXPECT_EQ(solveOne(head + "bounds: {lower: 1}\ninequalities: {b: {" + sum + "upper: 1.5}}").status, kInfeasible);
  EXPECT_EQ(solveOne(head + "bounds: {lower: varies, upper: varies}",
                     [](SparseData& data) { data.lower[1] = 1.0, data.upper[1] = 0.0; })
                .status,
            kInfeasible);
  // The same is no contradiction where one side gives way.
  EXPECT_EQ(
      solveOne(head + "inequalities: {a: {" + sum + "lower: 1}, b: {" + sum + "upper: 0.5, penalty: soft}}").status,
      kSolved);
}

TEST(QpCodegenSparse, CostsWithoutMinimumAreReported) {
  const std::string head = "name: falling\nvariables: 2\nlinear: [-1, 1]\n";
  EXPECT_EQ(solveOne(head).status, kNoMinimum);
  EXPECT_EQ(solveOne(head + "hessian: [[1, 1, 1]]\nbounds: {lower: 0}").status, kNoMinimum);
  const SparseAnswer bounded = solveOne(head + "hessian: [[1, 1, 1]]\nbounds: {lower: 0, upper: [3, none]}");
  ASSERT_EQ(bounded.status, kSolved);
  EXPECT_NEAR(bounded.x[0], 3.0, 1e-8);
  EXPECT_NEAR(bounded.x[1], 0.0, 1e-8);
}

TEST(QpCodegenSparse, CurvatureOfTheWrongSignIsReported) {
  const std::string text =
      "name: saddle\nvariables: 2\nhessian: [[0, 0, varies], [1, 0, varies], [1, 1, varies]]\n"
      "linear: [1, 1]\n";
  const auto with = [&](double h00, double h10, double h11) {
    return solveOne(text, [=](SparseData& data) { data.hessian = {h00, h10, h11}; }).status;
  };
  EXPECT_EQ(with(1.0, 0.5, 1.0), kSolved);
  EXPECT_EQ(with(1.0, 1.0, 1.0), kSolved);  // semidefinite
  EXPECT_EQ(with(1.0, 2.0, 1.0), kNotConvex);
  EXPECT_EQ(with(-1.0, 0.0, 1.0), kNotConvex);
}

TEST(QpCodegenSparse, BadDataGetsAStatusAndNoNumbers) {
  Random random(7);
  RandomSparseOptions varying;
  varying.varying = true;
  SparseDescription d;
  for (int i = 0; d.equalities == 0 || d.rows() == d.equalities; ++i) {
    d = parseSparseDescription(randomSparseDescription(random, i, varying));
  }
  const SparseProgram program(d, "-O2");
  for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e308}) {
    std::vector<SparseData> data;
    for (int place = 0; place < 4; ++place) {
      data.push_back(makeKnownSparseProblem(d, {}, random).data);
      if (place == 0) data.back().linear[0] = bad;
      if (place == 1) data.back().row_lower[0] = bad;  // of an equality
      if (place == 2) data.back().hessian[0] = bad;
      if (place == 3) data.back().matrix.back() = bad;
    }
    for (const auto& answers : program.solve(data)) {
      for (const SparseAnswer* answer : {&answers.cold, &answers.warm}) {
        if (!std::isfinite(bad)) {
          EXPECT_EQ(answer->status, kBadData);
        }
        for (const auto* numbers : {&answer->x, &answer->row_multiplier, &answer->bound_multiplier}) {
          for (const double number : *numbers) EXPECT_TRUE(std::isfinite(number));
        }
      }
    }
  }
}

TEST(QpCodegenSparse, StandsAloneAndPassesTheSanitizers) {
  Random random(8);
  const SparseDescription description = parseSparseDescription(randomSparseDescription(random, 0));
  EXPECT_EQ(SparseProgram(description, "-O2").undefinedSymbols(), "");
  EXPECT_EQ(SparseProgram(description, "-O3 -ffreestanding -fno-stack-protector").undefinedSymbols(), "");
  const SparseProgram checked(description, "-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all");
  expectOptimal(description, checked, makeProblems(description, 20, {}, random), kAccuracy);
}

TEST(QpCodegenSparse, SameDescriptionSameBytes) {
  Random random(9), again(9);
  const GeneratedCode first = generateFromText(randomSparseDescription(random, 0));
  const GeneratedCode second = generateFromText(randomSparseDescription(again, 0));
  EXPECT_EQ(first.header, second.header);
  EXPECT_EQ(first.source, second.source);
}

/// The shipped example: supply is bought where it is cheaper, up to what the three pipes from there on can carry.
TEST(QpCodegenSparse, TheExampleIsSolved) {
  const std::string text = readText("config/solver/example_network.yaml");
  const auto demand = [](double each) {
    return [each](SparseData& data) {
      data.linear[9] = 1.0;
      data.linear[10] = 2.0;
      data.matrix = {1.0, 1.0};
      for (std::size_t row = 2; row < 6; ++row) data.row_lower[row] = each;
    };
  };
  const SparseAnswer met = solveOne(text, demand(2.0));
  ASSERT_EQ(met.status, kSolved);
  EXPECT_NEAR(met.x[9] + met.x[10], 8.0, 1e-6);
  EXPECT_GT(met.x[9], met.x[10]);
  const SparseAnswer short_of_water = solveOne(text, demand(9.0));
  ASSERT_EQ(short_of_water.status, kSolved);
  EXPECT_NEAR(short_of_water.x[9] + short_of_water.x[10], 24.0, 1e-6);
}

}  // namespace
}  // namespace codegen
}  // namespace swarm_planner
