// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/sparse_ordering.hpp"

#include <algorithm>
#include <iterator>
#include <set>
#include <tuple>

namespace swarm_planner {
namespace codegen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Share of a panel's entries that may be zeros.
constexpr double kZeros = 0.3;

/// (a united with b) without x and y; a and b ascending.
std::vector<int> unite(const std::vector<int>& a, const std::vector<int>& b, int x, int y) {
  std::vector<int> result;
  result.reserve(a.size() + b.size());
  std::set_union(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(result));
  result.erase(std::remove_if(result.begin(), result.end(), [=](int i) { return i == x || i == y; }), result.end());
  return result;
}

void appendSubtree(const std::vector<std::vector<int>>& children, int root, std::vector<int>& to) {
  std::vector<std::pair<int, std::size_t>> path{{root, 0}};
  while (!path.empty()) {
    auto& top = path.back();
    if (top.second < children[at(top.first)].size()) {
      const int child = children[at(top.first)][top.second++];
      path.emplace_back(child, 0);
    } else {
      to.push_back(top.first);
      path.pop_back();
    }
  }
}

}  // namespace

std::vector<int> minimumDegreeOrder(const Graph& graph, const std::vector<bool>& stable) {
  Graph rest = graph;
  std::vector<bool> ready = stable;
  using Key = std::tuple<bool, std::size_t, int>;
  const auto key = [&](int i) { return Key(!ready[at(i)], rest[at(i)].size(), i); };
  std::set<Key> queue;
  for (int i = 0; i < static_cast<int>(graph.size()); ++i) queue.insert(key(i));
  std::vector<int> order;
  while (!queue.empty()) {
    const int next = std::get<2>(*queue.begin());
    queue.erase(queue.begin());
    order.push_back(next);
    const std::vector<int> around = std::move(rest[at(next)]);
    for (const int i : around) {
      queue.erase(key(i));
      rest[at(i)] = unite(rest[at(i)], around, i, next);
      ready[at(i)] = true;
      queue.insert(key(i));
    }
  }
  return order;
}

std::int64_t SymbolicFactor::entries() const {
  std::int64_t sum = 0;
  for (const auto& rows : pattern) sum += static_cast<std::int64_t>(rows.size());
  return sum;
}

std::int64_t SymbolicFactor::operations() const {
  std::int64_t sum = 0;
  for (const auto& rows : pattern) {
    const auto count = static_cast<std::int64_t>(rows.size());
    sum += count * (count + 1) / 2 + count;
  }
  return sum;
}

SymbolicFactor factorSymbolically(const Graph& graph, const std::vector<int>& order) {
  SymbolicFactor result;
  result.order = order;
  result.pattern.resize(order.size());
  std::vector<int> place(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) place[at(order[k])] = static_cast<int>(k);
  for (std::size_t k = 0; k < order.size(); ++k) {
    for (const int neighbour : graph[at(order[k])]) {
      if (place[at(neighbour)] > static_cast<int>(k)) result.pattern[k].push_back(place[at(neighbour)]);
    }
    std::sort(result.pattern[k].begin(), result.pattern[k].end());
  }
  // A column's pattern goes on to its parent, which comes later.
  for (std::size_t k = 0; k < order.size(); ++k) {
    const int parent = result.parent(static_cast<int>(k));
    if (parent < 0) continue;
    result.pattern[at(parent)] = unite(result.pattern[at(parent)], result.pattern[k], parent, parent);
  }
  return result;
}

std::vector<int> postorder(const SymbolicFactor& factor) {
  const int n = static_cast<int>(factor.order.size());
  std::vector<std::vector<int>> children(at(n));
  std::vector<int> sequence, result;
  for (int k = 0; k < n; ++k) {
    if (factor.parent(k) >= 0) children[at(factor.parent(k))].push_back(k);
  }
  for (int k = 0; k < n; ++k) {
    if (factor.parent(k) < 0) appendSubtree(children, k, sequence);
  }
  for (const int k : sequence) result.push_back(factor.order[at(k)]);
  return result;
}

std::vector<Panel> makePanels(const SymbolicFactor& factor) {
  std::vector<Panel> panels;
  std::vector<int> zeros;  // stored in each panel
  for (int k = 0; k < static_cast<int>(factor.order.size()); ++k) {
    panels.push_back({k, 1, factor.pattern[at(k)]});
    zeros.push_back(0);
    while (panels.size() > 1) {
      const Panel& right = panels.back();
      Panel& left = panels[panels.size() - 2];
      if (left.rows.empty() || left.rows.front() != right.first) break;
      const int wasted =
          left.width * (right.height() - static_cast<int>(left.rows.size())) + zeros[zeros.size() - 2] + zeros.back();
      const int width = left.width + right.width;
      const int stored = width * (width - 1) / 2 + width * static_cast<int>(right.rows.size());
      if (wasted > kZeros * stored) break;
      left.width = width;
      left.rows = right.rows;
      panels.pop_back();
      zeros.pop_back();
      zeros.back() = wasted;
    }
  }
  return panels;
}

}  // namespace codegen
}  // namespace swarm_planner
