// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "number_text.hpp"

#include <cmath>
#include <limits>
#include <locale>
#include <sstream>

namespace swarm_planner {

namespace {

/// From here on whole numbers are written with an exponent.
constexpr double kLeastWithExponent = 1e15;

bool isDigit(char character) { return character >= '0' && character <= '9'; }

/// Skips digits from `position` on and returns how many there were.
std::size_t skipDigits(const std::string& text, std::size_t& position) {
  const std::size_t begin = position;
  while (position < text.size() && isDigit(text[position])) ++position;
  return position - begin;
}

std::size_t skipSign(const std::string& text, std::size_t position) {
  return position < text.size() && (text[position] == '+' || text[position] == '-') ? position + 1 : position;
}

/// [-+]? (digits [. digits?] | . digits) ([eE] [-+]? digits)?, the float of YAML's core schema.
bool isDecimal(const std::string& text) {
  std::size_t position = skipSign(text, 0);
  std::size_t digits = skipDigits(text, position);
  if (position < text.size() && text[position] == '.') {
    ++position;
    digits += skipDigits(text, position);
  }
  if (digits == 0) return false;
  if (position < text.size() && (text[position] == 'e' || text[position] == 'E')) {
    position = skipSign(text, position + 1);
    if (skipDigits(text, position) == 0) return false;
  }
  return position == text.size();
}

std::string formatWithPrecision(double number, int precision) {
  std::ostringstream stream;
  stream.imbue(std::locale::classic());
  stream.precision(precision);
  stream << number;
  return stream.str();
}

}  // namespace

std::optional<double> parseNumber(const std::string& text) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
  const std::size_t after_sign = skipSign(text, 0);
  const bool negative = after_sign == 1 && text[0] == '-';
  const std::string magnitude = text.substr(after_sign);
  if (magnitude == ".inf" || magnitude == ".Inf" || magnitude == ".INF") return negative ? -kInfinity : kInfinity;
  if (text == ".nan" || text == ".NaN" || text == ".NAN") return kNoNumber;
  if (!isDecimal(text)) return std::nullopt;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  double number = 0.0;
  stream >> number;
  // A well-formed literal fails only by its size: too large, or (in some libraries) too close to zero.
  if (stream.fail() && std::abs(number) > 1.0) return kNoNumber;
  return number;
}

std::optional<int> parseWholeNumber(const std::string& text) {
  std::size_t position = skipSign(text, 0);
  if (skipDigits(text, position) == 0 || position != text.size()) return std::nullopt;
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  int number = 0;
  stream >> number;
  if (stream.fail()) return std::nullopt;
  return number;
}

std::string formatNumber(double number) {
  if (std::isnan(number)) return ".nan";
  if (std::isinf(number)) return number > 0.0 ? ".inf" : "-.inf";
  std::string text;
  for (int precision = 1; precision <= std::numeric_limits<double>::max_digits10; ++precision) {
    text = formatWithPrecision(number, precision);
    if (parseNumber(text) == number) break;
  }
  if (std::abs(number) >= 1.0 && std::abs(number) < kLeastWithExponent && text.find('e') != std::string::npos) {
    text = formatWithPrecision(number, std::numeric_limits<double>::digits10);
  }
  // YAML 1.1 readers, such as rosparam's, take 1e-05 for text: they want a point in the mantissa.
  const std::size_t exponent = text.find('e');
  if (exponent != std::string::npos && text.find('.') == std::string::npos) text.insert(exponent, ".0");
  return text;
}

}  // namespace swarm_planner
