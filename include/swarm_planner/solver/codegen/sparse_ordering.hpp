// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <vector>

namespace swarm_planner {
namespace codegen {

/// The off-diagonal nonzeros of a symmetric matrix: for every unknown the others that it shares an entry with,
/// ascending.
using Graph = std::vector<std::vector<int>>;

/// A fill-reducing order: the unknown with the fewest neighbours is eliminated next, its neighbours become neighbours
/// of each other. Ties go to the lowest index.
/// @param stable unknowns with a diagonal entry of their own; others are put off until a neighbour's elimination has
///   given them one, as dividing by a mere regularisation would lose half of the digits
std::vector<int> minimumDegreeOrder(const Graph& graph, const std::vector<bool>& stable);

/// Where the factor L of L D L' has nonzeros.
struct SymbolicFactor {
  std::vector<int> order;                 ///< order[k]: the unknown eliminated as number k
  std::vector<std::vector<int>> pattern;  ///< of every column the rows below the diagonal, ascending
  /// First row of the pattern: the column's parent in the elimination tree; -1 for a root.
  int parent(int column) const {
    const auto& rows = pattern[static_cast<std::size_t>(column)];
    return rows.empty() ? -1 : rows.front();
  }
  std::int64_t entries() const;     ///< below the diagonal
  std::int64_t operations() const;  ///< multiplications (each with a subtraction) of the numeric factorisation
};

SymbolicFactor factorSymbolically(const Graph& graph, const std::vector<int>& order);

/// The same order up to independent eliminations: every subtree of the elimination tree is contiguous.
std::vector<int> postorder(const SymbolicFactor& factor);

/// Neighbouring columns of L that are stored with the same pattern.
struct Panel {
  int first = 0;
  int width = 0;
  std::vector<int> rows;  ///< below the panel, ascending
  int height() const { return width + static_cast<int>(rows.size()); }
};

/// Columns with equal patterns, and those that differ so little that the zeros stored cost less than another panel.
std::vector<Panel> makePanels(const SymbolicFactor& factor);

}  // namespace codegen
}  // namespace swarm_planner
