// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Solvers for several copies of a model, compiled as a user would, against the sparse kind on the same problems.
#include <gtest/gtest.h>

#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

#include "solver/compiled_program.hpp"
#include "solver/sparse_program.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

constexpr int kSolved = 0, kCap = 3;
constexpr int kCopies = 3, kHorizon = 10;
/// A gap of 1e-9 of a cost of up to 50 leaves sqrt(2 * 5e-8 / 0.1) in the inputs, 0.1 being their least curvature.
constexpr double kWithinGap = 1e-3;

/// Double integrators with bounded force in a plane; pairs of them are coupled by rows on their places. The axes of a
/// copy are not of one class, and its row's components not aligned with the blocks.
std::string stageText(const std::string& limits, const std::string& copies = "{most: 3, couplings: 40}") {
  return R"(
name: several
horizon: 10
states: 4
inputs: 2
parameters: {dt: 0.2}
dynamics:
  A: {kron: [[[1, dt], [0, 1]], {identity: 2}]}
  B: {kron: [[[dt^2 / 2], [dt]], {identity: 2}]}
cost: {state: {diagonal: [1, 2, 0.1, 0.1]}, terminal: {diagonal: [5, 5, 1, 1]}, input: [[0.1, 0], [0, 0.2]]}
penalties: {wall: {linear: 3, quadratic: 50}}
outputs:
  force: {input: [[0, 1], [1, 0]], bounds: {lower: [-2, -2], upper: [2, 2]}}
  place: {state: [[1, 0, 0, 0], [0, 1, 0, 0]], rows: {most_per_stage: 2, penalty: wall}}
copies: )" +
         copies + "\nlimits: " + limits;
}

const char* const kDriver = R"(#include <stdio.h>
#include <stdlib.h>
#include "NAME.h"
static NAME_tables tables;
static NAME_solver solver;
static double number(void) {
  double value;
  if (fread(&value, sizeof value, 1, stdin) != 1) exit(3);
  return value;
}
static void solve(const NAME_tables* const* all) {
  const double status = NAME_solve_baseline(all, &solver);
  fwrite(&status, sizeof status, 1, stdout);
  for (int k = 0; k < PREFIX_COPIES; ++k) fwrite(solver.copy[k].u, sizeof solver.copy[k].u, 1, stdout);
}
int main(void) {
  const NAME_tables* all[PREFIX_COPIES];
  NAME_parameters parameters;
  NAME_default_parameters_baseline(&parameters);
  if (NAME_setup_baseline(&tables, &parameters, PREFIX_HASH) != PREFIX_SOLVED) return 5;
  NAME_init_baseline(&solver, PREFIX_COPIES);
  for (int k = 0; k < PREFIX_COPIES; ++k) {
    all[k] = &tables;
    NAME_init_copy_baseline(&solver.copy[k], all[k]);
  }
  for (int count = (int)number(); count > 0; --count) {
    for (int k = 0; k < PREFIX_COPIES; ++k) {
      for (int i = 0; i < PREFIX_STATES; ++i) solver.copy[k].x0[i] = number();
      for (int i = 0; i < PREFIX_HORIZON * PREFIX_STATES; ++i) (&solver.copy[k].state_linear[0][0])[i] = number();
      NAME_clear_rows(&solver.copy[k]);
      for (int stage = 1; stage <= PREFIX_HORIZON; ++stage) {
        double n[2];
        n[0] = number();
        n[1] = number();
        if (NAME_add_row(&solver.copy[k], PREFIX_OUTPUT_PLACE, stage, n, number(), PREFIX_PENALTY_WALL) < 0) return 6;
      }
    }
    solver.coupling_count = 0;
    for (int rows = (int)number(); rows > 0; --rows) {
      int copies[2];
      double n[2][2];
      const double* normals[2] = {n[0], n[1]};
      const int stage = (int)number();
      for (int part = 0; part < 2; ++part) {
        copies[part] = (int)number();
        for (int c = 0; c < 2; ++c) n[part][c] = number();
      }
      if (NAME_add_coupling(&solver, PREFIX_OUTPUT_PLACE, stage, copies, normals, number(), PREFIX_PENALTY_WALL) < 0) {
        return 7;
      }
    }
    solver.warm_count = 0;
    solve(all);
    solver.warm_count = solver.active_count;
    for (int i = 0; i < solver.active_count; ++i) {
      solver.warm_id[i] = solver.active_id[i];
      solver.warm_multiplier[i] = solver.multiplier[i];
    }
    solve(all);
  }
  return 0;
}
)";

struct Coupling {
  int stage = 1, copy[2] = {0, 1};
  double normal[2][2] = {{0.0, 0.0}, {0.0, 0.0}};
  double offset = 0.0;
};

struct Problem {
  double x0[kCopies][4] = {};
  double linear[kCopies][kHorizon][4] = {};
  double wall[kCopies][kHorizon][3] = {};  ///< normal and offset
  std::vector<Coupling> couplings;         ///< of each pair one at every stage
};

