// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/sparse_description.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "canonical_text.hpp"
#include "description_reader.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

/// The formula that `varies` is read as.
const char* const kVaries = "p->varies";

bool mentionsVaries(const std::string& code) {
  const std::string word = kVaries;
  for (std::size_t at = code.find(word); at != std::string::npos; at = code.find(word, at + 1)) {
    const char next = at + word.size() < code.size() ? code[at + word.size()] : ' ';
    if (std::isalnum(static_cast<unsigned char>(next)) == 0 && next != '_') return true;
  }
  return false;
}

std::string position(int row, int column) {
  return "entry (" + std::to_string(row) + ", " + std::to_string(column) + ")";
}

/// Reads one description of the sparse kind.
class SparseReader : private DescriptionReader {
 public:
  SparseDescription read(const YAML::Node& root) {
    allowKeys(root, "",
              {"name", "variables", "parameters", "hessian", "linear", "bounds", "equalities", "inequalities",
               "penalties", "limits", "instruction_sets"});
    out_.name = readName(root);
    readVariables(root["variables"]);
    if (out_.variables < 1) throwFaults();
    out_.parameters = readParameters(root["parameters"]);
    if (parameters_.count("varies") > 0) fault("parameters.varies", "the name is taken");
    parameters_["varies"] = 0.0;
    out_.penalties = readPenalties(root["penalties"]);
    for (Penalty& penalty : out_.penalties) rejectVaries(penalty);
    readHessian(root["hessian"]);
    out_.linear = vector(root["linear"], "linear", out_.variables, 0.0, out_.variable_groups);
    readBounds(root["bounds"]);
    out_.matrix.columns = out_.variables;
    readEqualities(root["equalities"]);
    readInequalities(root["inequalities"]);
    allowKeys(root["limits"], "limits.", {"iterations"});
    out_.max_iterations = integer(root["limits"], "limits.", "iterations", 1, 60);
    out_.instruction_sets = readInstructionSets(root["instruction_sets"]);
    throwFaults();
    out_.hash = fnv1a(canonicalText(out_));
    return out_;
  }

 private:
  using Entries = std::map<std::pair<int, int>, Datum>;

  Datum datum(const Expression& e, const std::string& where) {
    if (e.code() == kVaries) return {0.0, true};
    if (mentionsVaries(e.code())) fault(where, "`varies` stands alone, not in a formula");
    return {e, false};
  }

  void rejectVaries(const Penalty& penalty) {
    if (mentionsVaries(penalty.linear.code() + " " + penalty.quadratic.code())) {
      fault("penalties." + penalty.name, "a penalty cannot vary; rows may choose another one at run time");
    }
  }

  /// A number of variables, or names with numbers.
  void readVariables(const YAML::Node& node) {
    if (node && node.IsMap()) {
      for (const auto& item : node) {
        Group group{item.first.as<std::string>(""), out_.variables, item.second.as<int>(0)};
        if (!isIdentifier(group.name)) fault("variables." + group.name, "expected a C identifier");
        if (group.count < 1) fault("variables." + group.name, "expected a whole number from 1");
        if (!places_.emplace(group.name, group.first).second) fault("variables." + group.name, "given twice");
        out_.variables += std::max(group.count, 0);
        out_.variable_groups.push_back(group);
      }
    } else {
      out_.variables = node ? node.as<int>(0) : 0;
    }
    if (out_.variables < 1 || out_.variables > 100000)
      fault("variables", "expected a whole number from 1, or a map of them");
  }

  /// An index: a whole number or a formula with the names of groups of variables, which stand for their first.
  int index(const YAML::Node& node, const std::string& where) {
    try {
      if (!node || !node.IsScalar()) throw std::invalid_argument("expected a whole number");
      const double value = Expression::parse(node.Scalar(), places_).value();
      if (std::abs(value) < 1e6 && value == std::floor(value)) return static_cast<int>(value);
      fault(where, "expected a whole number");
    } catch (const std::invalid_argument& error) {
      fault(where, error.what());
    }
    return 0;
  }

