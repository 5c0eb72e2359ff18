// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace swarm_planner {
namespace codegen {

/// A number of a problem description: a constant known at generation time, or a formula in the description's
/// parameters that the generated set-up evaluates. Constants fold, and 0 and 1 vanish where algebra allows, so a
/// structural zero is exactly `isZero()`.
class Expression {
 public:
  Expression(double value = 0.0);

  /// Parses numbers, parameter names, + - * / ^ (whole exponents) and parentheses.
  /// @param parameters names with their default values
  /// @throws std::invalid_argument that says what was expected where
  static Expression parse(const std::string& text, const std::map<std::string, double>& parameters);

  bool isConstant() const { return constant_; }
  bool isZero() const { return constant_ && value_ == 0.0; }
  bool isOne() const { return constant_ && value_ == 1.0; }
  /// The value with every parameter at its default.
  double value() const { return value_; }
  /// The C expression; parameters are read from `p->`.
  const std::string& code() const { return code_; }
  /// Same formula: same constant, or same text after folding.
  bool operator==(const Expression& other) const;
  bool operator!=(const Expression& other) const { return !(*this == other); }

  Expression operator+(const Expression& other) const;
  Expression operator-(const Expression& other) const;
  Expression operator*(const Expression& other) const;
  Expression operator/(const Expression& other) const;

 private:
  friend class ExpressionParser;
  static Expression formula(double value, std::string code);

  bool constant_ = true;
  double value_ = 0.0;
  std::string code_;
};

/// A number as C text that reads back to the same double ("%.17g", always with a point or an exponent).
std::string toCode(double value);

/// Dense matrix of expressions, row by row.
struct ExpressionMatrix {
  int rows = 0;
  int columns = 0;
  std::vector<Expression> entries;

  ExpressionMatrix() = default;
  ExpressionMatrix(int row_count, int column_count);
  const Expression& operator()(int i, int j) const { return entries[static_cast<std::size_t>(i * columns + j)]; }
  Expression& operator()(int i, int j) { return entries[static_cast<std::size_t>(i * columns + j)]; }
  bool empty() const { return entries.empty(); }
};

/// Kronecker product a (x) b.
ExpressionMatrix kroneckerProduct(const ExpressionMatrix& a, const ExpressionMatrix& b);

}  // namespace codegen
}  // namespace swarm_planner
