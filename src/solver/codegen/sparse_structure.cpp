// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/sparse_structure.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace swarm_planner {
namespace codegen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Newton's equations solve with every factor four times (predictor and corrector, each refined once), and each
/// solution uses every entry twice.
constexpr std::int64_t kUsesOfAnEntry = 8;
/// Rows are kept unless eliminating them saves this share: with them K is better conditioned.
constexpr double kWorthwhile = 0.1;

/// The factor in natural order may fill up altogether: beyond so many unknowns it is not looked at.
constexpr std::size_t kMostCompared = 6000;

/// Entries of each row of A.
std::vector<std::vector<int>> entriesOfRows(const SparseMatrix& m) {
  std::vector<std::vector<int>> result(at(m.rows));
  for (std::size_t k = 0; k < m.entries.size(); ++k) result[at(m.entries[k].row)].push_back(static_cast<int>(k));
  return result;
}

/// K over variables and kept rows in their natural order.
struct Kkt {
  std::vector<int> kept_rows;
  std::vector<int> kept_index;  ///< per row; -1: eliminated
  Graph graph;
  std::vector<bool> stable;
  std::int64_t products = 0;
};

Kkt makeKkt(const SparseDescription& d, const std::vector<std::vector<int>>& rows, int longest_eliminated) {
  Kkt kkt;
  std::vector<std::set<int>> graph(at(d.variables));
  kkt.stable.assign(at(d.variables), false);
  const auto connect = [&](int i, int j) {
    if (i == j) return;
    graph[at(i)].insert(j);
    graph[at(j)].insert(i);
  };
  for (const SparseEntry& e : d.hessian.entries) {
    connect(e.row, e.column);
    if (e.row == e.column) kkt.stable[at(e.row)] = true;
  }
  for (int j = 0; j < d.variables; ++j) {
    const auto exists = [](const Datum& bound) { return bound.varies || std::abs(bound.value.value()) < kUnbounded; };
    if (exists(d.lower[at(j)]) || exists(d.upper[at(j)])) kkt.stable[at(j)] = true;
  }
  for (int r = 0; r < d.rows(); ++r) {
    const std::vector<int>& entries = rows[at(r)];
    if (r >= d.equalities && static_cast<int>(entries.size()) <= longest_eliminated) {
      kkt.kept_index.push_back(-1);
      for (const int k : entries) {
        kkt.stable[at(d.matrix.entries[at(k)].column)] = true;
        for (const int l : entries) connect(d.matrix.entries[at(k)].column, d.matrix.entries[at(l)].column);
      }
      kkt.products += static_cast<std::int64_t>(entries.size() * (entries.size() + 1) / 2);
      continue;
    }
    const int unknown = static_cast<int>(graph.size());
    kkt.kept_index.push_back(static_cast<int>(kkt.kept_rows.size()));
    kkt.kept_rows.push_back(r);
    kkt.stable.push_back(r >= d.equalities);
    graph.emplace_back();
    for (const int k : entries) connect(unknown, d.matrix.entries[at(k)].column);
  }
  for (const auto& neighbours : graph) kkt.graph.emplace_back(neighbours.begin(), neighbours.end());
  return kkt;
}

/// The numbers of entries from which on rows might be kept.
std::vector<int> candidates(const SparseDescription& d, const std::vector<std::vector<int>>& rows) {
  std::set<int> lengths;
  for (int r = d.equalities; r < d.rows(); ++r) lengths.insert(static_cast<int>(rows[at(r)].size()));
  std::vector<int> result{1};
  for (const int length : lengths) {
    if (length > result.back() && (length <= 4 || length >= 1.4 * result.back())) result.push_back(length);
  }
  if (!lengths.empty() && *lengths.rbegin() > result.back()) result.push_back(*lengths.rbegin());
  return result;
}

void placeUnknowns(const SparseDescription& d, const Kkt& kkt, SparseStructure& s) {
  std::vector<int> place(s.factor.order.size());
  for (std::size_t k = 0; k < place.size(); ++k) place[at(s.factor.order[k])] = static_cast<int>(k);
  s.kept_rows = kkt.kept_rows;
  s.variable_unknown.assign(place.begin(), place.begin() + d.variables);
  for (const int kept : kkt.kept_index) s.row_unknown.push_back(kept < 0 ? -1 : place[at(d.variables + kept)]);
  for (const int unknown : s.factor.order) s.pivot_sign.push_back(unknown < d.variables ? 1 : -1);
}

