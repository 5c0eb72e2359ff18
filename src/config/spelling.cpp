// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "spelling.hpp"

#include <algorithm>
#include <numeric>

namespace swarm_planner {

namespace {

constexpr std::size_t kMostListed = 12;
constexpr std::size_t kLongestWord = 60;

/// Levenshtein's distance: insertions, deletions and replacements that turn one word into the other.
std::size_t editDistance(const std::string& from, const std::string& to) {
  std::vector<std::size_t> row(to.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= from.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= to.size(); ++j) {
      const std::size_t replaced = diagonal + (from[i - 1] == to[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[to.size()];
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (std::size_t i = 0; i < std::min(words.size(), kMostListed); ++i) text += (i == 0 ? "" : ", ") + words[i];
  return words.size() > kMostListed ? text + ", ..." : text;
}

}  // namespace

std::string quoted(const std::string& text) { return '"' + text + '"'; }

std::string unknownKeyMessage(const std::string& key, const std::vector<std::string>& known) {
  const std::string* closest = nullptr;
  // A typing error changes a letter or two; in a short name two changes make another word.
  std::size_t least = (key.size() + 1) / 3 + 1;
  // What is much longer than any word is none with a typing error, and would take long to compare.
  if (key.size() > kLongestWord) return "unknown key, expected one of: " + joined(known);
  for (const std::string& candidate : known) {
    const std::size_t distance = editDistance(key, candidate);
    if (distance >= least) continue;
    least = distance;
    closest = &candidate;
  }
  if (closest != nullptr) return "unknown key, did you mean " + quoted(*closest) + "?";
  return "unknown key, expected one of: " + joined(known);
}

}  // namespace swarm_planner
