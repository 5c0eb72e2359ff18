// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <map>
#include <sstream>
#include <utility>

#include "swarm_planner/solver/codegen/generator.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string entry(const char* name, int row, int column) {
  return name + std::to_string(row) + "_" + std::to_string(column);
}

/// The columns that have an entry in each row of L, ascending.
std::vector<std::vector<int>> columnsOfRows(const SymbolicFactor& factor) {
  std::vector<std::vector<int>> result(factor.pattern.size());
  for (std::size_t k = 0; k < factor.pattern.size(); ++k) {
    for (const int row : factor.pattern[k]) result[at(row)].push_back(static_cast<int>(k));
  }
  return result;
}

/// K's entry less the products of the columns to its left; l is L, u is L times its column's pivot.
std::string reducedEntry(const SparseStructure& s, const std::vector<std::vector<int>>& columns,
                         const std::map<std::pair<int, int>, int>& slots, int row, int column) {
  std::string text;
  const auto slot = slots.find({row, column});
  if (slot != slots.end()) text = "s->kkt[" + std::to_string(slot->second) + "]";
  for (const int k : columns[at(column)]) {
    const auto& pattern = s.factor.pattern[at(k)];
    if (row != column && !std::binary_search(pattern.begin(), pattern.end(), row)) continue;
    text += (text.empty() ? "-" : " - ") + entry("l", row, k) + " * " + entry("u", column, k);
  }
  return text;
}

void writeNumericFactor(std::ostringstream& out, const SparseStructure& s) {
  const auto columns = columnsOfRows(s.factor);
  std::map<std::pair<int, int>, int> slots;
  for (int j = 0; j < s.unknowns(); ++j) {
    for (int k = s.kkt_start[at(j)]; k < s.kkt_start[at(j + 1)]; ++k) slots[{s.kkt_row[at(k)], j}] = k;
  }
  out << "/* 0 if a pivot has clearly the wrong sign. */\nstatic int qpc_factorise(qpc_solver* s) {\n";
  int place = 0;
  for (int j = 0; j < s.unknowns(); ++j) {
    const std::string pivot = "d" + std::to_string(j), inverse = "i" + std::to_string(j);
    out << "  const double " << pivot << " = qpc_checked_pivot(s, " << reducedEntry(s, columns, slots, j, j) << ", "
        << s.pivot_sign[at(j)] << ".0);\n  if (" << pivot << " == 0.0) return 0;\n  const double " << inverse
        << " = 1.0 / " << pivot << ";\n  s->inverse_pivot[" << j << "] = " << inverse << ";\n";
    for (const int i : s.factor.pattern[at(j)]) {
      out << "  const double " << entry("u", i, j) << " = " << reducedEntry(s, columns, slots, i, j)
          << ";\n  const double " << entry("l", i, j) << " = " << entry("u", i, j) << " * " << inverse
          << ";\n  s->factor[" << place++ << "] = " << entry("l", i, j) << ";\n";
    }
  }
  out << "  return 1;\n}\n\n";
}

void writeSubstitution(std::ostringstream& out, const SparseStructure& s) {
  out << "/* x = K^-1 x by the factor. */\n"
         "static void qpc_substitute(const qpc_solver* s, double* restrict x) {\n"
         "  const double* restrict l = s->factor;\n  (void)l;\n";
  std::vector<int> start;
  int place = 0;
  for (int j = 0; j < s.unknowns(); ++j) {
    start.push_back(place);
    for (const int i : s.factor.pattern[at(j)]) {
      out << "  x[" << i << "] -= l[" << place++ << "] * x[" << j << "];\n";
    }
  }
  for (int j = s.unknowns() - 1; j >= 0; --j) {
    out << "  x[" << j << "] = x[" << j << "] * s->inverse_pivot[" << j << "]";
    place = start[at(j)];
    for (const int i : s.factor.pattern[at(j)]) out << " - l[" << place++ << "] * x[" << i << "]";
    out << ";\n";
  }
  out << "}\n";
}

}  // namespace

std::string writeStraightLineFactor(const SparseStructure& s) {
  std::ostringstream out;
  out << "/* ---- L D L' of the quasi-definite matrix K, and solving with it: operation by operation. ---- */\n\n";
  writeNumericFactor(out, s);
  writeSubstitution(out, s);
  return out.str();
}

}  // namespace codegen
}  // namespace swarm_planner
