// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "solver/generated_program.hpp"

#include <stdexcept>

namespace swarm_planner {
namespace codegen {
namespace {

/// What a user would write around the solver; NAME and PREFIX are put in its place. Reads problems, writes answers.
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
static void answer(void) {
  double head[3] = {solver.status, solver.method, solver.iterations};
  fwrite(head, sizeof head, 1, stdout);
  fwrite(solver.u, sizeof solver.u, 1, stdout);
  fwrite(solver.x, sizeof solver.x, 1, stdout);
}
int main(void) {
  NAME_parameters parameters;
  NAME_default_parameters_baseline(&parameters);
  if (NAME_setup_baseline(&tables, &parameters, PREFIX_HASH + 1) != PREFIX_WRONG_VERSION) return 4;
  if (NAME_setup_baseline(&tables, &parameters, PREFIX_HASH) != PREFIX_SOLVED) return 5;
  NAME_init_baseline(&solver, &tables);
  solver.tolerance = 1e-9;
  for (int count = (int)number(); count > 0; --count) {
    for (int i = 0; i < PREFIX_STATES; ++i) solver.x0[i] = number();
    for (int i = 0; i < PREFIX_INPUTS; ++i) solver.u_previous[i] = number();
    for (int i = 0; i < PREFIX_HORIZON * PREFIX_STATES; ++i) (&solver.state_linear[0][0])[i] = number();
    for (int i = 0; i < PREFIX_HORIZON * PREFIX_INPUTS; ++i) (&solver.input_linear[0][0])[i] = number();
    NAME_clear_rows(&solver);
    for (int rows = (int)number(); rows > 0; --rows) {
      double normal[PREFIX_COMPONENTS];
      const int output = (int)number(), stage = (int)number(), penalty = (int)number();
      for (int c = 0; c < PREFIX_COMPONENTS; ++c) normal[c] = number();
      if (NAME_add_row(&solver, output, stage, normal, number(), penalty) < 0) return 6;
    }
    solver.quadratic_count = (int)number();
    for (int i = 0; i < solver.quadratic_count; ++i) {
      solver.quadratic_output[i] = (int)number();
      solver.quadratic_index[i] = (int)number();
      for (int c = 0; c < PREFIX_COMPONENTS; ++c) solver.quadratic_normal[i][c] = number();
      solver.quadratic_offset[i] = number();
      solver.quadratic_weight[i] = number();
    }
    solver.wanted_method = PREFIX_ACTIVE_SET;
    solver.warm_count = 0;
    NAME_solve_baseline(&tables, &solver);
    answer();
    solver.warm_count = solver.active_count;
    for (int i = 0; i < solver.active_count; ++i) {
      solver.warm_id[i] = solver.active_id[i];
      solver.warm_multiplier[i] = solver.multiplier[i];
    }
    NAME_solve_baseline(&tables, &solver);
    answer();
    solver.wanted_method = PREFIX_INTERIOR_POINT;
    NAME_solve_baseline(&tables, &solver);
    answer();
  }
  return 0;
}
)";

void append(std::vector<double>& to, const std::vector<double>& from) { to.insert(to.end(), from.begin(), from.end()); }

}  // namespace

GeneratedProgram::GeneratedProgram(const Description& description, const std::string& compiler_flags)
    : description_(description), program_(generate(description), kDriver, compiler_flags) {}

std::vector<std::vector<SolverAnswer>> GeneratedProgram::solve(const std::vector<ProblemData>& problems) const {
  std::vector<double> in{static_cast<double>(problems.size())};
  for (const ProblemData& p : problems) {
    for (const auto* part : {&p.x0, &p.u_previous, &p.state_linear, &p.input_linear}) append(in, *part);
    in.push_back(static_cast<double>(p.rows.size()));
    for (const ProblemData::Row& row : p.rows) {
      append(in, {static_cast<double>(row.output), static_cast<double>(row.stage), static_cast<double>(row.penalty)});
      append(in, row.normal);
      in.push_back(row.offset);
    }
    in.push_back(static_cast<double>(p.quadratics.size()));
    for (const ProblemData::Quadratic& term : p.quadratics) {
      const int first = description_.outputs[static_cast<std::size_t>(term.output)].touchesInput() ? 0 : 1;
      append(in, {static_cast<double>(term.output), static_cast<double>(term.stage - first)});
      append(in, term.normal);
      append(in, {term.offset, term.weight});
    }
  }
  const std::vector<double> out = program_.run(in);

  const auto inputs = static_cast<std::size_t>(description_.horizon * description_.inputs);
  const auto states = static_cast<std::size_t>((description_.horizon + 1) * description_.states);
  const std::size_t size = 3 + inputs + states;
  if (out.size() != 3 * size * problems.size()) throw std::runtime_error("the program wrote too little");
  std::vector<std::vector<SolverAnswer>> answers(problems.size());
  auto values = out.begin();
  for (auto& of_problem : answers) {
    for (int i = 0; i < 3; ++i, values += static_cast<std::ptrdiff_t>(size)) {
      SolverAnswer answer;
      answer.status = static_cast<int>(values[0]);
      answer.method = static_cast<int>(values[1]);
      answer.iterations = static_cast<int>(values[2]);
      const auto u = values + 3, x = u + static_cast<std::ptrdiff_t>(inputs);
      answer.u.assign(u, x);
      answer.x.assign(x, x + static_cast<std::ptrdiff_t>(states));
      of_problem.push_back(answer);
    }
  }
  return answers;
}

}  // namespace codegen
}  // namespace swarm_planner