  std::pair<int, int> indexPair(const YAML::Node& node, const std::string& where) {
    if (!node || !node.IsSequence() || node.size() != 2) {
      fault(where, "expected [row, column]");
      return {0, 0};
    }
    return {index(node[0], where + "[0]"), index(node[1], where + "[1]")};
  }

  void put(const SparseMatrix& shape, Entries& entries, int row, int column, const Datum& value,
           const std::string& where) {
    if (row < 0 || row >= shape.rows || column < 0 || column >= shape.columns) {
      fault(where, position(row, column) + " lies outside " + std::to_string(shape.rows) + " x " +
                       std::to_string(shape.columns));
    } else if (!value.varies && value.value.isZero()) {
      return;
    } else if (!entries.emplace(std::make_pair(row, column), value).second) {
      fault(where, position(row, column) + " is given twice");
    }
  }

  /// A list of [row, column, value] and of maps: see readPattern.
  Entries sparseMatrix(const YAML::Node& node, const std::string& where, const SparseMatrix& shape) {
    Entries entries;
    if (!node || !node.IsSequence()) {
      fault(where, "expected a list of [row, column, value] and patterns {at: [row, column], ...}");
      return entries;
    }
    for (std::size_t i = 0; i < node.size(); ++i) {
      const std::string here = where + "[" + std::to_string(i) + "]";
      if (node[i].IsMap()) {
        readPattern(node[i], here, shape, entries);
      } else if (node[i].IsSequence() && node[i].size() == 3) {
        put(shape, entries, index(node[i][0], here + "[0]"), index(node[i][1], here + "[1]"),
            datum(number(node[i][2], here + "[2]"), here + "[2]"), here);
      } else {
        fault(here, "expected [row, column, value] or {at: [row, column], ...}");
      }
    }
    return entries;
  }

  /// {at, block: matrix}, {at, size, value} or {at, size, diagonals: {column - row: value}}, each with repeat and step.
  void readPattern(const YAML::Node& node, const std::string& where, const SparseMatrix& shape, Entries& entries) {
    allowKeys(node, where + ".", {"at", "block", "size", "value", "diagonals", "repeat", "step"});
    const auto at = indexPair(node["at"], where + ".at");
    ExpressionMatrix block;
    if (node["block"]) {
      block = matrix(node["block"], where + ".block");
    } else {
      const auto size = indexPair(node["size"], where + ".size");
      if (size.first < 1 || size.second < 1 || size.first > shape.rows || size.second > shape.columns) {
        fault(where, "needs block: matrix, or size: [rows, columns] within the matrix, with value or diagonals");
        return;
      }
      block = ExpressionMatrix(size.first, size.second);
      fillPattern(node, where, block);
    }
    const int repeat = integer(node, where + ".", "repeat", 1, 1);
    std::pair<int, int> step{block.rows, block.columns};
    if (node["step"]) step = indexPair(node["step"], where + ".step");
    for (int copy = 0; copy < repeat; ++copy) {
      for (int i = 0; i < block.rows; ++i) {
        for (int j = 0; j < block.columns; ++j) {
          put(shape, entries, at.first + copy * step.first + i, at.second + copy * step.second + j,
              datum(block(i, j), where), where);
        }
      }
    }
  }

  void fillPattern(const YAML::Node& node, const std::string& where, ExpressionMatrix& block) {
    if (node["value"]) {
      std::fill(block.entries.begin(), block.entries.end(), number(node["value"], where + ".value"));
      return;
    }
    if (!node["diagonals"] || !node["diagonals"].IsMap()) {
      fault(where, "needs block, value or diagonals");
      return;
    }
    for (const auto& item : node["diagonals"]) {
      const int offset = index(item.first, where + ".diagonals");
      const Expression value = number(item.second, where + ".diagonals");
      for (int i = 0; i < block.rows; ++i) {
        if (i + offset >= 0 && i + offset < block.columns) block(i, i + offset) = value;
      }
    }
  }

