// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <sstream>

#include "swarm_planner/solver/codegen/generator.hpp"
#include "write_common.hpp"

namespace swarm_planner {
namespace codegen {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

std::string brackets(int i, int j) { return "[" + std::to_string(i) + "][" + std::to_string(j) + "]"; }

void list(std::ostringstream& out, const std::string& declaration, const std::vector<int>& values) {
  out << "static const int " << declaration << "[" << values.size() << "] = {";
  for (std::size_t i = 0; i < values.size(); ++i) out << (i > 0 ? ", " : "") << values[i];
  out << "};\n";
}

/// Assigns the entries of `m` that belong to the block's rows and columns.
void assign(std::ostringstream& out, const std::string& name, int block, const ExpressionMatrix& m,
            const std::vector<int>& rows, const std::vector<int>& columns) {
  if (m.empty()) return;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < columns.size(); ++j) {
      const Expression& entry = m(rows[i], columns[j]);
      if (entry.isZero()) continue;
      out << "  t->" << name << brackets(static_cast<int>(i), static_cast<int>(j)) << "[" << block
          << "] = " << entry.code() << ";\n";
    }
  }
}

void assignBounds(std::ostringstream& out, const Description& d, const Structure& s) {
  out << "  for (int i = 0; i < QPC_BLOCKS * QPC_POINTS_PADDED; ++i) {\n"
         "    t->lower[i] = -QPC_UNBOUNDED;\n    t->upper[i] = QPC_UNBOUNDED;\n  }\n";
  for (std::size_t o = 0; o < d.outputs.size(); ++o) {
    if (!d.outputs[o].bounded) continue;
    for (int c = 0; c < d.outputs[o].size(); ++c) {
      out << "  for (int k = 0; k < QPC_HORIZON; ++k) {\n";
      for (const char* side : {"lower", "upper"}) {
        const Expression& value = side[0] == 'l' ? d.outputs[o].lower[at(c)] : d.outputs[o].upper[at(c)];
        out << "    t->" << side << "[" << s.output_block[o][at(c)] << " * QPC_POINTS_PADDED + "
            << s.output_channel[o][at(c)] << " * QPC_HORIZON + k] = " << value.code() << ";\n";
      }
      out << "  }\n";
    }
  }
}

/// One entry of a stage matrix in all lanes.
struct LaneEntry {
  bool zero = true;
  bool one = true;
};

/// A sum of products of lane coefficients and variables; ones are not multiplied, zeros do not appear.
class LaneSum {
 public:
  void add(const LaneEntry& entry, const std::string& coefficient, const std::string& variable) {
    if (entry.zero) return;
    if (!text_.empty()) text_ += " + ";
    text_ += entry.one ? variable : "QPC_LOAD_LANE(t->" + coefficient + ") * " + variable;
  }
  std::string text() const { return text_.empty() ? "QPC_LANE_ZERO" : text_; }

 private:
  std::string text_;
};

void meet(LaneEntry& entry, const Expression& value) {
  entry.zero = entry.zero && value.isZero();
  entry.one = entry.one && value.isOne();
}

void writeChannels(std::ostringstream& out, const Description& d, const Structure& s) {
  out << "/* Every channel's value: of the state alone at the next stage, with the input at this one. */\n"
         "QPC_FUNCTION void qpc_channels(const qpc_tables* t, const qpc_lane* z, const qpc_lane* next, const qpc_lane* "
         "u,\n"
         "                               qpc_lane* channel) {\n  (void)t;\n  (void)z;\n  (void)next;\n  (void)u;\n";
  for (int channel = 0; channel < s.channels; ++channel) {
    LaneSum sum;
    for (int i = 0; i < s.block_states + s.block_inputs; ++i) {
      const bool is_state = i < s.block_states;
      const int local = is_state ? i : i - s.block_states;
      LaneEntry entry;
      for (const Block& block : s.blocks) {
        const auto& place = block.channels[at(channel)];
        const std::vector<int>& columns = is_state ? block.states : block.inputs;
        Expression value = 0.0;
        if (place.first >= 0 && local < static_cast<int>(columns.size())) {
          const Output& output = d.outputs[at(place.first)];
          value = (is_state ? output.state : output.input)(place.second, columns[at(local)]);
        }
        meet(entry, value);
      }
      const char* state = channel < s.state_channels ? "next" : "z";
      sum.add(entry, (is_state ? "c" : "d") + brackets(channel, local),
              std::string(is_state ? state : "u") + "[" + std::to_string(local) + "]");
    }
    out << "  channel[" << channel << "] = " << sum.text() << ";\n";
  }
  out << "}\n\n";
}

