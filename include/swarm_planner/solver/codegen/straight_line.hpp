// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swarm_planner {
namespace codegen {

/// A factor in generated arithmetic: zero, one, or C code of a variable or literal.
class Atom {
 public:
  Atom() = default;
  explicit Atom(std::string code) : code_(std::move(code)) {}
  static Atom zero() { return Atom(); }
  static Atom one() { return Atom("1.0"); }
  bool isZero() const { return code_ == "0.0"; }
  bool isOne() const { return code_ == "1.0"; }
  const std::string& code() const { return code_; }

 private:
  std::string code_ = "0.0";
};

struct AtomMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<Atom> entries;

  AtomMatrix() = default;
  AtomMatrix(int row_count, int column_count)
      : rows(row_count), columns(column_count), entries(static_cast<std::size_t>(row_count * column_count)) {}
  const Atom& operator()(int i, int j) const { return entries[static_cast<std::size_t>(i * columns + j)]; }
  Atom& operator()(int i, int j) { return entries[static_cast<std::size_t>(i * columns + j)]; }
};

/// L D L' with unit L: the entries below the diagonal, and 1 / D.
struct Factor {
  AtomMatrix lower;
  std::vector<Atom> inverse;
};

/// Straight-line C: every operation on matrices becomes assignments to new variables for the entries that are not
/// structurally zero; zeros cost nothing and ones no multiplication.
class StraightLine {
 public:
  /// x y + start, or start - x y
  AtomMatrix product(const AtomMatrix& x, const AtomMatrix& y);
  AtomMatrix product(const AtomMatrix& x, const AtomMatrix& y, const AtomMatrix& start, bool subtract = false);
  /// x' y + start, or start - x' y
  AtomMatrix transposedProduct(const AtomMatrix& x, const AtomMatrix& y, const AtomMatrix& start,
                               bool subtract = false);
  /// x' y + start (or start - x' y), known to be symmetric: only one triangle is computed.
  AtomMatrix congruenceOf(const AtomMatrix& x, const AtomMatrix& y, const AtomMatrix& start, bool subtract = false);
  Atom multiply(const Atom& x, const Atom& y);
  /// L D L' of the symmetric f; the code returns 0 from its function where a pivot is not positive.
  Factor factor(const AtomMatrix& f);
  /// Column j of m becomes L^-1 or L^-T of itself.
  void forwardSubstitute(const Factor& factor, AtomMatrix& m, int j);
  void backwardSubstitute(const Factor& factor, AtomMatrix& m, int j);
  void store(const std::string& target, const Atom& value);

  /// The code; assignments that nothing stored depends on are left out.
  std::string text() const;
  /// Multiplications and additions written so far.
  int operations() const { return operations_; }

 private:
  struct Term {
    Atom x, y;
    bool subtract;
  };
  Atom sum(const Atom& start, const std::vector<Term>& terms);
  Atom assign(const std::string& value);

  struct Line {
    std::string variable;  ///< that the line defines; empty: a line with an effect
    std::string code;
  };
  std::vector<Line> lines_;
  int count_ = 0;
  int operations_ = 0;
};

}  // namespace codegen
}  // namespace swarm_planner
