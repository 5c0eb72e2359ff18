// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <sstream>

#include "swarm_planner/solver/codegen/generator.hpp"
#include "write_common.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

constexpr int kWidth = 8;    // doubles of the widest vector
constexpr int kFewRows = 8;  // outputs with fewer rows a stage are scanned across the stages

int roundUp(int n, int to) { return (n + to - 1) / to * to; }

void findBoundRanges(const Description& d, const Structure& s, Layout& layout) {
  for (int channel = 0; channel < s.channels; ++channel) {
    const bool bounded = std::any_of(s.blocks.begin(), s.blocks.end(), [&](const Block& block) {
      const int output = block.channels[static_cast<std::size_t>(channel)].first;
      return output >= 0 && d.outputs[static_cast<std::size_t>(output)].bounded;
    });
    if (!bounded) continue;
    const int first = channel * d.horizon;
    if (!layout.bound_ranges.empty() && layout.bound_ranges.back().first + layout.bound_ranges.back().second == first) {
      layout.bound_ranges.back().second += d.horizon;
    } else {
      layout.bound_ranges.emplace_back(first, d.horizon);
    }
  }
}

}  // namespace

Layout makeLayout(const Description& d, const Structure& s) {
  Layout layout;
  layout.points = s.channels * d.horizon;
  int end = layout.points;
  for (std::size_t o = 0; o < d.outputs.size(); ++o) {
    const int most = d.outputs[o].max_rows;
    const bool across = most < kFewRows;
    layout.first_slot.push_back(layout.row_slots);
    layout.stage_stride.push_back(across ? 1 : roundUp(most, kWidth));
    layout.row_stride.push_back(across ? roundUp(d.horizon, kWidth) : 1);
    layout.row_slots += across ? most * layout.row_stride.back() : d.horizon * layout.stage_stride.back();
    layout.groups += across ? most : d.horizon;
    for (const int channel : s.output_channel[o]) {
      if (across && most > 0) end = std::max(end, channel * d.horizon + roundUp(d.horizon, kWidth));
    }
  }
  findBoundRanges(d, s, layout);
  for (const auto& range : layout.bound_ranges) end = std::max(end, range.first + roundUp(range.second, kWidth));
  layout.points_padded = roundUp(end, 2 * kWidth);
  return layout;
}

std::string writeSizes(const Description& d, const Structure& s, const Layout& layout) {
  std::ostringstream out;
  writeHash(out, d.hash);
  define(out, "HORIZON", d.horizon, "N");
  define(out, "STATES", d.states);
  define(out, "INPUTS", d.inputs);
  define(out, "OUTPUTS", static_cast<int>(d.outputs.size()));
  define(out, "COMPONENTS", s.components, "of the longest output");
  define(out, "ROW_COMPONENTS", (d.copies > 1 ? 2 : 1) * s.components, "that a row can touch");
  define(out, "RATE", d.rate_cost.empty() ? 0 : 1, "there is a cost on u_k - u_{k-1}");
  define(out, "INPUT_LINEAR", d.input_linear ? 1 : 0);
  define(out, "BLOCKS", s.blockCount(), "parts that dynamics, cost and outputs do not couple");
  define(out, "LANES", s.lanes);
  define(out, "CLASSES", s.classCount(), "of equal blocks");
  define(out, "ALIGNED", s.aligned ? 1 : 0, "component c of every output belongs to block c");
  define(out, "BLOCK_STATES", s.block_states);
  define(out, "BLOCK_INPUTS", s.block_inputs);
  define(out, "SWEEP_STATES", s.block_states + (d.rate_cost.empty() ? 0 : s.block_inputs));
  define(out, "CHANNELS", s.channels, "output components of a block");
  define(out, "POINTS", layout.points, "channels times stages");
  define(out, "POINTS_PADDED", layout.points_padded);
  define(out, "TILES", layout.points_padded / (2 * kWidth), "parts of a block's outputs that are computed as one");
  define(out, "RESPONSE_PADDED", roundUp(d.horizon * s.block_inputs, kWidth));
  define(out, "ROW_SLOTS", std::max(layout.row_slots, kWidth));
  define(out, "GROUPS", std::max(layout.groups, 1));
  define(out, "PENALTIES", static_cast<int>(d.penalties.size()));
  define(out, "MAX_ACTIVE", d.max_active);
  define(out, "ACTIVE_PADDED", roundUp(d.max_active, kWidth));
  define(out, "MAX_CHANGES", d.max_changes);
  define(out, "MAX_QUADRATIC", d.max_quadratic);
  define(out, "STAGES_PADDED", roundUp(d.horizon, kWidth));
  define(out, "ENTRIES", std::max(layout.row_slots, kWidth) + 2 * s.blockCount() * layout.points_padded,
         "all rows and bounds");
  const int z = d.states + (d.rate_cost.empty() ? 0 : d.inputs);
  define(out, "GAINS", d.inputs * z);
  define(out, "LOWERS", std::max(1, d.inputs * (d.inputs + 1) / 2));
  define(out, "WEIGHTS", s.components * (s.components + 1) / 2);
  if (d.copies > 1) {
    define(out, "COPIES", d.copies);
    define(out, "MAX_COUPLINGS", d.max_couplings);
    define(out, "COPY_OUTPUTS", s.blockCount() * layout.points_padded);
    define(out, "COPY_IDS",
           std::max(layout.row_slots, kWidth) + 2 * s.blockCount() * layout.points_padded + d.max_quadratic,
           "rows, bounds and quadratic terms of a copy");
  }
  out << "\n/* Outputs, and the slot of row i of an output at a stage index (stage, less the output's first stage). "
         "*/\n";
  for (std::size_t o = 0; o < d.outputs.size(); ++o) {
    const std::string name = upperCase(d.outputs[o].name);
    define(out, "OUTPUT_" + name, static_cast<int>(o));
    define(out, "FIRST_STAGE_" + name, d.outputs[o].touchesInput() ? 0 : 1);
    if (d.outputs[o].max_rows == 0) continue;
    define(out, "MAX_ROWS_" + name, d.outputs[o].max_rows);
    out << "#define QPC_SLOT_" << name << "(index, i) (" << layout.first_slot[o] << " + (index) * "
        << layout.stage_stride[o] << " + (i) * " << layout.row_stride[o] << ")\n";
  }
  writePenaltyNames(out, d.penalties);
  writeParameterStruct(out, d.parameters);
  return out.str();
}