void writeGather(std::ostringstream& out, const Description& d, const Structure& s) {
  out << "/* The caller's data in lanes. */\n"
         "QPC_FUNCTION void qpc_gather(const qpc_copy* s, double (*q)[QPC_BLOCK_STATES][QPC_LANES],\n"
         "                             double (*r)[QPC_BLOCK_INPUTS][QPC_LANES], double (*z0)[QPC_LANES]) {\n"
         "  qpc_clear(&z0[0][0], QPC_SWEEP_STATES * QPC_LANES);\n";
  for (int i = 0; i < d.states; ++i) {
    out << "  z0" << brackets(s.state_index[at(i)], s.state_block[at(i)]) << " = s->x0[" << i << "];\n";
  }
  for (int i = 0; i < d.inputs && !d.rate_cost.empty(); ++i) {
    out << "  z0" << brackets(s.block_states + s.input_index[at(i)], s.input_block[at(i)]) << " = s->u_previous[" << i
        << "];\n";
  }
  out << "  for (int k = 0; k < QPC_HORIZON; ++k) {\n"
         "    qpc_clear(&q[k][0][0], QPC_BLOCK_STATES * QPC_LANES);\n";
  for (int i = 0; i < d.states; ++i) {
    out << "    q[k]" << brackets(s.state_index[at(i)], s.state_block[at(i)]) << " = s->state_linear[k][" << i
        << "];\n";
  }
  if (d.input_linear) {
    out << "    qpc_clear(&r[k][0][0], QPC_BLOCK_INPUTS * QPC_LANES);\n";
    for (int i = 0; i < d.inputs; ++i) {
      out << "    r[k]" << brackets(s.input_index[at(i)], s.input_block[at(i)]) << " = s->input_linear[k][" << i
          << "];\n";
    }
  } else {
    out << "    (void)r;\n";
  }
  out << "  }\n}\n\n";
}

/// " + A(i, j) * variable" for scalars: a literal where the entry is known, the table's entry otherwise.
void addScalarTerm(std::ostringstream& out, bool& first, const Expression& entry, const std::string& coefficient,
                   const std::string& variable) {
  if (entry.isZero()) return;
  out << (first ? "" : " + ");
  first = false;
  if (!entry.isOne()) out << (entry.isConstant() ? "(" + entry.code() + ")" : "t->" + coefficient) << " * ";
  out << variable;
}

void writeOrderedInputs(std::ostringstream& out, const Description& d, const Structure& s) {
  out << "/* Inputs in the caller's order. */\n"
         "static void qpc_order_inputs(const double (*input)[QPC_RESPONSE_PADDED], double (*u)[QPC_INPUTS]) {\n"
         "  for (int k = 0; k < QPC_HORIZON; ++k) {\n";
  for (int i = 0; i < d.inputs; ++i) {
    out << "    u[k][" << i << "] = input[" << s.input_block[at(i)] << "][k * QPC_BLOCK_INPUTS + "
        << s.input_index[at(i)] << "];\n";
  }
  out << "  }\n}\n\n";
}

void writeRollOut(std::ostringstream& out, const Description& d, const Structure& s) {
  out << "/* The states that follow from the inputs. */\n"
         "static void qpc_roll_out(const qpc_tables* t, qpc_copy* s) {\n  (void)t;\n"
         "  for (int i = 0; i < QPC_STATES; ++i) s->x[0][i] = s->x0[i];\n"
         "  for (int k = 0; k < QPC_HORIZON; ++k) {\n"
         "    const double *x = s->x[k], *u = s->u[k];\n    double* next = s->x[k + 1];\n    (void)u;\n";
  for (int i = 0; i < d.states; ++i) {
    bool first = true;
    const std::string row = std::to_string(s.state_index[at(i)]);
    const std::string lane = "[" + std::to_string(s.state_block[at(i)]) + "]";
    out << "    next[" << i << "] = ";
    for (int j = 0; j < d.states; ++j) {
      addScalarTerm(out, first, d.a(i, j), "a[" + row + "][" + std::to_string(s.state_index[at(j)]) + "]" + lane,
                    "x[" + std::to_string(j) + "]");
    }
    for (int j = 0; j < d.inputs; ++j) {
      addScalarTerm(out, first, d.b(i, j), "b[" + row + "][" + std::to_string(s.input_index[at(j)]) + "]" + lane,
                    "u[" + std::to_string(j) + "]");
    }
    out << (first ? "0.0;\n" : ";\n");
  }
  out << "  }\n}\n";
}

}  // namespace

