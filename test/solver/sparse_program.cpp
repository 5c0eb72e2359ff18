// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/sparse_program.hpp"

#include <stdexcept>

#include "swarm_planner/solver/codegen/generator.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

/// What a user would write around the solver; NAME and PREFIX are put in its place. Reads problems, writes answers.
const char* const kDriver = R"(#include <stdio.h>
#include <stdlib.h>
#include <time.h>
#include "NAME.h"
static NAME_tables tables;
static NAME_solver solver;
static void numbers(double* to, int count) {
  if (fread(to, sizeof *to, (size_t)count, stdin) != (size_t)count) exit(3);
}
static void answer(double microseconds) {
  const double head[5] = {solver.status, solver.iterations, solver.objective, solver.residual, microseconds};
  fwrite(head, sizeof head, 1, stdout);
  fwrite(solver.x, sizeof(double), PREFIX_VARIABLES, stdout);
  fwrite(solver.row_multiplier, sizeof(double), PREFIX_ROWS, stdout);
  fwrite(solver.bound_multiplier, sizeof(double), PREFIX_VARIABLES, stdout);
}
int main(void) {
  NAME_parameters parameters;
  double count;
  NAME_default_parameters_baseline(&parameters);
  if (NAME_setup_baseline(&tables, &parameters, PREFIX_HASH + 1) != PREFIX_WRONG_VERSION) return 4;
  if (NAME_setup_baseline(&tables, &parameters, PREFIX_HASH) != PREFIX_SOLVED) return 5;
  for (numbers(&count, 1); count > 0.0; count -= 1.0) {
    NAME_init_baseline(&solver, &tables);
    numbers(solver.linear, PREFIX_VARIABLES);
    numbers(solver.lower, PREFIX_VARIABLES);
    numbers(solver.upper, PREFIX_VARIABLES);
    numbers(solver.row_lower, PREFIX_ROWS);
    numbers(solver.row_upper, PREFIX_ROWS);
    for (int r = 0; r < PREFIX_ROWS; ++r) {
      double penalty;
      numbers(&penalty, 1);
      solver.row_penalty[r] = (uint8_t)penalty;
    }
    numbers(solver.hessian, PREFIX_HESSIAN_VARYING);
    numbers(solver.matrix, PREFIX_MATRIX_VARYING);
    const clock_t start = clock();
    NAME_solve_baseline(&tables, &solver);
    answer(1e6 * (double)(clock() - start) / CLOCKS_PER_SEC);
    solver.warm = 1;
    for (int j = 0; j < PREFIX_VARIABLES; ++j) {
      solver.warm_x[j] = solver.x[j];
      solver.warm_bound_multiplier[j] = solver.bound_multiplier[j];
    }
    for (int r = 0; r < PREFIX_ROWS; ++r) solver.warm_row_multiplier[r] = solver.row_multiplier[r];
    NAME_solve_baseline(&tables, &solver);
    answer(0.0);
  }
  return 0;
}
)";

void append(std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

SparseProgram::SparseProgram(const SparseDescription& description, const std::string& compiler_flags)
    : description_(description), program_(generate(description), kDriver, compiler_flags) {}

std::vector<SparseProgram::Answers> SparseProgram::solve(const std::vector<SparseData>& problems) const {
  std::vector<double> in{static_cast<double>(problems.size())};
  for (const SparseData& p : problems) {
    for (const auto* part : {&p.linear, &p.lower, &p.upper, &p.row_lower, &p.row_upper}) append(in, *part);
    in.insert(in.end(), p.row_penalty.begin(), p.row_penalty.end());
    append(in, p.hessian);
    append(in, p.matrix);
  }
  const std::vector<double> out = program_.run(in);
  const auto variables = static_cast<std::size_t>(description_.variables);
  const auto rows = static_cast<std::size_t>(description_.rows());
  if (out.size() != 2 * (5 + 2 * variables + rows) * problems.size()) throw std::runtime_error("wrote too little");
  const double* next = out.data();
  const auto take = [&](std::size_t count) {
    next += count;
    return std::vector<double>(next - count, next);
  };
  std::vector<Answers> answers(problems.size());
  for (Answers& both : answers) {
    for (SparseAnswer* answer : {&both.cold, &both.warm}) {
      const std::vector<double> head = take(5);
      answer->status = static_cast<int>(head[0]);
      answer->iterations = static_cast<int>(head[1]);
      answer->objective = head[2];
      answer->residual = head[3];
      if (answer == &both.cold) both.microseconds = head[4];
      answer->x = take(variables);
      answer->row_multiplier = take(rows);
      answer->bound_multiplier = take(variables);
    }
  }
  return answers;
}

}  // namespace codegen
}  // namespace swarm_planner
