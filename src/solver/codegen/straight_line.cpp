// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/straight_line.hpp"

#include <cctype>
#include <set>

namespace swarm_planner {
namespace codegen {
namespace {

/// Adds every word of the line that is named like a variable of StraightLine, "v" and a number.
void collectVariables(const std::string& code, std::set<std::string>& names) {
  std::string word;
  for (const char c : code + " ") {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_') {
      word += c;
      continue;
    }
    if (word.size() > 1 && word[0] == 'v' && std::isdigit(static_cast<unsigned char>(word[1])) != 0) names.insert(word);
    word.clear();
  }
}

}  // namespace

Atom StraightLine::assign(const std::string& value) {
  const std::string name = "v" + std::to_string(count_++);
  lines_.push_back({name, "const double " + name + " = " + value + ";"});
  return Atom(name);
}

Atom StraightLine::sum(const Atom& start, const std::vector<Term>& terms) {
  std::string text = start.isZero() ? "" : start.code();
  int count = start.isZero() ? 0 : 1;
  bool plain = true;
  for (const Term& term : terms) {
    if (term.x.isZero() || term.y.isZero()) continue;
    std::string product = term.x.isOne() ? term.y.code() : term.y.isOne() ? term.x.code() : "";
    if (product.empty()) {
      product = term.x.code() + " * " + term.y.code();
      ++operations_;
    }
    plain = plain && !term.subtract && (term.x.isOne() || term.y.isOne());
    operations_ += count > 0 ? 1 : 0;
    text += count > 0 ? (term.subtract ? " - " : " + ") : (term.subtract ? "-" : "");
    text += product;
    ++count;
  }
  if (count == 0) return Atom::zero();
  if (count == 1 && (plain || !start.isZero())) return Atom(text);
  return assign(text);
}

AtomMatrix StraightLine::product(const AtomMatrix& x, const AtomMatrix& y) {
  return product(x, y, AtomMatrix(x.rows, y.columns));
}

AtomMatrix StraightLine::product(const AtomMatrix& x, const AtomMatrix& y, const AtomMatrix& start, bool subtract) {
  AtomMatrix result(x.rows, y.columns);
  for (int i = 0; i < x.rows; ++i) {
    for (int j = 0; j < y.columns; ++j) {
      std::vector<Term> terms;
      for (int l = 0; l < x.columns; ++l) terms.push_back({x(i, l), y(l, j), subtract});
      result(i, j) = sum(start(i, j), terms);
    }
  }
  return result;
}

AtomMatrix StraightLine::transposedProduct(const AtomMatrix& x, const AtomMatrix& y, const AtomMatrix& start,
                                           bool subtract) {
  AtomMatrix transposed(x.columns, x.rows);
  for (int i = 0; i < x.rows; ++i) {
    for (int j = 0; j < x.columns; ++j) transposed(j, i) = x(i, j);
  }
  return product(transposed, y, start, subtract);
}

AtomMatrix StraightLine::congruenceOf(const AtomMatrix& x, const AtomMatrix& y, const AtomMatrix& start,
                                      bool subtract) {
  AtomMatrix result(x.columns, y.columns);
  for (int i = 0; i < x.columns; ++i) {
    for (int j = 0; j <= i; ++j) {
      std::vector<Term> terms;
      for (int l = 0; l < x.rows; ++l) terms.push_back({x(l, i), y(l, j), subtract});
      result(i, j) = sum(start(i, j), terms);
      result(j, i) = result(i, j);
    }
  }
  return result;
}

Atom StraightLine::multiply(const Atom& x, const Atom& y) { return sum(Atom::zero(), {{x, y, false}}); }

Factor StraightLine::factor(const AtomMatrix& f) {
  const int n = f.rows;
  Factor factor{AtomMatrix(n, n), {}};
  AtomMatrix scaled(n, n);  // L D
  for (int j = 0; j < n; ++j) {
    std::vector<Term> terms;
    for (int l = 0; l < j; ++l) terms.push_back({factor.lower(j, l), scaled(j, l), true});
    const Atom pivot = sum(f(j, j), terms);
    lines_.push_back({"", "if (!(" + pivot.code() + " > 0.0)) return 0;"});
    factor.inverse.push_back(assign("1.0 / " + pivot.code()));
    ++operations_;
    for (int i = j + 1; i < n; ++i) {
      terms.clear();
      for (int l = 0; l < j; ++l) terms.push_back({factor.lower(i, l), scaled(j, l), true});
      scaled(i, j) = sum(f(i, j), terms);
      factor.lower(i, j) = multiply(scaled(i, j), factor.inverse.back());
    }
  }
  return factor;
}

void StraightLine::forwardSubstitute(const Factor& factor, AtomMatrix& m, int j) {
  for (int i = 1; i < m.rows; ++i) {
    std::vector<Term> terms;
    for (int l = 0; l < i; ++l) terms.push_back({factor.lower(i, l), m(l, j), true});
    m(i, j) = sum(m(i, j), terms);
  }
}

void StraightLine::backwardSubstitute(const Factor& factor, AtomMatrix& m, int j) {
  for (int i = m.rows - 2; i >= 0; --i) {
    std::vector<Term> terms;
    for (int l = i + 1; l < m.rows; ++l) terms.push_back({factor.lower(l, i), m(l, j), true});
    m(i, j) = sum(m(i, j), terms);
  }
}

void StraightLine::store(const std::string& target, const Atom& value) {
  lines_.push_back({"", target + " = " + value.code() + ";"});
}

std::string StraightLine::text() const {
  std::set<std::string> used;
  std::vector<bool> kept(lines_.size());
  for (std::size_t i = lines_.size(); i-- > 0;) {
    const Line& line = lines_[i];
    kept[i] = line.variable.empty() || used.count(line.variable) > 0;
    if (kept[i]) collectVariables(line.code, used);
  }
  std::string text;
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    if (kept[i]) text += "    " + lines_[i].code + "\n";
  }
  return text;
}

}  // namespace codegen
}  // namespace swarm_planner
