// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/description.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fstream>
#include <set>
#include <sstream>

namespace swarm_planner {
namespace codegen {
namespace {

constexpr int kLargestSize = 100000;

bool isIdentifier(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name[0])) != 0) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// Reads one description and collects its faults.
class Reader {
 public:
  Description read(const std::string& text) {
    YAML::Node root;
    try {
      root = YAML::Load(text);
    } catch (const YAML::Exception& error) {
      throw DescriptionError(error.what());
    }
    if (!root.IsMap()) throw DescriptionError("expected a map at the top of the description");
    readAll(root);
    if (!faults_.str().empty()) throw DescriptionError(faults_.str());
    out_.hash = fnv1a(canonicalText());
    return out_;
  }

 private:
  void fault(const std::string& key, const std::string& message) { faults_ << key << ": " << message << "\n"; }

  void readAll(const YAML::Node& root) {
    allowKeys(root, "", {"name", "horizon", "states", "inputs", "parameters", "dynamics", "cost", "outputs",
                         "penalties", "limits", "instruction_sets"});
    if (root["name"]) out_.name = root["name"].as<std::string>("");
    if (!isIdentifier(out_.name)) fault("name", "expected a C identifier");
    out_.horizon = integer(root, "", "horizon", 1);
    out_.states = integer(root, "", "states", 1);
    out_.inputs = integer(root, "", "inputs", 1);
    if (!faults_.str().empty()) return;
    readParameters(root["parameters"]);
    readDynamics(root["dynamics"]);
    readCost(root["cost"]);
    readPenalties(root["penalties"]);
    readOutputs(root["outputs"]);
    readLimits(root["limits"]);
    readInstructionSets(root["instruction_sets"]);
  }

  void allowKeys(const YAML::Node& node, const std::string& where, const std::set<std::string>& keys) {
    if (!node || !node.IsMap()) return;
    for (const auto& item : node) {
      const std::string key = item.first.as<std::string>("");
      if (keys.count(key) == 0) fault(where + key, "unknown key");
    }
  }

