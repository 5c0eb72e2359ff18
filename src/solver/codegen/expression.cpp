// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/expression.hpp"

#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <utility>

namespace swarm_planner {
namespace codegen {

std::string toCode(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  std::string code = text;
  if (code.find_first_of(".en") == std::string::npos) code += ".0";
  return code;
}

Expression::Expression(double value) : value_(value), code_(toCode(value)) {}

Expression Expression::formula(double value, std::string code) {
  Expression result;
  result.constant_ = false;
  result.value_ = value;
  result.code_ = std::move(code);
  return result;
}

bool Expression::operator==(const Expression& other) const {
  return constant_ == other.constant_ && code_ == other.code_;
}

Expression Expression::operator+(const Expression& other) const {
  if (constant_ && other.constant_) return value_ + other.value_;
  if (isZero()) return other;
  if (other.isZero()) return *this;
  return formula(value_ + other.value_, "(" + code_ + " + " + other.code_ + ")");
}

Expression Expression::operator-(const Expression& other) const {
  if (constant_ && other.constant_) return value_ - other.value_;
  if (other.isZero()) return *this;
  return formula(value_ - other.value_, "(" + code_ + " - " + other.code_ + ")");
}

Expression Expression::operator*(const Expression& other) const {
  if (constant_ && other.constant_) return value_ * other.value_;
  if (isZero() || other.isZero()) return 0.0;
  if (isOne()) return other;
  if (other.isOne()) return *this;
  return formula(value_ * other.value_, "(" + code_ + " * " + other.code_ + ")");
}

Expression Expression::operator/(const Expression& other) const {
  if (other.isZero()) throw std::invalid_argument("division by zero");
  if (constant_ && other.constant_) return value_ / other.value_;
  if (isZero()) return 0.0;
  if (other.isOne()) return *this;
  return formula(value_ / other.value_, "(" + code_ + " / " + other.code_ + ")");
}

/// Recursive descent over one line of text.
class ExpressionParser {
 public:
  ExpressionParser(const std::string& text, const std::map<std::string, double>& parameters)
      : text_(text), parameters_(parameters) {}

  Expression parseAll() {
    Expression result = sum();
    if (peek() != '\0') fail("an operator");
    return result;
  }

 private:
  char peek() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }

  bool accept(char c) {
    if (peek() != c) return false;
    ++at_;
    return true;
  }

  [[noreturn]] void fail(const std::string& expected) const {
    throw std::invalid_argument("\"" + text_ + "\": expected " + expected + " at column " + std::to_string(at_ + 1));
  }

  Expression sum() {
    Expression result = product();
    while (true) {
      if (accept('+')) {
        result = result + product();
      } else if (accept('-')) {
        result = result - product();
      } else {
        return result;
      }
    }
  }

  Expression product() {
    Expression result = factor();
    while (true) {
      if (accept('*')) {
        result = result * factor();
      } else if (accept('/')) {
        result = result / factor();
      } else {
        return result;
      }
    }
  }

  Expression factor() {
    if (accept('-')) return Expression(0.0) - factor();
    const Expression base = atom();
    if (!accept('^')) return base;
    const char digit = peek();
    if (digit < '1' || digit > '9') fail("a whole exponent from 1 to 9");
    ++at_;
    Expression result = base;
    for (int i = 1; i < digit - '0'; ++i) result = result * base;
    return result;
  }

  Expression atom() {
    const char c = peek();
    if (accept('(')) {
      const Expression inner = sum();
      if (!accept(')')) fail("')'");
      return inner;
    }
    if (std::isalpha(static_cast<unsigned char>(c)) != 0 || c == '_') return parameter();
    char* end = nullptr;
    const double value = std::strtod(text_.c_str() + at_, &end);
    if (end == text_.c_str() + at_ || !std::isfinite(value)) fail("a finite number or a parameter");
    at_ = static_cast<std::size_t>(end - text_.c_str());
    return value;
  }

  Expression parameter() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '_'))
      ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    const auto found = parameters_.find(name);
    if (found == parameters_.end()) {
      at_ = begin;
      fail("a parameter, found \"" + name + "\"");
    }
    return Expression::formula(found->second, "p->" + name);
  }

  const std::string& text_;
  const std::map<std::string, double>& parameters_;
  std::size_t at_ = 0;
};

Expression Expression::parse(const std::string& text, const std::map<std::string, double>& parameters) {
  return ExpressionParser(text, parameters).parseAll();
}

ExpressionMatrix::ExpressionMatrix(int row_count, int column_count)
    : rows(row_count), columns(column_count), entries(static_cast<std::size_t>(row_count * column_count)) {}

ExpressionMatrix kroneckerProduct(const ExpressionMatrix& a, const ExpressionMatrix& b) {
  ExpressionMatrix result(a.rows * b.rows, a.columns * b.columns);
  for (int i = 0; i < result.rows; ++i) {
    for (int j = 0; j < result.columns; ++j) {
      result(i, j) = a(i / b.rows, j / b.columns) * b(i % b.rows, j % b.columns);
    }
  }
  return result;
}

}  // namespace codegen
}  // namespace swarm_planner
