// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "swarm_planner/solver/codegen/expression.hpp"

namespace swarm_planner {
namespace codegen {

/// A description cannot be used; what() lists every fault, one a line.
class DescriptionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Stands for "no bound" in data and tables: finite, so that differences with it stay finite.
constexpr double kUnbounded = 1e300;

/// Penalty of a violated row: linear * s + 1/2 quadratic * s^2 for its slack s >= 0.
struct Penalty {
  std::string name;
  Expression linear;
  Expression quadratic;
};

/// An output: a vector that is linear in state and input of one stage, y = C x_k + D u_k, with the rows and bounds
/// that may restrict it.
struct Output {
  std::string name;
  ExpressionMatrix state;  ///< C
  ExpressionMatrix input;  ///< D
  int max_rows = 0;        ///< most run-time rows n . y >= d per stage
  int row_penalty = -1;    ///< index of the penalty rows get unless told otherwise; -1: hard
  bool bounded = false;
  std::vector<Expression> lower;  ///< per component; -kUnbounded: none
  std::vector<Expression> upper;
  int bound_penalty = -1;  ///< index of the bounds' penalty; -1: hard

  int size() const { return state.rows; }
  /// Outputs of the state alone exist at stages 1..N, those that touch the input at 0..N-1.
  bool touchesInput() const;
};

/// One QP structure:
///   min sum_{k=1}^{N-1} 1/2 x_k' Q x_k + 1/2 x_N' Q_N x_N + sum_{k=1}^{N} q_k' x_k
///     + sum_{k=0}^{N-1} 1/2 u_k' R u_k + r_k' u_k + 1/2 (u_k - u_{k-1})' S (u_k - u_{k-1}) + penalties
///   s.t. x_{k+1} = A x_k + B u_k, rows and bounds on outputs; x_0, u_{-1}, q, r and the rows are run-time data.
struct Description {
  std::string name;  ///< prefix of all generated symbols
  int horizon = 0;   ///< N
  int states = 0;
  int inputs = 0;
  std::vector<std::pair<std::string, double>> parameters;  ///< with defaults, in the order of the file
  ExpressionMatrix a, b;
  ExpressionMatrix stage_cost;     ///< Q
  ExpressionMatrix terminal_cost;  ///< Q_N
  ExpressionMatrix input_cost;     ///< R
  ExpressionMatrix rate_cost;      ///< S, empty if there is none
  bool input_linear = false;       ///< the linear term r_k is run-time data
  std::vector<Output> outputs;
  std::vector<Penalty> penalties;
  int max_quadratic = 0;  ///< most run-time terms 1/2 w (n . y - c)^2 of a solve and copy
  int copies = 1;         ///< most copies of this model in a QP, each with rows of its own
  int max_couplings = 0;  ///< most run-time rows n_1 . y_1 + n_2 . y_2 >= d on an output of two copies
  int max_active = 64;    ///< most rows active at a time, of all copies
  int max_changes = 400;  ///< most changes of the active set
  std::vector<std::string> instruction_sets;  ///< of "baseline", "avx2", "avx512"
  std::uint64_t hash = 0;                     ///< of everything above but instruction_sets
};

/// A file's text. @throws DescriptionError if it cannot be read
std::string readText(const std::string& path);

/// A description's text. What the file does not say, the one that its key `base` names says, by a path from its own
/// folder on. @throws DescriptionError if one cannot be read
std::string readDescriptionText(const std::string& path);

/// @throws DescriptionError with every fault found
Description parseDescription(const std::string& yaml_text);

/// As parseDescription, from a file.
Description loadDescription(const std::string& path);

}  // namespace codegen
}  // namespace swarm_planner
