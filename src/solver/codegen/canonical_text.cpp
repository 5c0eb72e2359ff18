// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "canonical_text.hpp"

#include <sstream>
#include <vector>

namespace swarm_planner {
namespace codegen {
namespace {

void append(std::ostringstream& text, const char* key, const SparseMatrix& m) {
  text << key << m.rows << 'x' << m.columns;
  for (const SparseEntry& e : m.entries) {
    text << ',' << e.row << ' ' << e.column << ' ' << (e.datum.varies ? "varies" : e.datum.value.code());
  }
  text << ';';
}

void append(std::ostringstream& text, const char* key, const std::vector<Datum>& v) {
  text << key;
  for (const Datum& d : v) text << ',' << (d.varies ? "varies" : d.value.code());
  text << ';';
}

}  // namespace

std::string canonicalText(const SparseDescription& description) {
  std::ostringstream text;
  text << description.name << ';' << description.variables << ';' << description.equalities << ';'
       << description.max_iterations << ';';
  for (const auto& p : description.parameters) text << p.first << '=' << toCode(p.second) << ';';
  for (const Group& g : description.variable_groups) text << g.name << g.first << ',' << g.count << ';';
  for (const Group& g : description.row_groups) text << g.name << g.first << ',' << g.count << ';';
  append(text, "H", description.hessian);
  append(text, "A", description.matrix);
  append(text, "g", description.linear);
  append(text, "lower", description.lower);
  append(text, "upper", description.upper);
  append(text, "row_lower", description.row_lower);
  append(text, "row_upper", description.row_upper);
  for (const Penalty& p : description.penalties) text << p.name << p.linear.code() << '/' << p.quadratic.code() << ';';
  for (const int penalty : description.row_penalty) text << penalty << ',';
  return text.str();
}

}  // namespace codegen
}  // namespace swarm_planner