  /// The lower triangle: an entry also stands for its mirror image, and may be given on both sides if it is the same.
  void readHessian(const YAML::Node& node) {
    out_.hessian.rows = out_.hessian.columns = out_.variables;
    if (!node) return;
    const Entries given = sparseMatrix(node, "hessian", out_.hessian);
    Entries lower;
    for (const auto& item : given) {
      const auto mirrored = given.find({item.first.second, item.first.first});
      if (mirrored != given.end() &&
          (mirrored->second.varies != item.second.varies || mirrored->second.value != item.second.value)) {
        if (item.first.first > item.first.second) {
          fault("hessian", position(item.first.first, item.first.second) + " differs from its mirror image");
        }
      }
      if (item.first.first == item.first.second && item.second.value.value() < 0.0) {
        fault("hessian", position(item.first.first, item.first.second) + " is negative: not positive semidefinite");
      }
      lower.emplace(
          std::make_pair(std::max(item.first.first, item.first.second), std::min(item.first.first, item.first.second)),
          item.second);
    }
    append(lower, 0, out_.hessian);
  }

  static void append(const Entries& entries, int first_row, SparseMatrix& to) {
    for (const auto& item : entries) {
      to.entries.push_back({first_row + item.first.first, item.first.second, item.second});
    }
  }

  /// A number for `none` and infinities of the right sign.
  Datum vectorEntry(const YAML::Node& node, const std::string& where, double none) {
    const std::string text = node.IsScalar() ? node.Scalar() : "";
    if (std::abs(none) == kUnbounded && (text == "none" || text == (none > 0.0 ? ".inf" : "-.inf")))
      return {none, false};
    Datum result = datum(number(node, where), where);
    if (result.varies) result.value = none;
    return result;
  }

