// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "swarm_planner/solver/codegen/description.hpp"
#include "swarm_planner/solver/codegen/expression.hpp"

namespace swarm_planner {
namespace codegen {

/// A number that is known beforehand, or one that comes with every solve.
struct Datum {
  Expression value;  ///< of data that varies: what it is until it is set
  bool varies = false;
};

struct SparseEntry {
  int row = 0;
  int column = 0;
  Datum datum;
};

/// The entries that can be nonzero, row by row in ascending columns.
struct SparseMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<SparseEntry> entries;
};

/// A named range of variables or rows.
struct Group {
  std::string name;
  int first = 0;
  int count = 0;
};

/// One sparse QP without stages:
///   min 1/2 x' H x + g' x + penalties   s.t.  l <= A x <= u, lower <= x <= upper
/// with equalities, whose l and u are the same datum, as the first rows of A.
struct SparseDescription {
  std::string name;  ///< prefix of all generated symbols
  int variables = 0;
  std::vector<Group> variable_groups;
  std::vector<std::pair<std::string, double>> parameters;  ///< with defaults, in the order of the file
  SparseMatrix hessian;                                    ///< lower triangle
  std::vector<Datum> linear;                               ///< g
  std::vector<Datum> lower, upper;                         ///< of variables; +-kUnbounded that does not vary: none
  SparseMatrix matrix;                                     ///< A
  int equalities = 0;
  std::vector<Group> row_groups;
  std::vector<Datum> row_lower, row_upper;
  std::vector<int> row_penalty;  ///< index of a row's penalty; -1: hard
  std::vector<Penalty> penalties;
  int max_iterations = 60;
  std::vector<std::string> instruction_sets;  ///< of "baseline", "avx2", "avx512"
  std::uint64_t hash = 0;                     ///< of everything above but instruction_sets

  int rows() const { return matrix.rows; }
};

/// A description is of this kind if it has the key `variables`.
bool isSparseDescription(const std::string& yaml_text);

/// @throws DescriptionError with every fault found
SparseDescription parseSparseDescription(const std::string& yaml_text);

}  // namespace codegen
}  // namespace swarm_planner