std::string writeInterface(const Description& d, const Structure& s, const Layout& layout) {
  std::ostringstream out;
  const auto list = [&](const std::string& name, const std::vector<int>& values) {
    out << "  static const int " << name << "[" << values.size() << "] = {";
    for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? ", " : "") << values[i];
    out << "};\n";
  };
  std::vector<int> first_stage, most_rows;
  for (const Output& output : d.outputs) {
    first_stage.push_back(output.touchesInput() ? 0 : 1);
    most_rows.push_back(output.max_rows);
  }
  out << "/* Appends the row normal . y >= offset on an output's value at a stage; returns its identity (as in "
         "active_id\n"
         "   and warm_id), or -1 if the stage does not have the output or no more rows. */\n"
         "static inline int qpc_add_row(qpc_copy* s, int output, int stage, const double* normal, double offset,\n"
         "                              int penalty) {\n";
  list("first_stage", first_stage);
  list("most_rows", most_rows);
  list("first_slot", layout.first_slot);
  list("stage_stride", layout.stage_stride);
  list("row_stride", layout.row_stride);
  out << templateText("add_row.h");
  out << "/* The identity of a bound of an output's component at a stage index. */\n"
         "static inline int qpc_bound_id(int output, int component, int index, int upper) {\n"
         "  static const int place[QPC_OUTPUTS][QPC_COMPONENTS] = {\n";
  for (std::size_t o = 0; o < d.outputs.size(); ++o) {
    out << "      {";
    for (std::size_t c = 0; c < s.output_block[o].size(); ++c) {
      out << (c > 0 ? ", " : "") << s.output_block[o][c] * layout.points_padded + s.output_channel[o][c] * d.horizon;
    }
    out << "},\n";
  }
  out << "  };\n  return QPC_ROW_SLOTS + 2 * (place[output][component] + index) + upper;\n}\n\n";
  if (d.copies > 1) {
    out << "static inline int qpc_first_stage(int output) {\n";
    list("first_stage", first_stage);
    out << "  return first_stage[output];\n}\n\n";
  }
  out << templateText(d.copies > 1 ? "copies.h" : "one_copy.h");
  for (const std::string& set : d.instruction_sets) out << "QPC_DECLARE(" << set << ")\n";
  return out.str();
}

}  // namespace codegen
}  // namespace swarm_planner