Problem randomProblem(Random& random) {
  Problem p;
  for (int k = 0; k < kCopies; ++k) {
    for (double& x : p.x0[k]) x = random.uniform(-1.0, 1.0);
    for (auto& stage : p.linear[k]) {
      for (double& q : stage) q = random.uniform(-2.0, 2.0);
    }
    for (auto& row : p.wall[k]) {
      row[0] = random.uniform(-1.0, 1.0);
      row[1] = random.uniform(-1.0, 1.0);
      row[2] = random.uniform(-2.0, 0.5);
    }
  }
  for (int first = 0; first < kCopies; ++first) {
    for (int second = first + 1; second < kCopies; ++second) {
      for (int stage = 1; stage <= kHorizon; ++stage) {
        Coupling c;
        c.stage = stage;
        c.copy[0] = first;
        c.copy[1] = second;
        for (auto& normal : c.normal) {
          for (double& n : normal) n = random.uniform(-1.0, 1.0);
        }
        c.offset = random.uniform(-2.0, 1.0);
        p.couplings.push_back(c);
      }
    }
  }
  return p;
}

std::vector<double> numbersOf(const std::vector<Problem>& problems) {
  std::vector<double> in{static_cast<double>(problems.size())};
  for (const Problem& p : problems) {
    for (int k = 0; k < kCopies; ++k) {
      in.insert(in.end(), p.x0[k], p.x0[k] + 4);
      in.insert(in.end(), &p.linear[k][0][0], &p.linear[k][0][0] + 4 * kHorizon);
      in.insert(in.end(), &p.wall[k][0][0], &p.wall[k][0][0] + 3 * kHorizon);
    }
    in.push_back(static_cast<double>(p.couplings.size()));
    for (const Coupling& c : p.couplings) {
      in.push_back(c.stage);
      for (int part = 0; part < 2; ++part) {
        in.insert(in.end(), {static_cast<double>(c.copy[part]), c.normal[part][0], c.normal[part][1]});
      }
      in.push_back(c.offset);
    }
  }
  return in;
}

/// The same problem with variables [x_1 .. x_N, u_0 .. u_{N-1}] of one copy after the other.
std::string sparseText() {
  constexpr int kCopyVariables = 6 * kHorizon;
  std::ostringstream out;
  out << "name: by_sparsity\nvariables: " << kCopies * kCopyVariables
      << "\nparameters: {dt: 0.2}\npenalties: {wall: {linear: 3, quadratic: 50}}\nlinear: varies\nhessian:\n";
  for (int k = 0; k < kCopies; ++k) {
    const int x = k * kCopyVariables, u = x + 4 * kHorizon, last = u - 4;
    out << "  - {at: [" << x << ", " << x << "], block: {diagonal: [1, 2, 0.1, 0.1]}, repeat: " << kHorizon - 1
        << "}\n  - {at: [" << last << ", " << last << "], block: {diagonal: [5, 5, 1, 1]}}\n  - {at: [" << u << ", "
        << u << "], block: {diagonal: [0.1, 0.2]}, repeat: " << kHorizon << "}\n";
  }
  out << "bounds: {lower: varies, upper: varies}\nequalities:\n";
  for (int k = 0; k < kCopies; ++k) {
    const int x = k * kCopyVariables, u = x + 4 * kHorizon;
    out << "  dynamics_" << k << ":\n    rows: " << 4 * kHorizon
        << "\n    right: varies\n    matrix:\n      - {at: [0, " << x << "], block: {identity: " << 4 * kHorizon
        << "}}\n      - {at: [4, " << x
        << "], block: {kron: [[[-1, -dt], [0, -1]], {identity: 2}]}, repeat: " << kHorizon - 1 << "}\n      - {at: [0, "
        << u << "], block: {kron: [[[-dt^2 / 2], [-dt]], {identity: 2}]}, repeat: " << kHorizon << "}\n";
  }
  out << "inequalities:\n";
  for (int k = 0; k < kCopies; ++k) {
    out << "  wall_" << k << ": {rows: " << kHorizon << ", lower: varies, penalty: wall, matrix: [{at: [0, "
        << k * kCopyVariables << "], size: [1, 2], value: varies, repeat: " << kHorizon << ", step: [1, 4]}]}\n";
  }
  for (int first = 0; first < kCopies; ++first) {
    for (int second = first + 1; second < kCopies; ++second) {
      out << "  pair_" << first << "_" << second << ":\n    rows: " << kHorizon
          << "\n    lower: varies\n    penalty: wall\n    matrix:\n";
      for (const int copy : {first, second}) {
        out << "      - {at: [0, " << copy * kCopyVariables << "], size: [1, 2], value: varies, repeat: " << kHorizon
            << ", step: [1, 4]}\n";
      }
    }
  }
  return out.str();
}