std::string writeConstants(const Description& d, const Structure& s, const Layout& layout) {
  std::ostringstream out;
  list(out, "qpc_class_of_block", s.class_of_block);
  list(out, "qpc_class_block", s.class_representative);
  std::vector<int> first_stage, most_rows, row_penalty;
  for (int channel = 0; channel < s.channels; ++channel) first_stage.push_back(channel < s.state_channels ? 1 : 0);
  for (const Output& output : d.outputs) {
    most_rows.push_back(output.max_rows);
    row_penalty.push_back(output.row_penalty + 1);
  }
  list(out, "qpc_channel_first_stage", first_stage);
  list(out, "qpc_most_rows", most_rows);
  list(out, "qpc_row_penalty", row_penalty);
  list(out, "qpc_first_slot", layout.first_slot);
  list(out, "qpc_stage_stride", layout.stage_stride);
  list(out, "qpc_row_stride", layout.row_stride);
  std::vector<int> ranges;
  for (const auto& range : layout.bound_ranges) {
    ranges.push_back(range.first);
    ranges.push_back(range.second);
  }
  out << "#define QPC_BOUND_RANGES " << layout.bound_ranges.size() << "\n";
  list(out, "qpc_bound_range", ranges.empty() ? std::vector<int>{0, 0} : ranges);
  out << "/* Where component c of an output at stage index 0 lies in its copy's outputs. */\n"
         "static const int qpc_output_place[QPC_OUTPUTS][QPC_COMPONENTS] = {\n";
  for (std::size_t o = 0; o < d.outputs.size(); ++o) {
    out << "    {";
    for (int c = 0; c < s.components; ++c) {
      const auto component = at(c < d.outputs[o].size() ? c : 0);
      out << (c > 0 ? ", " : "")
          << s.output_block[o][component] * layout.points_padded + s.output_channel[o][component] * d.horizon;
    }
    out << "},\n";
  }
  out << "};\n";
  const auto channelTable = [&](const char* name, auto entry) {
    out << "static const int " << name << "[QPC_BLOCKS][QPC_CHANNELS] = {\n";
    for (const Block& block : s.blocks) {
      out << "    {";
      for (std::size_t i = 0; i < block.channels.size(); ++i) out << (i > 0 ? ", " : "") << entry(block.channels[i]);
      out << "},\n";
    }
    out << "};\n";
  };
  using Channel = std::pair<int, int>;
  channelTable("qpc_bound_penalty", [&](const Channel& channel) {
    return channel.first < 0 ? 0 : d.outputs[at(channel.first)].bound_penalty + 1;
  });
  channelTable("qpc_channel_output", [](const Channel& channel) { return std::max(channel.first, 0); });
  channelTable("qpc_channel_component", [](const Channel& channel) { return std::max(channel.second, 0); });
  return out.str();
}

std::string writeEvaluate(const Description& d, const Structure& s) {
  std::ostringstream out;
  writeDefaultParameters(out, d.parameters);
  out << "\n/* The description's numbers for these parameters; what is not assigned is zero. */\n"
         "static void qpc_evaluate(qpc_tables* t, const qpc_parameters* p) {\n  (void)p;\n";
  for (int b = 0; b < s.lanes; ++b) {
    const Block block = b < s.blockCount() ? s.blocks[at(b)] : Block();
    assign(out, "a", b, d.a, block.states, block.states);
    assign(out, "b", b, d.b, block.states, block.inputs);
    assign(out, "stage_cost", b, d.stage_cost, block.states, block.states);
    assign(out, "terminal_cost", b, d.terminal_cost, block.states, block.states);
    assign(out, "input_cost", b, d.input_cost, block.inputs, block.inputs);
    assign(out, "rate_cost", b, d.rate_cost, block.inputs, block.inputs);
    for (int j = static_cast<int>(block.inputs.size()); j < s.block_inputs; ++j) {
      out << "  t->input_cost" << brackets(j, j) << "[" << b << "] = 1.0; /* fills up */\n";
    }
    for (std::size_t i = 0; i < block.channels.size(); ++i) {
      if (block.channels[i].first < 0) continue;
      const Output& output = d.outputs[at(block.channels[i].first)];
      for (std::size_t j = 0; j < block.states.size(); ++j) {
        const Expression& entry = output.state(block.channels[i].second, block.states[j]);
        if (!entry.isZero())
          out << "  t->c" << brackets(static_cast<int>(i), static_cast<int>(j)) << "[" << b << "] = " << entry.code()
              << ";\n";
      }
      for (std::size_t j = 0; j < block.inputs.size(); ++j) {
        const Expression& entry = output.input(block.channels[i].second, block.inputs[j]);
        if (!entry.isZero())
          out << "  t->d" << brackets(static_cast<int>(i), static_cast<int>(j)) << "[" << b << "] = " << entry.code()
              << ";\n";
      }
    }
  }
  assignBounds(out, d, s);
  out << "  t->penalty_linear[0] = QPC_UNBOUNDED;\n";
  for (std::size_t i = 0; i < d.penalties.size(); ++i) {
    out << "  t->penalty_linear[" << i + 1 << "] = " << d.penalties[i].linear.code() << ";\n"
        << "  t->compliance[" << i + 1 << "] = 1.0 / " << d.penalties[i].quadratic.code() << ";\n";
  }
  out << "}\n";
  return out.str();
}

std::string writeStage(const Description& d, const Structure& s) {
  std::ostringstream out;
  writeChannels(out, d, s);
  writeGather(out, d, s);
  writeOrderedInputs(out, d, s);
  writeRollOut(out, d, s);
  return out.str();
}

}  // namespace codegen
}  // namespace swarm_planner
