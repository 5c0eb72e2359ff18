// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <vector>

#include "swarm_planner/solver/codegen/sparse_description.hpp"
#include "swarm_planner/solver/codegen/sparse_ordering.hpp"

namespace swarm_planner {
namespace codegen {

/// How one panel of the factor changes another to its right.
struct PanelUpdate {
  int panel = 0;           ///< whose columns are multiplied
  int first_row = 0;       ///< from which row of that panel on
  int columns = 0;         ///< rows from there on that are columns of the changed panel
  std::vector<int> where;  ///< rows of the changed panel that these rows are
};

/// weight * A[first] * A[second] of an eliminated row, added to an entry of K.
struct RowProduct {
  int slot = 0;
  int row = 0;
  int first = 0;
  int second = 0;
};

/// Multiplications of a factorisation up to which code without loops is the faster one.
constexpr std::int64_t kMostStraightLine = 3000;

/// Newton's equations of a description: the quasi-definite matrix K over variables and kept rows, and its factor.
///
/// Rows with few entries may be eliminated beforehand, which adds a product to K's block of variables: up to how many
/// entries is chosen by counting operations. K is ordered by minimum degree.
struct SparseStructure {
  int longest_eliminated = 1;    ///< inequality rows with at most so many entries are eliminated
  std::vector<int> kept_rows;    ///< the unknowns after the variables
  std::vector<int> row_unknown;  ///< place of a row among K's ordered unknowns; -1: eliminated
  std::vector<int> variable_unknown;
  std::vector<int> kkt_start;  ///< lower triangle of the ordered K, column by column, diagonal first
  std::vector<int> kkt_row;
  std::vector<int> hessian_slot;   ///< entry of K that an entry of H belongs to
  std::vector<int> matrix_slot;    ///< the same of A; -1: in an eliminated row
  std::vector<int> diagonal_slot;  ///< of variables, then kept rows
  std::vector<RowProduct> products;
  std::vector<int> kkt_place;   ///< where an entry of K lies in the factor's storage
  std::vector<int> pivot_sign;  ///< 1: variable, -1: row
  std::vector<Panel> panels;
  std::vector<int> panel_start;                   ///< of the panel's storage
  std::vector<std::vector<PanelUpdate>> updates;  ///< per changed panel
  int factor_room = 0;
  int update_room = 0;
  SymbolicFactor factor;
  std::int64_t natural_entries = 0;  ///< of the factor with all rows kept in natural order; 0: not counted
  std::int64_t natural_operations = 0;

  /// The factor is so small that it is written operation by operation; otherwise panels and tables drive loops.
  bool straightLine() const { return factor.operations() <= kMostStraightLine; }
  int unknowns() const { return static_cast<int>(pivot_sign.size()); }
};

SparseStructure analyse(const SparseDescription& description);

}  // namespace codegen
}  // namespace swarm_planner
