// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <sstream>

#include "swarm_planner/solver/codegen/generator.hpp"
#include "write_common.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

int sizeOf(const std::vector<int>& v) { return static_cast<int>(v.size()); }

/// The narrowest integer type for the values: tables stay in the processor's cache.
std::string integerType(const std::vector<int>& values, bool may_be_negative = false) {
  const auto range = std::minmax_element(values.begin(), values.end());
  const int least = values.empty() ? 0 : *range.first, most = values.empty() ? 0 : *range.second;
  if (!may_be_negative && most < 256) return "uint8_t";
  if (!may_be_negative && most < 65536) return "uint16_t";
  return least >= -32768 && most < 32768 ? "int16_t" : "int32_t";
}

template <typename Value, typename ToText>
void writeValues(std::ostringstream& out, const std::vector<Value>& values, const ToText& text) {
  out << "[" << std::max<std::size_t>(values.size(), 1) << "] = {";
  for (std::size_t i = 0; i < values.size(); ++i) out << (i % 16 == 0 ? "\n    " : " ") << text(values[i]) << ",";
  out << (values.empty() ? "0" : "") << "};\n";
}

/// @param may_be_negative -1 stands for "none", in this description or in others
void table(std::ostringstream& out, const std::string& name, const std::vector<int>& values,
           bool may_be_negative = false) {
  out << "static const " << integerType(values, may_be_negative) << " qpc_" << name;
  writeValues(out, values, [](int value) { return value; });
}

/// A table that is read through pointers of type qpc_TYPE.
void pointerTable(std::ostringstream& out, const std::string& name, const std::vector<int>& values,
                  const std::string& type) {
  out << "typedef " << integerType(values) << " qpc_" << type << ";\n";
  table(out, name, values);
}

int countVarying(const SparseMatrix& m) {
  return static_cast<int>(
      std::count_if(m.entries.begin(), m.entries.end(), [](const SparseEntry& e) { return e.datum.varies; }));
}

bool exists(const Datum& bound) { return bound.varies || std::abs(bound.value.value()) < kUnbounded; }

std::vector<int> whichExist(const SparseDescription& d, const std::vector<Datum>& of_rows,
                            const std::vector<Datum>& of_variables) {
  std::vector<int> result;
  for (int r = 0; r < d.rows(); ++r) result.push_back(r >= d.equalities && exists(of_rows[at(r)]) ? 1 : 0);
  for (const Datum& bound : of_variables) result.push_back(exists(bound) ? 1 : 0);
  return result;
}

int countSides(const SparseDescription& d) {
  int count = 0;
  for (const int side : whichExist(d, d.row_lower, d.lower)) count += side;
  for (const int side : whichExist(d, d.row_upper, d.upper)) count += side;
  return count;
}

/// A matrix row by row: where rows start, the columns, and which entries vary.
void writeMatrixTables(std::ostringstream& out, const std::string& name, const SparseMatrix& m) {
  std::vector<int> start(at(m.rows + 1)), column, varying;
  int count = 0;
  for (const SparseEntry& e : m.entries) {
    ++start[at(e.row + 1)];
    column.push_back(e.column);
    varying.push_back(e.datum.varies ? count++ : -1);
  }
  for (int r = 0; r < m.rows; ++r) start[at(r + 1)] += start[at(r)];
  table(out, name + "_start", start);
  table(out, name + "_column", column);
  table(out, name + "_varying", varying, true);
}

void writeProducts(std::ostringstream& out, const SparseStructure& s) {
  std::vector<int> slot, row, first, second;
  for (const RowProduct& product : s.products) {
    slot.push_back(product.slot);
    row.push_back(product.row);
    first.push_back(product.first);
    second.push_back(product.second);
  }
  table(out, "product_slot", slot);
  table(out, "product_row", row);
  table(out, "product_first", first);
  table(out, "product_second", second);
}

void writePanels(std::ostringstream& out, const SparseStructure& s) {
  std::vector<int> column, height, first_row, row;
  for (const Panel& panel : s.panels) {
    column.push_back(panel.first);
    height.push_back(panel.height());
    first_row.push_back(sizeOf(row));
    row.insert(row.end(), panel.rows.begin(), panel.rows.end());
  }
  column.push_back(s.unknowns());
  table(out, "panel_column", column);
  table(out, "panel_height", height);
  table(out, "panel_start", s.panel_start);
  table(out, "panel_first_row", first_row);
  pointerTable(out, "panel_row", row, "row_index");
}

void writeUpdates(std::ostringstream& out, const SparseStructure& s) {
  std::vector<int> start{0}, panel, first_row, columns, rows, first_where, where;
  for (const auto& of_panel : s.updates) {
    for (const PanelUpdate& update : of_panel) {
      panel.push_back(update.panel);
      first_row.push_back(update.first_row);
      columns.push_back(update.columns);
      rows.push_back(sizeOf(update.where));
      first_where.push_back(sizeOf(where));
      where.insert(where.end(), update.where.begin(), update.where.end());
    }
    start.push_back(sizeOf(panel));
  }
  table(out, "update_start", start);
  table(out, "update_panel_of", panel);
  table(out, "update_first_row", first_row);
  table(out, "update_columns", columns);
  table(out, "update_rows", rows);
  table(out, "update_first_where", first_where);
  pointerTable(out, "update_where", where, "update_index");
}

/// Constants by a table, formulas one by one; what varies stays 0.
void assign(std::ostringstream& out, const std::string& name, const std::vector<Datum>& values) {
  std::vector<Expression> constants;
  bool any = false;
  for (const Datum& datum : values) {
    constants.push_back(datum.value.isConstant() ? datum.value : Expression(0.0));
    any = any || !constants.back().isZero();
  }
  if (any) {
    out << "  static const double " << name << "_value";
    writeValues(out, constants, [](const Expression& value) { return value.code(); });
    out << "  for (int i = 0; i < " << values.size() << "; ++i) t->" << name << "[i] = " << name << "_value[i];\n";
  }
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].value.isConstant()) continue;
    out << "  t->" << name << "[" << i << "] = " << values[i].value.code() << ";\n";
  }
}

