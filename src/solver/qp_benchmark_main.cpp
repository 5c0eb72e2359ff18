// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
// qp_benchmark FILE.bin [FILE.bin ...] [--method active_set|interior_point] [--tol T] [--json OUT]: times the solver
// generated for the recorded QPs, cold and warm, and checks every solution.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "swarm_planner/solver/instruction_set.hpp"
#include "swarm_planner/solver/recorded_problems.hpp"
#include "swarm_planner/solver/recorded_solver.hpp"

namespace swarm_planner {
namespace {

constexpr int kRounds = 7;  ///< runs of each instance; its time is their median

struct Options {
  std::vector<std::string> files;
  RecordedSolver::Method method = RecordedSolver::Method::kActiveSet;
  double tolerance = 1e-9;  ///< a larger relative error of the objective is a failure
  std::string json;
};

struct Summary {
  double median = 0.0, p99 = 0.0, max = 0.0;
};

struct ModeResult {
  std::string file, mode, method;
  int count = 0;
  Summary microseconds, iterations;
  double worst_relative_error = 0.0, worst_kkt_residual = 0.0;
  int fallbacks = 0, failures = 0;
};

Summary summarise(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto rank = [&](double q) {
    return values[static_cast<std::size_t>(std::lround(q * static_cast<double>(values.size() - 1)))];
  };
  return {rank(0.5), rank(0.99), values.back()};
}

double parseTolerance(const std::string& text) {
  std::istringstream in(text);
  double tolerance = 0.0;
  if (!(in >> tolerance) || in.peek() != std::istringstream::traits_type::eof() || !(tolerance > 0.0)) {
    throw std::invalid_argument("--tol " + text + ": expected a positive number");
  }
  return tolerance;
}

Options parseArguments(int argc, char** argv) {
  Options options;
  for (int i = 1; i < argc; ++i) {
    const std::string argument = argv[i];
    if (argument.rfind("--", 0) != 0) {
      options.files.push_back(argument);
      continue;
    }
    if (i + 1 >= argc) throw std::invalid_argument(argument + ": expected a value");
    const std::string value = argv[++i];
    if (argument == "--json") {
      options.json = value;
    } else if (argument == "--tol") {
      options.tolerance = parseTolerance(value);
    } else if (argument == "--method" && value == "interior_point") {
      options.method = RecordedSolver::Method::kInteriorPoint;
    } else if (argument != "--method" || value != "active_set") {
      throw std::invalid_argument(argument + " " + value + ": unknown");
    }
  }
  if (options.files.empty()) throw std::invalid_argument("expected at least one file");
  return options;
}

/// Median time over the rounds, of data update and solve.
double timeInstance(RecordedSolver& solver, const RecordedProblem& problem, bool warm) {
  std::vector<double> times;
  for (int round = 0; round < kRounds; ++round) {
    const auto begin = std::chrono::steady_clock::now();
    solver.load(problem, warm);
    solver.solve();
    times.push_back(std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count());
  }
  return summarise(times).median;
}

std::unique_ptr<RecordedSolver> makeSolver(const RecordedProblems& file, const std::string& path,
                                           const Options& options) {
  try {
    return std::make_unique<RecordedSolver>(file, options.method, options.tolerance);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(path + ": " + error.what());
  }
}

ModeResult run(const RecordedProblems& file, const std::string& path, bool warm, const Options& options) {
  const auto solver = makeSolver(file, path, options);
  ModeResult result;
  result.file = path;
  result.mode = warm ? "warm" : "cold";
  result.method = options.method == RecordedSolver::Method::kActiveSet ? "active_set" : "interior_point";
  result.count = static_cast<int>(file.problems.size());
  std::vector<double> times, iterations;
  for (const RecordedProblem& problem : file.problems) {
    times.push_back(timeInstance(*solver, problem, warm));
    iterations.push_back(solver->iterations());
    if (!solver->solved()) {
      ++result.failures;
      continue;
    }
    const std::vector<double> input = solver->input();
    const double error =
        std::abs(recordedCost(file, problem, input) - problem.optimal_cost) / (1.0 + std::abs(problem.optimal_cost));
    result.worst_relative_error = std::max(result.worst_relative_error, error);
    const double kkt = recordedKktResidual(file, problem, input, solver->multipliers());
    result.worst_kkt_residual = std::max(result.worst_kkt_residual, kkt);
    if (!(error <= options.tolerance)) ++result.failures;
    if (solver->method() != options.method) ++result.fallbacks;
  }
  result.microseconds = summarise(times);
  result.iterations = summarise(iterations);
  return result;
}

/// A string as JSON writes it, with its quotes.
std::string quoted(const std::string& text) {
  std::ostringstream out;
  out << '"';
  for (const char c : text) {
    if (c == '"' || c == '\\') out << '\\';
    out << c;
  }
  out << '"';
  return out.str();
}

std::string json(const std::vector<ModeResult>& results) {
  std::ostringstream out;
  const auto summary = [&](const Summary& s) {
    out << "{\"median\": " << s.median << ", \"p99\": " << s.p99 << ", \"max\": " << s.max << "}";
  };
  out << "[";
  for (std::size_t i = 0; i < results.size(); ++i) {
    const ModeResult& r = results[i];
    out << (i > 0 ? ",\n " : "\n ") << "{\"file\": " << quoted(r.file) << ", \"mode\": \"" << r.mode
        << "\", \"method\": \"" << r.method << "\", \"count\": " << r.count << ", \"us\": ";
    summary(r.microseconds);
    out << ", \"iterations\": ";
    summary(r.iterations);
    out << ", \"worst_relative_error\": " << r.worst_relative_error
        << ", \"worst_kkt_residual\": " << r.worst_kkt_residual << ", \"fallbacks\": " << r.fallbacks
        << ", \"failures\": " << r.failures << "}";
  }
  out << "\n]\n";
  return out.str();
}

void print(const ModeResult& r) {
  std::cout << r.file << " " << r.mode << " " << r.method << ": median " << r.microseconds.median << " us, p99 "
            << r.microseconds.p99 << ", max " << r.microseconds.max << "; iterations " << r.iterations.median << " / "
            << r.iterations.p99 << " / " << r.iterations.max << "; error " << r.worst_relative_error << ", KKT "
            << r.worst_kkt_residual << "; fallbacks " << r.fallbacks << ", failures " << r.failures << "\n";
}

}  // namespace
}  // namespace swarm_planner

int main(int argc, char** argv) {
  using namespace swarm_planner;
  try {
    const Options options = parseArguments(argc, argv);
    std::vector<ModeResult> results;
    for (const std::string& path : options.files) {
      const RecordedProblems file = readRecordedProblems(path);
      for (const bool warm : {false, true}) {
        results.push_back(run(file, path, warm, options));
        print(results.back());
      }
    }
    if (options.json.empty()) return EXIT_SUCCESS;
    std::ofstream out(options.json);
    out << json(results);
    out.close();
    if (!out) throw std::runtime_error(options.json + ": cannot be written");
  } catch (const std::exception& error) {
    std::cerr << "qp_benchmark: " << error.what() << "\n";
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