  /// A list, one number for all, or numbers and lists for groups; without: `none` everywhere.
  std::vector<Datum> vector(const YAML::Node& node, const std::string& where, int size, double none,
                            const std::vector<Group>& groups = {}) {
    std::vector<Datum> result(static_cast<std::size_t>(size), Datum{none, false});
    if (!node || node.IsNull()) return result;
    if (node.IsScalar()) {
      std::fill(result.begin(), result.end(), vectorEntry(node, where, none));
    } else if (node.IsSequence()) {
      if (node.size() != result.size()) {
        fault(where, "expected " + std::to_string(size) + " numbers, found " + std::to_string(node.size()));
        return result;
      }
      for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = vectorEntry(node[i], where + "[" + std::to_string(i) + "]", none);
      }
    } else if (!groups.empty()) {
      for (const auto& item : node) {
        const std::string name = item.first.as<std::string>("");
        const auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) { return g.name == name; });
        if (group == groups.end()) {
          fault(where + "." + name, "no variables are called so");
          continue;
        }
        const std::vector<Datum> part = vector(item.second, where + "." + name, group->count, none);
        std::copy(part.begin(), part.end(), result.begin() + group->first);
      }
    } else {
      fault(where, "expected a number or a list");
    }
    return result;
  }

  void checkBounds(const std::vector<Datum>& lower, const std::vector<Datum>& upper, const std::string& where) {
    for (std::size_t i = 0; i < lower.size(); ++i) {
      if (lower[i].varies || upper[i].varies || lower[i].value.value() <= upper[i].value.value()) continue;
      fault(where, "lower[" + std::to_string(i) + "] exceeds upper[" + std::to_string(i) + "]");
    }
  }

  void readBounds(const YAML::Node& node) {
    allowKeys(node, "bounds.", {"lower", "upper"});
    const YAML::Node none;
    const bool given = node && node.IsMap();
    if (node && !given) fault("bounds", "expected {lower: ..., upper: ...}");
    out_.lower =
        vector(given ? node["lower"] : none, "bounds.lower", out_.variables, -kUnbounded, out_.variable_groups);
    out_.upper = vector(given ? node["upper"] : none, "bounds.upper", out_.variables, kUnbounded, out_.variable_groups);
    checkBounds(out_.lower, out_.upper, "bounds");
  }

  /// The next group of rows: its matrix goes to the end of A.
  bool readRows(const std::string& name, const YAML::Node& node, const std::string& where, Group& group) {
    if (!isIdentifier(name)) fault(where, "expected a C identifier");
    if (!row_names_.insert(name).second) fault(where, "given twice");
    if (!node.IsMap()) {
      fault(where, "expected a map");
      return false;
    }
    group = {name, out_.matrix.rows, integer(node, where + ".", "rows", 1)};
    SparseMatrix shape{group.count, out_.variables, {}};
    const Entries entries = sparseMatrix(node["matrix"], where + ".matrix", shape);
    std::vector<bool> touched(static_cast<std::size_t>(group.count));
    for (const auto& item : entries) touched[static_cast<std::size_t>(item.first.first)] = true;
    for (int i = 0; i < group.count && node["matrix"]; ++i) {
      if (!touched[static_cast<std::size_t>(i)]) fault(where, "row " + std::to_string(i) + " touches no variable");
    }
    append(entries, group.first, out_.matrix);
    out_.matrix.rows += group.count;
    out_.row_groups.push_back(group);
    return true;
  }

  static void extend(std::vector<Datum>& to, const std::vector<Datum>& from) {
    to.insert(to.end(), from.begin(), from.end());
  }

  void readEqualities(const YAML::Node& node) {
    if (!node) return;
    if (!node.IsMap()) fault("equalities", "expected a map from names to {rows, matrix, right}");
    for (const auto& item : node) {
      Group group;
      const std::string name = item.first.as<std::string>(""), where = "equalities." + name;
      if (!readRows(name, item.second, where, group)) continue;
      allowKeys(item.second, where + ".", {"rows", "matrix", "right"});
      const std::vector<Datum> right = vector(item.second["right"], where + ".right", group.count, 0.0);
      extend(out_.row_lower, right);
      extend(out_.row_upper, right);
      out_.row_penalty.resize(static_cast<std::size_t>(out_.matrix.rows), -1);
    }
    out_.equalities = out_.matrix.rows;
  }

  void readInequalities(const YAML::Node& node) {
    if (!node) return;
    if (!node.IsMap()) fault("inequalities", "expected a map from names to {rows, matrix, lower, upper, penalty}");
    for (const auto& item : node) {
      Group group;
      const std::string name = item.first.as<std::string>(""), where = "inequalities." + name;
      if (!readRows(name, item.second, where, group)) continue;
      allowKeys(item.second, where + ".", {"rows", "matrix", "lower", "upper", "penalty"});
      if (!item.second["lower"] && !item.second["upper"]) fault(where, "needs lower or upper or both");
      const auto lower = vector(item.second["lower"], where + ".lower", group.count, -kUnbounded);
      const auto upper = vector(item.second["upper"], where + ".upper", group.count, kUnbounded);
      checkBounds(lower, upper, where);
      extend(out_.row_lower, lower);
      extend(out_.row_upper, upper);
      readRowPenalties(item.second["penalty"], where + ".penalty", group.count);
    }
  }

  /// One name for all rows, or a list; `hard` for none.
  void readRowPenalties(const YAML::Node& node, const std::string& where, int count) {
    if (node && node.IsSequence() && static_cast<int>(node.size()) != count) {
      fault(where, "expected " + std::to_string(count) + " names");
    }
    for (int i = 0; i < count; ++i) {
      const YAML::Node one = node && node.IsSequence() ? node[i] : node;
      const std::string name = one ? one.as<std::string>("") : "hard";
      out_.row_penalty.push_back(name == "hard" ? -1 : findPenalty(out_.penalties, name, where));
      if (out_.row_penalty.back() < 0 && name != "hard") {
        out_.row_penalty.resize(static_cast<std::size_t>(out_.matrix.rows), -1);
        return;
      }
    }
  }

  SparseDescription out_;
  std::map<std::string, double> places_;
  std::set<std::string> row_names_;
};

}  // namespace

bool isSparseDescription(const std::string& yaml_text) {
  const YAML::Node root = parseMap(yaml_text);
  return root["variables"].IsDefined();
}

SparseDescription parseSparseDescription(const std::string& yaml_text) {
  return SparseReader().read(parseMap(yaml_text));
}

}  // namespace codegen
}  // namespace swarm_planner