  int integer(const YAML::Node& node, const std::string& where, const std::string& key, int least, int fallback = -1) {
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

  Expression number(const YAML::Node& node, const std::string& where) {
    try {
      if (node && node.IsScalar()) return Expression::parse(node.Scalar(), parameters_);
      fault(where, "expected a number or a formula");
    } catch (const std::invalid_argument& error) {
      fault(where, error.what());
    }
    return 0.0;
  }

  std::vector<Expression> list(const YAML::Node& node, const std::string& where) {
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

  /// A matrix is a list of rows, {diagonal: [...]}, {identity: n} or {kron: [matrix, matrix]}.
  ExpressionMatrix matrix(const YAML::Node& node, const std::string& where) {
    if (node && node.IsMap()) {
      allowKeys(node, where + ".", {"diagonal", "identity", "kron"});
      if (node["identity"]) return diagonal(std::vector<Expression>(
                                static_cast<std::size_t>(integer(node, where + ".", "identity", 1)), Expression(1.0)));
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

  ExpressionMatrix denseMatrix(const YAML::Node& node, const std::string& where) {
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

  static ExpressionMatrix diagonal(const std::vector<Expression>& entries) {
    const int n = static_cast<int>(entries.size());
    ExpressionMatrix result(n, n);
    for (int i = 0; i < n; ++i) result(i, i) = entries[static_cast<std::size_t>(i)];
    return result;
  }

  ExpressionMatrix sized(const YAML::Node& parent, const std::string& where, const std::string& key, int rows,
                         int columns, bool required) {
    if (!parent || !parent[key]) {
      if (required) fault(where + key, "missing");
      return ExpressionMatrix(rows, columns);
    }
    ExpressionMatrix result = matrix(parent[key], where + key);
    if (result.rows != rows || result.columns != columns) {
      fault(where + key, "expected " + std::to_string(rows) + " x " + std::to_string(columns) + ", found " +
                             std::to_string(result.rows) + " x " + std::to_string(result.columns));
      return ExpressionMatrix(rows, columns);
    }
    return result;
  }

  void readParameters(const YAML::Node& node) {
    if (!node) return;
    if (!node.IsMap()) {
      fault("parameters", "expected a map from names to default values");
      return;
    }
    for (const auto& item : node) {
      const std::string name = item.first.as<std::string>("");
      const double value = item.second.as<double>(std::nan(""));
      if (!isIdentifier(name)) fault("parameters." + name, "expected a C identifier");
      if (!std::isfinite(value)) fault("parameters." + name, "expected a finite number");
      if (!parameters_.emplace(name, value).second) fault("parameters." + name, "given twice");
      out_.parameters.emplace_back(name, value);
    }
  }

  void readDynamics(const YAML::Node& node) {
    allowKeys(node, "dynamics.", {"A", "B"});
    out_.a = sized(node, "dynamics.", "A", out_.states, out_.states, true);
    out_.b = sized(node, "dynamics.", "B", out_.states, out_.inputs, true);
  }

  void readCost(const YAML::Node& node) {
    allowKeys(node, "cost.", {"state", "terminal", "input", "rate", "input_linear"});
    out_.stage_cost = symmetric(sized(node, "cost.", "state", out_.states, out_.states, true), "cost.state");
    out_.terminal_cost = out_.stage_cost;
    if (node && node["terminal"]) {
      out_.terminal_cost = symmetric(sized(node, "cost.", "terminal", out_.states, out_.states, true), "cost.terminal");
    }
    out_.input_cost = symmetric(sized(node, "cost.", "input", out_.inputs, out_.inputs, false), "cost.input");
    if (node && node["rate"]) {
      out_.rate_cost = symmetric(sized(node, "cost.", "rate", out_.inputs, out_.inputs, true), "cost.rate");
    }
    if (node && node["input_linear"]) out_.input_linear = node["input_linear"].as<bool>(false);
  }

  ExpressionMatrix symmetric(const ExpressionMatrix& m, const std::string& where) {
    for (int i = 0; i < m.rows; ++i) {
      for (int j = 0; j < i; ++j) {
        if (m(i, j) != m(j, i)) {
          fault(where, "is not symmetric");
          return m;
        }
      }
    }
    return m;
  }

  void readPenalties(const YAML::Node& node) {
    if (!node) return;
    if (!node.IsMap()) {
      fault("penalties", "expected a map from names to {linear, quadratic}");
      return;
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
      out_.penalties.push_back(penalty);
    }
  }

  int penaltyIndex(const YAML::Node& node, const std::string& where) {
    if (!node["penalty"]) return -1;
    const std::string name = node["penalty"].as<std::string>("");
    for (std::size_t i = 0; i < out_.penalties.size(); ++i) {
      if (out_.penalties[i].name == name) return static_cast<int>(i);
    }
    fault(where + "penalty", "no penalty is called \"" + name + "\"");
    return -1;
  }

  void readOutputs(const YAML::Node& node) {
    if (!node || !node.IsMap() || node.size() == 0) {
      fault("outputs", "expected a map of at least one output");
      return;
    }
    for (const auto& item : node) {
      const std::string name = item.first.as<std::string>("");
      if (!isIdentifier(name)) fault("outputs." + name, "expected a C identifier");
      readOutput(name, item.second);
    }
  }

  void readOutput(const std::string& name, const YAML::Node& node) {
    const std::string where = "outputs." + name + ".";
    allowKeys(node, where, {"state", "input", "rows", "bounds"});
    Output output;
    output.name = name;
    if (node["state"]) output.state = matrix(node["state"], where + "state");
    if (node["input"]) output.input = matrix(node["input"], where + "input");
    const int size = std::max(output.state.rows, output.input.rows);
    if (output.state.empty()) output.state = ExpressionMatrix(size, out_.states);
    if (output.input.empty()) output.input = ExpressionMatrix(size, out_.inputs);
    if (size == 0 || output.state.rows != size || output.input.rows != size || output.state.columns != out_.states ||
        output.input.columns != out_.inputs) {
      fault("outputs." + name, "needs state (m x states) or input (m x inputs) or both");
      return;
    }
    if (node["rows"]) {
      allowKeys(node["rows"], where + "rows.", {"most_per_stage", "penalty"});
      output.max_rows = integer(node["rows"], where + "rows.", "most_per_stage", 1);
      output.row_penalty = penaltyIndex(node["rows"], where + "rows.");
    }
    if (node["bounds"]) readBounds(node["bounds"], where + "bounds.", output);
    for (int i = 0; i < size; ++i) checkComponent(output, i);
    out_.outputs.push_back(output);
  }

  void checkComponent(const Output& output, int row) {
    bool touched = false;
    for (int j = 0; j < out_.states; ++j) touched = touched || !output.state(row, j).isZero();
    for (int j = 0; j < out_.inputs; ++j) touched = touched || !output.input(row, j).isZero();
    if (!touched) fault("outputs." + output.name, "component " + std::to_string(row) + " touches nothing");
  }

  void readBounds(const YAML::Node& node, const std::string& where, Output& output) {
    allowKeys(node, where, {"lower", "upper", "penalty"});
    const auto size = static_cast<std::size_t>(output.size());
    output.bounded = true;
    output.lower.assign(size, Expression(-kUnbounded));
    output.upper.assign(size, Expression(kUnbounded));
    if (node["lower"]) output.lower = list(node["lower"], where + "lower");
    if (node["upper"]) output.upper = list(node["upper"], where + "upper");
    if (output.lower.size() != size || output.upper.size() != size) {
      fault(where, "expected " + std::to_string(size) + " numbers each");
    }
    output.bound_penalty = penaltyIndex(node, where);
  }

  void readLimits(const YAML::Node& node) {
    allowKeys(node, "limits.", {"active", "changes", "quadratic_terms"});
    out_.max_active = integer(node, "limits.", "active", 1, std::min(64, 2 * out_.horizon * out_.inputs));
    out_.max_changes = integer(node, "limits.", "changes", 1, 400);
    out_.max_quadratic = integer(node, "limits.", "quadratic_terms", 0, 0);
    if (out_.max_quadratic > out_.max_active) fault("limits.quadratic_terms", "exceeds limits.active");
  }

  void readInstructionSets(const YAML::Node& node) {
    const std::vector<std::string> known{"baseline", "avx2", "avx512"};
    if (!node) out_.instruction_sets = known;
    for (const auto& item : node) {
      const std::string name = item.as<std::string>("");
      if (std::count(known.begin(), known.end(), name) == 0) fault("instruction_sets", "unknown: \"" + name + "\"");
      out_.instruction_sets.push_back(name);
    }
    if (out_.instruction_sets.empty()) fault("instruction_sets", "expected at least one");
  }

  static void append(std::ostringstream& text, const char* key, const ExpressionMatrix& m) {
    text << key << m.rows << 'x' << m.columns;
    for (const Expression& e : m.entries) text << ',' << e.code();
    text << ';';
  }

  /// Everything that decides what the generated code computes, independent of spelling in the file.
  std::string canonicalText() const {
    std::ostringstream text;
    text << out_.name << ';' << out_.horizon << ';' << out_.states << ';' << out_.inputs << ';';
    for (const auto& p : out_.parameters) text << p.first << '=' << toCode(p.second) << ';';
    append(text, "A", out_.a);
    append(text, "B", out_.b);
    append(text, "Q", out_.stage_cost);
    append(text, "QN", out_.terminal_cost);
    append(text, "R", out_.input_cost);
    append(text, "S", out_.rate_cost);
    text << out_.input_linear << ';';
    for (const Penalty& p : out_.penalties) text << p.name << p.linear.code() << '/' << p.quadratic.code() << ';';
    for (const Output& o : out_.outputs) {
      text << o.name << ';';
      append(text, "C", o.state);
      append(text, "D", o.input);
      text << o.max_rows << ',' << o.row_penalty << ',' << o.bounded << ',' << o.bound_penalty << ';';
      for (const Expression& e : o.lower) text << e.code() << ',';
      for (const Expression& e : o.upper) text << e.code() << ',';
    }
    text << out_.max_active << ';' << out_.max_changes << ';' << out_.max_quadratic;
    return text.str();
  }

  static std::uint64_t fnv1a(const std::string& text) {
    std::uint64_t hash = 14695981039346656037ull;
    for (const unsigned char c : text) hash = (hash ^ c) * 1099511628211ull;
    return hash;
  }

  Description out_;
  std::map<std::string, double> parameters_;
  std::ostringstream faults_;
};

}  // namespace

bool Output::touchesInput() const {
  return std::any_of(input.entries.begin(), input.entries.end(), [](const Expression& e) { return !e.isZero(); });
}

Description parseDescription(const std::string& yaml_text) { return Reader().read(yaml_text); }

Description loadDescription(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw DescriptionError(path + ": cannot be read");
  std::ostringstream text;
  text << file.rdbuf();
  return parseDescription(text.str());
}

}  // namespace codegen
}  // namespace swarm_planner