/// K's ordered lower triangle, and which of its entries the entries of H and A belong to.
void placeEntries(const SparseDescription& d, const std::vector<std::vector<int>>& rows, const Kkt& kkt,
                  SparseStructure& s) {
  std::map<std::pair<int, int>, int> slots;  // (column, row)
  const auto key = [](int i, int j) { return std::make_pair(std::min(i, j), std::max(i, j)); };
  std::vector<int> place(s.factor.order.size());
  for (std::size_t k = 0; k < place.size(); ++k) place[at(s.factor.order[k])] = static_cast<int>(k);
  for (std::size_t i = 0; i < place.size(); ++i) {
    slots[key(place[i], place[i])] = 0;
    for (const int j : kkt.graph[i]) slots[key(place[i], place[at(j)])] = 0;
  }
  int count = 0, column = -1;
  for (auto& item : slots) {
    for (; column < item.first.first; ++column) s.kkt_start.push_back(count);
    item.second = count++;
    s.kkt_row.push_back(item.first.second);
  }
  s.kkt_start.push_back(count);
  for (const int p : place) s.diagonal_slot.push_back(slots.at(key(p, p)));
  const auto variable = [&](int j) { return s.variable_unknown[at(j)]; };
  for (const SparseEntry& e : d.hessian.entries) {
    s.hessian_slot.push_back(slots.at(key(variable(e.row), variable(e.column))));
  }
  for (const SparseEntry& e : d.matrix.entries) {
    const int row = s.row_unknown[at(e.row)];
    s.matrix_slot.push_back(row < 0 ? -1 : slots.at(key(row, variable(e.column))));
  }
  for (int r = 0; r < d.rows(); ++r) {
    for (std::size_t k = 0; s.row_unknown[at(r)] < 0 && k < rows[at(r)].size(); ++k) {
      for (std::size_t l = 0; l <= k; ++l) {
        const int first = rows[at(r)][k], second = rows[at(r)][l];
        const int i = variable(d.matrix.entries[at(first)].column), j = variable(d.matrix.entries[at(second)].column);
        s.products.push_back({slots.at(key(i, j)), r, first, second});
      }
    }
  }
}

/// Row of the panel that a row of the factor is.
int rowOfPanel(const Panel& panel, int row) {
  if (row < panel.first + panel.width) return row - panel.first;
  const auto found = std::lower_bound(panel.rows.begin(), panel.rows.end(), row);
  return panel.width + static_cast<int>(found - panel.rows.begin());
}

void layOutPanels(SparseStructure& s) {
  std::vector<int> panel_of(s.factor.order.size());
  for (std::size_t p = 0; p < s.panels.size(); ++p) {
    const Panel& panel = s.panels[p];
    s.panel_start.push_back(s.factor_room);
    s.factor_room += panel.width * panel.height();
    s.update_room = std::max(s.update_room, panel.height());
    for (int j = 0; j < panel.width; ++j) panel_of[at(panel.first + j)] = static_cast<int>(p);
  }
  s.updates.resize(s.panels.size());
  for (std::size_t p = 0; p < s.panels.size(); ++p) {
    const Panel& panel = s.panels[p];
    for (std::size_t i = 0; i < panel.rows.size();) {
      const int target = panel_of[at(panel.rows[i])];
      PanelUpdate update{static_cast<int>(p), panel.width + static_cast<int>(i), 0, {}};
      for (std::size_t k = i; k < panel.rows.size(); ++k) {
        update.where.push_back(rowOfPanel(s.panels[at(target)], panel.rows[k]));
        if (panel_of[at(panel.rows[k])] == target) ++update.columns;
      }
      i += at(update.columns);
      s.update_room = std::max(s.update_room, update.columns * static_cast<int>(update.where.size()));
      s.updates[at(target)].push_back(update);
    }
  }
  for (std::size_t j = 0; j + 1 < s.kkt_start.size(); ++j) {
    const int p = panel_of[j];
    const Panel& panel = s.panels[at(p)];
    for (int k = s.kkt_start[j]; k < s.kkt_start[j + 1]; ++k) {
      s.kkt_place.push_back(s.panel_start[at(p)] + (static_cast<int>(j) - panel.first) * panel.height() +
                            rowOfPanel(panel, s.kkt_row[at(k)]));
    }
  }
}

void compareWithNaturalOrder(const Kkt& kkt, SparseStructure& s) {
  std::vector<int> natural(kkt.graph.size());
  if (natural.size() > kMostCompared) return;
  for (std::size_t i = 0; i < natural.size(); ++i) natural[i] = static_cast<int>(i);
  const SymbolicFactor factor = factorSymbolically(kkt.graph, natural);
  s.natural_entries = factor.entries();
  s.natural_operations = factor.operations();
}

}  // namespace

SparseStructure analyse(const SparseDescription& d) {
  const std::vector<std::vector<int>> rows = entriesOfRows(d.matrix);
  SparseStructure s;
  Kkt best;
  double best_cost = 0.0;
  for (const int longest : candidates(d, rows)) {
    Kkt kkt = makeKkt(d, rows, longest);
    SymbolicFactor factor = factorSymbolically(kkt.graph, minimumDegreeOrder(kkt.graph, kkt.stable));
    const auto cost = static_cast<double>(factor.operations() + kUsesOfAnEntry * factor.entries() + 2 * kkt.products);
    if (!best.graph.empty() && cost > (1.0 - kWorthwhile) * best_cost) continue;
    best_cost = cost;
    s.longest_eliminated = longest;
    s.factor = std::move(factor);
    best = std::move(kkt);
  }
  compareWithNaturalOrder(makeKkt(d, rows, 0), s);
  s.factor = factorSymbolically(best.graph, postorder(s.factor));
  s.panels = makePanels(s.factor);
  placeUnknowns(d, best, s);
  placeEntries(d, rows, best, s);
  layOutPanels(s);
  return s;
}

}  // namespace codegen
}  // namespace swarm_planner
