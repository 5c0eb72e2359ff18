// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/description.hpp"

#include <algorithm>
#include <set>
#include <sstream>

#include "description_reader.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

/// Reads one description of the kind with stages.
class Reader : private DescriptionReader {
 public:
  Description read(const YAML::Node& root) {
    readAll(root);
    throwFaults();
    out_.hash = fnv1a(canonicalText());
    return out_;
  }

 private:
  void readAll(const YAML::Node& root) {
    allowKeys(root, "",
              {"name", "horizon", "states", "inputs", "parameters", "dynamics", "cost", "outputs", "penalties",
               "copies", "limits", "instruction_sets"});
    out_.name = readName(root);
    out_.horizon = integer(root, "", "horizon", 1);
    out_.states = integer(root, "", "states", 1);
    out_.inputs = integer(root, "", "inputs", 1);
    if (faulty()) return;
    out_.parameters = readParameters(root["parameters"]);
    readDynamics(root["dynamics"]);
    readCost(root["cost"]);
    out_.penalties = readPenalties(root["penalties"]);
    readOutputs(root["outputs"]);
    readCopies(root["copies"]);
    readLimits(root["limits"]);
    out_.instruction_sets = readInstructionSets(root["instruction_sets"]);
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

  int penaltyIndex(const YAML::Node& node, const std::string& where) {
    if (!node["penalty"]) return -1;
    return findPenalty(out_.penalties, node["penalty"].as<std::string>(""), where + "penalty");
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

  void readCopies(const YAML::Node& node) {
    if (!node) return;
    allowKeys(node, "copies.", {"most", "couplings"});
    out_.copies = integer(node, "copies.", "most", 2);
    out_.max_couplings = integer(node, "copies.", "couplings", 1);
  }

  void readLimits(const YAML::Node& node) {
    allowKeys(node, "limits.", {"active", "changes", "quadratic_terms"});
    out_.max_active = integer(node, "limits.", "active", 1, std::min(64, 2 * out_.horizon * out_.inputs));
    out_.max_changes = integer(node, "limits.", "changes", 1, 400);
    out_.max_quadratic = integer(node, "limits.", "quadratic_terms", 0, 0);
    if (out_.copies * out_.max_quadratic > out_.max_active) fault("limits.quadratic_terms", "exceeds limits.active");
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
    if (out_.copies > 1) text << ';' << out_.copies << ';' << out_.max_couplings;
    return text.str();
  }

  Description out_;
};

}  // namespace

bool Output::touchesInput() const {
  return std::any_of(input.entries.begin(), input.entries.end(), [](const Expression& e) { return !e.isZero(); });
}

Description parseDescription(const std::string& yaml_text) { return Reader().read(parseMap(yaml_text)); }

Description loadDescription(const std::string& path) { return parseDescription(readDescriptionText(path)); }

}  // namespace codegen
}  // namespace swarm_planner