SparseData sparseData(const Problem& p) {
  SparseData s;
  for (int k = 0; k < kCopies; ++k) {
    s.linear.insert(s.linear.end(), &p.linear[k][0][0], &p.linear[k][0][0] + 4 * kHorizon);
    s.linear.insert(s.linear.end(), 2 * kHorizon, 0.0);
    for (int i = 0; i < 6 * kHorizon; ++i) {
      s.lower.push_back(i < 4 * kHorizon ? -kUnbounded : -2.0);
      s.upper.push_back(i < 4 * kHorizon ? kUnbounded : 2.0);
    }
    for (int i = 0; i < 4 * kHorizon; ++i) {
      const double moved = i < 4 ? p.x0[k][i] + (i < 2 ? 0.2 * p.x0[k][i + 2] : 0.0) : 0.0;
      s.row_lower.push_back(moved);
      s.row_penalty.push_back(0);
    }
  }
  for (const auto& walls : p.wall) {
    for (const auto& row : walls) {
      s.matrix.insert(s.matrix.end(), row, row + 2);
      s.row_lower.push_back(row[2]);
      s.row_penalty.push_back(1);
    }
  }
  for (const Coupling& c : p.couplings) {
    for (const auto& normal : c.normal) s.matrix.insert(s.matrix.end(), normal, normal + 2);
    s.row_lower.push_back(c.offset);
    s.row_penalty.push_back(1);
  }
  s.row_upper.assign(s.row_lower.size(), kUnbounded);
  return s;
}

constexpr std::size_t kAnswer = 1 + kCopies * kHorizon * 2;

TEST(QpCodegenCopies, AgreesWithTheSparseKind) {
  Random random(1);
  std::vector<Problem> problems;
  std::vector<SparseData> sparse;
  for (int i = 0; i < 30; ++i) {
    problems.push_back(randomProblem(random));
    sparse.push_back(sparseData(problems.back()));
  }
  const Description description = parseDescription(stageText("{active: 90, changes: 900}"));
  const CompiledProgram program(generate(description), kDriver,
                                "-O1 -g -fsanitize=address,undefined -fno-sanitize-recover=all");
  const std::vector<double> found = program.run(numbersOf(problems));
  const auto expected = SparseProgram(parseSparseDescription(sparseText()), "-O1").solve(sparse);
  ASSERT_EQ(found.size(), 2 * kAnswer * problems.size());
  for (std::size_t i = 0; i < problems.size(); ++i) {
    ASSERT_EQ(expected[i].cold.status, kSolved) << "problem " << i;
    for (std::size_t start = 0; start < 2; ++start) {  // cold, warm
      const double* answer = &found[(2 * i + start) * kAnswer];
      ASSERT_EQ(answer[0], kSolved) << "problem " << i;
      for (std::size_t k = 0; k < kCopies; ++k) {
        for (std::size_t j = 0; j < 2 * kHorizon; ++j) {
          EXPECT_NEAR(answer[1 + k * 2 * kHorizon + j], expected[i].cold.x[k * 6 * kHorizon + 4 * kHorizon + j],
                      kWithinGap)
              << "problem " << i << ", copy " << k << ", input " << j;
        }
      }
    }
  }
}

// There is no second method: the caller has to be told.
TEST(QpCodegenCopies, SaysWhereACapLeavesNoAnswer) {
  Random random(2);
  const std::vector<Problem> problems{randomProblem(random)};
  const Description description = parseDescription(stageText("{active: 2, changes: 3}"));
  const std::vector<double> found = CompiledProgram(generate(description), kDriver, "-O1").run(numbersOf(problems));
  EXPECT_EQ(found[0], kCap);
  for (std::size_t i = 1; i < kAnswer; ++i) EXPECT_EQ(found[i], 0.0);
}

TEST(QpCodegenCopies, StandsAloneForEveryCompiler) {
  const CompiledProgram program(generate(parseDescription(stageText("{active: 20}"))), kDriver, "-O2 -ffreestanding");
  EXPECT_EQ(program.undefinedSymbols(), "");
  for (const std::string compiler : {"gcc", "clang", "aarch64-linux-gnu-gcc"}) {
    if (std::system(("command -v " + compiler + " >/dev/null").c_str()) != 0) continue;
    EXPECT_EQ(program.undefinedSymbols(compiler + " -O2"), "") << compiler;
  }
}

TEST(QpCodegenCopies, FaultsAreListed) {
  try {
    parseDescription(stageText("{active: 5}", "{most: 1, couples: 3}"));
    FAIL() << "not refused";
  } catch (const DescriptionError& error) {
    for (const char* fault : {"copies.most", "copies.couples", "copies.couplings"}) {
      EXPECT_NE(std::string(error.what()).find(fault), std::string::npos) << error.what();
    }
  }
  EXPECT_THROW(parseDescription(stageText("{active: 5, quadratic_terms: 2}")), DescriptionError)
      << "every copy may have its terms active";
}

}  // namespace
}  // namespace codegen
}  // namespace swarm_planner