std::vector<Datum> dataOf(const SparseMatrix& m) {
  std::vector<Datum> data;
  for (const SparseEntry& e : m.entries) data.push_back(e.datum);
  return data;
}

}  // namespace

std::string writeSizes(const SparseDescription& d, const SparseStructure& s) {
  std::ostringstream out;
  writeHash(out, d.hash);
  define(out, "VARIABLES", d.variables);
  define(out, "EQUALITIES", d.equalities, "the first rows");
  define(out, "ROWS", d.rows());
  define(out, "PLACES", d.rows() + d.variables);
  define(out, "SIDES", countSides(d), "bounds that may exist");
  define(out, "HESSIAN_ENTRIES", static_cast<int>(d.hessian.entries.size()), "of the lower triangle");
  define(out, "HESSIAN_VARYING", countVarying(d.hessian));
  define(out, "MATRIX_ENTRIES", static_cast<int>(d.matrix.entries.size()));
  define(out, "MATRIX_VARYING", countVarying(d.matrix));
  define(out, "PENALTIES", static_cast<int>(d.penalties.size()));
  define(out, "MAX_ITERATIONS", d.max_iterations);
  out << "\n/* Newton's equations: variables and the rows that are not eliminated (those with more than "
      << s.longest_eliminated << " entries,\n   and equalities). The factor has " << s.factor.entries()
      << " entries below the diagonal and costs " << s.factor.operations() << " multiplications;\n";
  if (s.natural_operations > 0) {
    out << "   without elimination and reordering " << s.natural_entries << " and " << s.natural_operations << ". */\n";
  } else {
    out << "   how many without reordering was not counted. */\n";
  }
  define(out, "UNKNOWNS", s.unknowns());
  define(out, "KEPT_ROWS", sizeOf(s.kept_rows));
  define(out, "KKT_ENTRIES", sizeOf(s.kkt_row));
  define(out, "PRODUCTS", static_cast<int>(s.products.size()));
  define(out, "PANELS", s.straightLine() ? 0 : static_cast<int>(s.panels.size()));
  define(out, "FACTOR_ROOM", s.straightLine() ? std::max(1, static_cast<int>(s.factor.entries())) : s.factor_room);
  define(out, "UPDATE_ROOM", s.straightLine() ? 1 : s.update_room);
  out << "\n/* First variable and first row of each group. */\n";
  for (const Group& group : d.variable_groups) define(out, "VARIABLE_" + upperCase(group.name), group.first);
  for (const Group& group : d.row_groups) define(out, "ROW_" + upperCase(group.name), group.first);
  writePenaltyNames(out, d.penalties);
  writeParameterStruct(out, d.parameters);
  return out.str();
}

std::string writeInterface(const SparseDescription& d) {
  std::ostringstream out;
  out << templateText("sparse_interface.h") << "\n";
  for (const std::string& set : d.instruction_sets) out << "QPC_DECLARE(" << set << ")\n";
  return out.str();
}

std::string writeTables(const SparseDescription& d, const SparseStructure& s) {
  std::ostringstream out;
  out << "/* ---- Structure of the matrices, of Newton's equations and of their factor. ---- */\n\n";
  writeMatrixTables(out, "hessian", d.hessian);
  writeMatrixTables(out, "matrix", d.matrix);
  table(out, "has_lower", whichExist(d, d.row_lower, d.lower));
  table(out, "has_upper", whichExist(d, d.row_upper, d.upper));
  std::vector<int> penalty;
  for (const int index : d.row_penalty) penalty.push_back(index + 1);
  table(out, "row_penalty", penalty);
  table(out, "hessian_slot", s.hessian_slot);
  table(out, "matrix_slot", s.matrix_slot, true);
  table(out, "diagonal_slot", s.diagonal_slot);
  table(out, "kept_row", s.kept_rows);
  table(out, "row_unknown", s.row_unknown, true);
  table(out, "variable_unknown", s.variable_unknown);
  writeProducts(out, s);
  table(out, "kkt_start", s.kkt_start);
  table(out, "kkt_row", s.kkt_row);
  if (s.straightLine()) return out.str();
  table(out, "kkt_place", s.kkt_place);
  table(out, "pivot_sign", s.pivot_sign, true);
  writePanels(out, s);
  writeUpdates(out, s);
  return out.str();
}

std::string writeEvaluate(const SparseDescription& d) {
  std::ostringstream out;
  writeDefaultParameters(out, d.parameters);
  out << "\n/* The description's numbers for these parameters; what is not assigned is zero. */\n"
         "static void qpc_evaluate(qpc_tables* t, const qpc_parameters* p) {\n  (void)p;\n";
  assign(out, "hessian", dataOf(d.hessian));
  assign(out, "matrix", dataOf(d.matrix));
  assign(out, "linear", d.linear);
  assign(out, "lower", d.lower);
  assign(out, "upper", d.upper);
  assign(out, "row_lower", d.row_lower);
  assign(out, "row_upper", d.row_upper);
  for (std::size_t i = 0; i < d.penalties.size(); ++i) {
    out << "  t->penalty_linear[" << i + 1 << "] = " << d.penalties[i].linear.code() << ";\n"
        << "  t->penalty_quadratic[" << i + 1 << "] = " << d.penalties[i].quadratic.code() << ";\n";
  }
  out << "}\n";
  return out.str();
}

}  // namespace codegen
}  // namespace swarm_planner
