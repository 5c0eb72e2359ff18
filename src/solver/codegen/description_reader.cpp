// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "description_reader.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>

namespace swarm_planner {
namespace codegen {
namespace {

constexpr int kLargestSize = 100000;

ExpressionMatrix diagonal(const std::vector<Expression>& entries) {
  const int n = static_cast<int>(entries.size());
  ExpressionMatrix result(n, n);
  for (int i = 0; i < n; ++i) result(i, i) = entries[static_cast<std::size_t>(i)];
  return result;
}

}  // namespace

YAML::Node parseMap(const std::string& yaml_text) {
  YAML::Node root;
  try {
    root = YAML::Load(yaml_text);
  } catch (const YAML::Exception& error) {
    throw DescriptionError(error.what());
  }
  if (!root.IsMap()) throw DescriptionError("expected a map at the top of the description");
  return root;
}

std::string readText(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw DescriptionError(path + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::string readDescriptionText(const std::string& path) {
  const std::string text = readText(path);
  YAML::Node root = parseMap(text);
  if (!root["base"]) return text;
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "" : path.substr(0, slash + 1);
  YAML::Node merged = parseMap(readText(folder + root["base"].as<std::string>("")));
  if (merged["base"]) throw DescriptionError(path + ": base: has a base itself");
  root.remove("base");
  for (const auto& item : root) merged[item.first.as<std::string>("")] = item.second;
  return YAML::Dump(merged);
}

bool isIdentifier(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

std::uint64_t fnv1a(const std::string& text) {
  std::uint64_t hash = 14695981039346656037ull;
  for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ull;
  return hash;
}

void DescriptionReader::throwFaults() const {
  if (faulty()) throw DescriptionError(faults_.str());
}

void DescriptionReader::allowKeys(const YAML::Node& node, const std::string& where, const std::set<std::string>& keys) {
  if (!node || !node.IsMap()) return;
  for (const auto& item : node) {
    const std::string key = item.first.as<std::string>("");
    if (keys.count(key) == 0) fault(where + key, "unknown key");
  }
}

int DescriptionReader::integer(const YAML::Node& node, const std::string& where, const std::string& key, int least,
                               int fallback) {
  if (!node || !node[key]) {
    if (fallback < 0) fault(where + key, "missing");
    return std::max(fallback, least);
  }
  const int value = node[key].as<int>(-1);
  if (value < least || value > kLargestSize) {
    fault(where + key, "expected a whole number from " + std::to_string(least));
    return least;
  }
  return value;
}

Expression DescriptionReader::number(const YAML::Node& node, const std::string& where) {
  try {
    if (node && node.IsScalar()) return Expression::parse(node.Scalar(), parameters_);
    fault(where, "expected a number or a formula");
  } catch (const std::invalid_argument& error) {
    fault(where, error.what());
  }
  return 0.0;
}

std::vector<Expression> DescriptionReader::list(const YAML::Node& node, const std::string& where) {
  std::vector<Expression> result;
  if (!node || !node.IsSequence()) {
    fault(where, "expected a list");
    return result;
  }
  for (std::size_t i = 0; i < node.size(); ++i) {
    result.push_back(number(node[i], where + "[" + std::to_string(i) + "]"));
  }
  return result;
}

ExpressionMatrix DescriptionReader::matrix(const YAML::Node& node, const std::string& where) {
  if (node && node.IsMap()) {
    allowKeys(node, where + ".", {"diagonal", "identity", "kron"});
    if (node["identity"]) {
      const int size = integer(node, where + ".", "identity", 1);
      return diagonal(std::vector<Expression>(static_cast<std::size_t>(size), Expression(1.0)));
    }
    if (node["diagonal"]) return diagonal(list(node["diagonal"], where + ".diagonal"));
    if (node["kron"] && node["kron"].IsSequence() && node["kron"].size() == 2) {
      return kroneckerProduct(matrix(node["kron"][0], where + ".kron[0]"), matrix(node["kron"][1], where + ".kron[1]"));
    }
  }
  if (!node || !node.IsSequence() || node.size() == 0) {
    fault(where, "expected a list of rows, {diagonal: [...]}, {identity: n} or {kron: [matrix, matrix]}");
    return {};
  }
  return denseMatrix(node, where);
}

ExpressionMatrix DescriptionReader::denseMatrix(const YAML::Node& node, const std::string& where) {
  ExpressionMatrix result;
  result.rows = static_cast<int>(node.size());
  for (std::size_t i = 0; i < node.size(); ++i) {
    const std::vector<Expression> row = list(node[i], where + "[" + std::to_string(i) + "]");
    if (i == 0) result.columns = static_cast<int>(row.size());
    if (static_cast<int>(row.size()) != result.columns) {
      fault(where, "rows differ in length");
      return {};
    }
    result.entries.insert(result.entries.end(), row.begin(), row.end());
  }
  return result;
}

std::string DescriptionReader::readName(const YAML::Node& root) {
  const std::string name = root["name"] ? root["name"].as<std::string>("") : "";
  if (!isIdentifier(name)) fault("name", "expected a C identifier");
  return name;
}

std::vector<std::pair<std::string, double>> DescriptionReader::readParameters(const YAML::Node& node) {
  std::vector<std::pair<std::string, double>> result;
  if (!node) return result;
  if (!node.IsMap()) {
    fault("parameters", "expected a map from names to default values");
    return result;
  }
  for (const auto& item : node) {
    const std::string name = item.first.as<std::string>("");
    const double value = item.second.as<double>(std::nan(""));
    if (!isIdentifier(name)) fault("parameters." + name, "expected a C identifier");
    if (!std::isfinite(value)) fault("parameters." + name, "expected a finite number");
    if (!parameters_.emplace(name, value).second) fault("parameters." + name, "given twice");
    result.emplace_back(name, value);
  }
  return result;
}

std::vector<Penalty> DescriptionReader::readPenalties(const YAML::Node& node) {
  std::vector<Penalty> result;
  if (!node) return result;
  if (!node.IsMap()) {
    fault("penalties", "expected a map from names to {linear, quadratic}");
    return result;
  }
  for (const auto& item : node) {
    Penalty penalty;
    penalty.name = item.first.as<std::string>("");
    const std::string where = "penalties." + penalty.name + ".";
    if (!isIdentifier(penalty.name)) fault("penalties." + penalty.name, "expected a C identifier");
    allowKeys(item.second, where, {"linear", "quadratic"});
    penalty.linear = number(item.second["linear"], where + "linear");
    penalty.quadratic = number(item.second["quadratic"], where + "quadratic");
    if (penalty.linear.value() < 0.0) fault(where + "linear", "expected at least 0");
    if (!(penalty.quadratic.value() > 0.0)) fault(where + "quadratic", "expected more than 0");
    result.push_back(penalty);
  }
  return result;
}

std::vector<std::string> DescriptionReader::readInstructionSets(const YAML::Node& node) {
  const std::vector<std::string> known{"baseline", "avx2", "avx512"};
  if (!node) return known;
  std::vector<std::string> result;
  for (const auto& item : node) {
    const std::string name = item.as<std::string>("");
    if (std::count(known.begin(), known.end(), name) == 0) fault("instruction_sets", "unknown: \"" + name + "\"");
    result.push_back(name);
  }
  if (result.empty()) fault("instruction_sets", "expected at least one");
  return result;
}

int DescriptionReader::findPenalty(const std::vector<Penalty>& penalties, const std::string& name,
                                   const std::string& where) {
  for (std::size_t i = 0; i < penalties.size(); ++i) {
    if (penalties[i].name == name) return static_cast<int>(i);
  }
  fault(where, "no penalty is called \"" + name + "\"");
  return -1;
}

}  // namespace codegen
}  // namespace swarm_planner
