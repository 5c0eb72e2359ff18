// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// Recorded QPs: their files, the solver generated for them, and the program qp_benchmark.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

#include "solver/recorded_file.hpp"
#include "support/temporary_directory.hpp"
#include "swarm_planner/solver/recorded_solver.hpp"

namespace swarm_planner {
namespace {

using Method = RecordedSolver::Method;

constexpr int kProblems = 20;

struct KnownFile {
  RecordedProblems file;
  std::vector<KnownRecordedProblem> known;
};

KnownFile makeFile(int rows, int count = kProblems) {
  Random random(static_cast<std::uint64_t>(1000 + rows));
  KnownFile result;
  result.file.horizon = 20;
  result.file.rows = rows;
  for (int i = 0; i < count; ++i) {
    result.known.push_back(makeRecordedProblem(rows, random));
    result.file.problems.push_back(result.known.back().problem);
  }
  return result;
}

double relativeError(const RecordedProblems& file, const RecordedProblem& problem, const std::vector<double>& input) {
  return std::abs(recordedCost(file, problem, input) - problem.optimal_cost) / (1.0 + std::abs(problem.optimal_cost));
}

double largest(const std::vector<double>& values) { return *std::max_element(values.begin(), values.end()); }

/// A guess that misses every other active row and has some that are not active.
void spoilGuess(RecordedProblem& problem) {
  for (auto* guess : {&problem.warm_half_space, &problem.warm_velocity, &problem.warm_acceleration}) {
    bool keep = false;
    for (float& multiplier : *guess) {
      if (multiplier > 0.0f) multiplier = (keep = !keep) ? multiplier : 0.0f;
    }
    for (std::size_t i = 7; i < guess->size(); i += guess->size() / 4 + 1) (*guess)[i] = 10.0f;
  }
}

class RecordedProblemsOfRows : public ::testing::TestWithParam<int> {
 protected:
  /// Solves every problem and returns the sum of iterations.
  int solveAll(Method method, double tolerance, bool warm) {
    RecordedSolver solver(file_, method, tolerance);
    int iterations = 0;
    for (const RecordedProblem& problem : file_.problems) {
      solver.load(problem, warm);
      solver.solve();
      EXPECT_TRUE(solver.solved());
      EXPECT_EQ(solver.method(), method);
      EXPECT_LE(relativeError(file_, problem, solver.input()), tolerance);
      if (method == Method::kActiveSet) {
        EXPECT_LE(recordedKktResidual(file_, problem, solver.input(), solver.multipliers()), 1e-7);
      }
      iterations += solver.iterations();
    }
    return iterations;
  }

  const KnownFile made_ = makeFile(GetParam());
  RecordedProblems file_ = made_.file;
};

TEST_P(RecordedProblemsOfRows, HaveTheOptimumThatTheyWereMadeFor) {
  int velocity = 0, acceleration = 0, thrust = 0, softened = 0;
  for (const KnownRecordedProblem& known : made_.known) {
    const std::vector<double>& input = known.problem.optimal_input;
    EXPECT_LE(recordedKktResidual(file_, known.problem, input, known.multipliers), 1e-8);
    EXPECT_LE(relativeError(file_, known.problem, input), 1e-12);
    velocity += largest(known.multipliers.velocity) > 0.5 ? 1 : 0;
    acceleration += largest(known.multipliers.acceleration) > 0.5 ? 1 : 0;
    thrust += largest(known.multipliers.thrust) > 0.5 ? 1 : 0;
    softened += known.softened;
  }
  EXPECT_GT(velocity, kProblems / 2);
  EXPECT_GT(acceleration, kProblems / 2);
  EXPECT_EQ(thrust, kProblems);
  EXPECT_EQ(softened, 3 * kProblems);
}

TEST_P(RecordedProblemsOfRows, AreReadAsTheyWereWritten) {
  const TemporaryDirectory directory;
  writeRecordedProblems(directory.file("a.bin"), file_);
  const RecordedProblems read = readRecordedProblems(directory.file("a.bin"));
  EXPECT_EQ(read.horizon, 20);
  EXPECT_EQ(read.rows, GetParam());
  ASSERT_EQ(read.problems.size(), file_.problems.size());
  for (std::size_t i = 0; i < read.problems.size(); ++i) {
    const RecordedProblem &a = read.problems[i], &b = file_.problems[i];
    EXPECT_EQ(a.p0, b.p0);
    EXPECT_EQ(a.v0, b.v0);
    EXPECT_EQ(a.a_previous, b.a_previous);
    EXPECT_EQ(a.p_ref, b.p_ref);
    EXPECT_EQ(a.v_ref, b.v_ref);
    EXPECT_EQ(a.normal, b.normal);
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(a.thrust_normal, b.thrust_normal);
    EXPECT_EQ(a.thrust_offset, b.thrust_offset);
    EXPECT_EQ(a.warm_input, b.warm_input);
    EXPECT_EQ(a.warm_half_space, b.warm_half_space);
    EXPECT_EQ(a.warm_velocity, b.warm_velocity);
    EXPECT_EQ(a.warm_acceleration, b.warm_acceleration);
    EXPECT_EQ(a.warm_thrust, b.warm_thrust);
    EXPECT_EQ(a.optimal_cost, b.optimal_cost);
    EXPECT_EQ(a.optimal_input, b.optimal_input);
  }
}

TEST_P(RecordedProblemsOfRows, ActiveSetFindsTheOptimum) {
  const int cold = solveAll(Method::kActiveSet, 1e-9, false);
  EXPECT_LT(solveAll(Method::kActiveSet, 1e-9, true), cold / 4) << "a guess that is right saves the changes";
  for (RecordedProblem& problem : file_.problems) spoilGuess(problem);
  solveAll(Method::kActiveSet, 1e-9, true);
}

TEST_P(RecordedProblemsOfRows, InteriorPointFindsTheOptimum) {
  solveAll(Method::kInteriorPoint, 1e-6, false);
  solveAll(Method::kInteriorPoint, 1e-6, true);
}

INSTANTIATE_TEST_SUITE_P(Rows, RecordedProblemsOfRows, ::testing::Values(1, 14, 100));

TEST(RecordedKktResidual, SeesEachConditionFail) {
  const KnownFile made = makeFile(2, 1);
  const RecordedProblem& problem = made.file.problems[0];
  const RecordedMultipliers optimum = made.known[0].multipliers;
  const auto residual = [&](const std::vector<double>& input, const RecordedMultipliers& multipliers) {
    return recordedKktResidual(made.file, problem, input, multipliers);
  };
  ASSERT_LE(residual(problem.optimal_input, optimum), 1e-8);
  std::vector<double> input = problem.optimal_input;
  input[30] += 1e-3;
  EXPECT_GT(residual(input, optimum), 1e-4);
  for (const auto changed : {&RecordedMultipliers::half_space, &RecordedMultipliers::velocity,
                             &RecordedMultipliers::acceleration, &RecordedMultipliers::thrust}) {
    for (const double change : {1e-3, -1e-3}) {
      RecordedMultipliers multipliers = optimum;
      auto& values = multipliers.*changed;
      *std::max_element(values.begin(), values.end()) += change;  // of an active row
      EXPECT_GT(residual(problem.optimal_input, multipliers), 1e-6);
      multipliers = optimum;
      *std::min_element(values.begin(), values.end()) += change;  // of a row that is not
      EXPECT_GT(residual(problem.optimal_input, multipliers), 1e-6);
    }
  }
}

/// What reading a file is refused with; empty if it is not.
std::string refusal(const std::string& path) {
  try {
    readRecordedProblems(path);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

class BrokenRecordedFile : public ::testing::Test {
 protected:
  BrokenRecordedFile() { writeRecordedProblems(path_, makeFile(3, 2).file); }

  /// The same file with another number at one of the header's places.
  std::string refusalOfSize(int place, std::int32_t size) {
    std::string content = contentOf(path_);
    content.replace(static_cast<std::size_t>(8 + 4 * place), 4, reinterpret_cast<const char*>(&size), 4);
    return refusalOf(content);
  }
  std::string refusalOf(const std::string& content) {
    std::ofstream(directory_.file("broken.bin"), std::ios::binary) << content;
    return refusal(directory_.file("broken.bin"));
  }

  TemporaryDirectory directory_;
  std::string path_ = directory_.file("a.bin");
  std::string broken_ = directory_.file("broken.bin");
};

TEST_F(BrokenRecordedFile, IsRefusedByItsName) {
  ASSERT_EQ(refusal(path_), "");
  EXPECT_EQ(refusal(directory_.file("none.bin")), directory_.file("none.bin") + ": cannot be read");
  std::string content = contentOf(path_);
  content[7] = '2';
  EXPECT_EQ(refusalOf(content), broken_ + ": expected a QMPCQP01 file");
}

TEST_F(BrokenRecordedFile, IsRefusedWhereverItEnds) {
  const std::string content = contentOf(path_);
  ASSERT_EQ(refusalOf(content), "");
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{8}, std::size_t{23}, std::size_t{24},
                                 content.size() / 2, content.size() - 20, content.size() - 1}) {
    EXPECT_EQ(refusalOf(content.substr(0, size)), broken_ + ": ends too early") << size;
  }
}

TEST_F(BrokenRecordedFile, IsRefusedForItsSizes) {
  constexpr std::int32_t kHuge = std::numeric_limits<std::int32_t>::max();
  for (int place = 0; place < 3; ++place) {
    for (const std::int32_t size : {std::int32_t{-1}, kHuge, std::numeric_limits<std::int32_t>::min()}) {
      EXPECT_EQ(refusalOfSize(place, size), broken_ + ": sizes out of range") << place << " " << size;
    }
  }
  EXPECT_EQ(refusalOfSize(1, 0), broken_ + ": sizes out of range") << "no stages";
  EXPECT_EQ(refusalOfSize(0, 3), broken_ + ": ends too early") << "a problem is missing";
  EXPECT_EQ(refusalOfSize(0, 0), "") << "no problems are not a fault";
}

TEST(RecordedSolver, RefusesOtherSizesThanItsOwn) {
  const auto refused = [](int horizon, int rows) -> std::string {
    RecordedProblems file;
    file.horizon = horizon;
    file.rows = rows;
    try {
      RecordedSolver(file, Method::kActiveSet, 1e-9);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refused(20, 128), "");
  EXPECT_EQ(refused(20, 129), "129 half-spaces per stage: the generated solver has room for 128");
  EXPECT_EQ(refused(19, 14), "horizon 19: the solver is generated for 20");
  EXPECT_EQ(refused(21, 14), "horizon 21: the solver is generated for 20");
}

/// Runs qp_benchmark in a folder of files.
class QpBenchmark : public ::testing::Test {
 protected:
  int run(const std::string& arguments) const {
    const std::string program = QP_BENCHMARK;
    const int status =
        std::system(("cd '" + directory_.file("") + "' && '" + program + "' " + arguments + " > out 2> err").c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  std::string errors() const { return contentOf(directory_.file("err")); }
  YAML::Node report() const { return YAML::LoadFile(directory_.file("report.json")); }

  TemporaryDirectory directory_;
};

std::vector<std::string> keys(const YAML::Node& object) {
  std::vector<std::string> names;
  for (const auto& entry : object) names.push_back(entry.first.as<std::string>());
  return names;
}

void expectOrdered(const YAML::Node& summary, double least) {
  EXPECT_EQ(keys(summary), (std::vector<std::string>{"median", "p99", "max"}));
  EXPECT_GE(summary["median"].as<double>(), least);
  EXPECT_GE(summary["p99"].as<double>(), summary["median"].as<double>());
  EXPECT_GE(summary["max"].as<double>(), summary["p99"].as<double>());
}

void expectFlawless(const YAML::Node& object, const std::string& file, const std::string& mode,
                    const std::string& method, double tolerance) {
  EXPECT_EQ(keys(object),
            (std::vector<std::string>{"file", "mode", "method", "count", "us", "iterations", "worst_relative_error",
                                      "worst_kkt_residual", "fallbacks", "failures"}));
  EXPECT_EQ(object["file"].as<std::string>(), file);
  EXPECT_EQ(object["mode"].as<std::string>(), mode);
  EXPECT_EQ(object["method"].as<std::string>(), method);
  EXPECT_EQ(object["count"].as<int>(), kProblems);
  expectOrdered(object["us"], 1e-3);
  expectOrdered(object["iterations"], 0.0);
  EXPECT_LE(object["worst_relative_error"].as<double>(), tolerance);
  EXPECT_GE(object["worst_kkt_residual"].as<double>(), 0.0);
  EXPECT_EQ(object["fallbacks"].as<int>(), 0);
  EXPECT_EQ(object["failures"].as<int>(), 0);
}

TEST_F(QpBenchmark, ReportsEveryFileColdAndWarm) {
  writeRecordedProblems(directory_.file("a.bin"), makeFile(14).file);
  writeRecordedProblems(directory_.file("b\"\\.bin"), makeFile(2).file);
  ASSERT_EQ(run("a.bin 'b\"\\.bin' --json report.json"), 0) << errors();
  const YAML::Node results = report();
  ASSERT_EQ(results.size(), 4U);
  for (const std::size_t i : {0U, 1U, 2U, 3U}) {
    expectFlawless(results[i], i < 2 ? "a.bin" : "b\"\\.bin", i % 2 == 0 ? "cold" : "warm", "active_set", 1e-9);
    EXPECT_LE(results[i]["worst_kkt_residual"].as<double>(), 1e-7);
  }
  EXPECT_LT(results[1]["iterations"]["median"].as<double>(), results[0]["iterations"]["median"].as<double>());
  EXPECT_EQ(errors(), "");
}

TEST_F(QpBenchmark, TakesMethodAndTolerance) {
  writeRecordedProblems(directory_.file("a.bin"), makeFile(14).file);
  ASSERT_EQ(run("--method interior_point --tol 1e-6 --json report.json a.bin"), 0) << errors();
  const YAML::Node results = report();
  ASSERT_EQ(results.size(), 2U);
  expectFlawless(results[0], "a.bin", "cold", "interior_point", 1e-6);
  expectFlawless(results[1], "a.bin", "warm", "interior_point", 1e-6);
}

TEST_F(QpBenchmark, CountsAWrongOptimumAsFailure) {
  RecordedProblems file = makeFile(14).file;
  file.problems[0].optimal_cost *= 1.0 + 1e-6;
  file.problems[3].optimal_cost = std::numeric_limits<double>::quiet_NaN();
  writeRecordedProblems(directory_.file("a.bin"), file);
  ASSERT_EQ(run("a.bin --json report.json"), 0) << errors();
  const YAML::Node results = report();
  ASSERT_EQ(results.size(), 2U);
  for (const YAML::Node& result : results) {
    EXPECT_EQ(result["failures"].as<int>(), 2);
    EXPECT_NEAR(result["worst_relative_error"].as<double>(), 1e-6, 2e-7);
  }
}

TEST_F(QpBenchmark, RefusesWhatItCannotDo) {
  writeRecordedProblems(directory_.file("a.bin"), makeFile(2, 1).file);
  writeRecordedProblems(directory_.file("many.bin"), makeFile(129, 1).file);
  std::ofstream(directory_.file("empty.bin")) << "";
  const std::pair<std::string, std::string> cases[] = {
      {"", "expected at least one file"},
      {"none.bin", "none.bin: cannot be read"},
      {"empty.bin", "empty.bin: ends too early"},
      {"many.bin", "many.bin: 129 half-spaces per stage: the generated solver has room for 128"},
      {"a.bin --tol", "--tol: expected a value"},
      {"a.bin --tol 1e-6x", "--tol 1e-6x: expected a positive number"},
      {"a.bin --tol 0", "--tol 0: expected a positive number"},
      {"a.bin --method simplex", "--method simplex: unknown"},
      {"a.bin --json none/report.json", "none/report.json: cannot be written"}};
  for (const auto& item : cases) {
    EXPECT_EQ(run(item.first), 1) << item.first;
    EXPECT_EQ(errors(), "qp_benchmark: " + item.second + "\n");
  }
}

}  // namespace
}  // namespace swarm_planner
