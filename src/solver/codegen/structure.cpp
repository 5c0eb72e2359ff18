// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/solver/codegen/structure.hpp"

#include <algorithm>
#include <numeric>

namespace swarm_planner {
namespace codegen {
namespace {

/// Disjoint sets over states, then inputs, then output components.
class Components {
 public:
  explicit Components(int count) : parent_(static_cast<std::size_t>(count)) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  int find(int i) {
    while (parent_[static_cast<std::size_t>(i)] != i) i = parent_[static_cast<std::size_t>(i)];
    return i;
  }
  /// The smaller index leads, so that the result does not depend on the order of the calls.
  void join(int i, int j) {
    i = find(i);
    j = find(j);
    parent_[static_cast<std::size_t>(std::max(i, j))] = std::min(i, j);
  }
  void joinNonzeros(const ExpressionMatrix& m, int row_offset, int column_offset) {
    for (int i = 0; i < m.rows; ++i) {
      for (int j = 0; j < m.columns; ++j) {
        if (!m(i, j).isZero()) join(row_offset + i, column_offset + j);
      }
    }
  }

 private:
  std::vector<int> parent_;
};

bool sameEntries(const ExpressionMatrix& m, const std::vector<int>& rows_1, const std::vector<int>& columns_1,
                 const std::vector<int>& rows_2, const std::vector<int>& columns_2) {
  if (m.empty()) return true;
  for (std::size_t i = 0; i < rows_1.size(); ++i) {
    for (std::size_t j = 0; j < columns_1.size(); ++j) {
      if (m(rows_1[i], columns_1[j]) != m(rows_2[i], columns_2[j])) return false;
    }
  }
  return true;
}

bool sameChannels(const Description& d, const Block& p, const Block& q) {
  for (std::size_t i = 0; i < p.channels.size(); ++i) {
    if (p.channels[i].first != q.channels[i].first) return false;
    if (p.channels[i].first < 0) continue;
    const Output& output = d.outputs[static_cast<std::size_t>(p.channels[i].first)];
    const std::vector<int> row_p{p.channels[i].second};
    const std::vector<int> row_q{q.channels[i].second};
    if (!sameEntries(output.state, row_p, p.states, row_q, q.states)) return false;
    if (!sameEntries(output.input, row_p, p.inputs, row_q, q.inputs)) return false;
  }
  return true;
}

bool sameClass(const Description& d, const Block& p, const Block& q) {
  return p.states.size() == q.states.size() && p.inputs.size() == q.inputs.size() &&
         sameEntries(d.a, p.states, p.states, q.states, q.states) &&
         sameEntries(d.b, p.states, p.inputs, q.states, q.inputs) &&
         sameEntries(d.stage_cost, p.states, p.states, q.states, q.states) &&
         sameEntries(d.terminal_cost, p.states, p.states, q.states, q.states) &&
         sameEntries(d.input_cost, p.inputs, p.inputs, q.inputs, q.inputs) &&
         sameEntries(d.rate_cost, p.inputs, p.inputs, q.inputs, q.inputs) && sameChannels(d, p, q);
}

Components connect(const Description& d) {
  int count = d.states + d.inputs;
  for (const Output& output : d.outputs) count += output.size();
  Components components(count);
  components.joinNonzeros(d.a, 0, 0);
  components.joinNonzeros(d.b, 0, d.states);
  components.joinNonzeros(d.stage_cost, 0, 0);
  components.joinNonzeros(d.terminal_cost, 0, 0);
  components.joinNonzeros(d.input_cost, d.states, d.states);
  components.joinNonzeros(d.rate_cost, d.states, d.states);
  int offset = d.states + d.inputs;
  for (const Output& output : d.outputs) {
    components.joinNonzeros(output.state, offset, 0);
    components.joinNonzeros(output.input, offset, d.states);
    offset += output.size();
  }
  return components;
}

void makeBlocks(const Description& d, Structure& s) {
  Components components = connect(d);
  std::vector<int> leaders;
  const auto blockOf = [&](int node) -> int {
    const int leader = components.find(node);
    const auto found = std::find(leaders.begin(), leaders.end(), leader);
    if (found != leaders.end()) return static_cast<int>(found - leaders.begin());
    leaders.push_back(leader);
    s.blocks.emplace_back();
    return static_cast<int>(leaders.size()) - 1;
  };
  for (int i = 0; i < d.states; ++i) {
    const int b = blockOf(i);
    Block& block = s.blocks[static_cast<std::size_t>(b)];
    s.state_block.push_back(b);
    s.state_index.push_back(static_cast<int>(block.states.size()));
    block.states.push_back(i);
  }
  for (int i = 0; i < d.inputs; ++i) {
    const int b = blockOf(d.states + i);
    Block& block = s.blocks[static_cast<std::size_t>(b)];
    s.input_block.push_back(b);
    s.input_index.push_back(static_cast<int>(block.inputs.size()));
    block.inputs.push_back(i);
  }
  int node = d.states + d.inputs;
  for (const Output& output : d.outputs) {
    s.output_block.emplace_back();
    for (int c = 0; c < output.size(); ++c, ++node) s.output_block.back().push_back(blockOf(node));
  }
}

/// Channels of the state alone come first and start at the same index in every block, so that one channel means the
/// same stages in every lane.
void makeChannels(const Description& d, Structure& s) {
  for (const Output& output : d.outputs) s.output_channel.emplace_back(static_cast<std::size_t>(output.size()), -1);
  for (const bool touches_input : {false, true}) {
    for (std::size_t o = 0; o < d.outputs.size(); ++o) {
      for (int c = 0; c < d.outputs[o].size(); ++c) {
        if (d.outputs[o].touchesInput() != touches_input) continue;
        const auto at = static_cast<std::size_t>(c);
        auto& channels = s.blocks[static_cast<std::size_t>(s.output_block[o][at])].channels;
        s.output_channel[o][at] = static_cast<int>(channels.size());
        channels.emplace_back(static_cast<int>(o), c);
      }
    }
    for (const Block& block : s.blocks) s.channels = std::max(s.channels, static_cast<int>(block.channels.size()));
    if (!touches_input) s.state_channels = s.channels;
    for (Block& block : s.blocks) block.channels.resize(static_cast<std::size_t>(s.channels), {-1, -1});
  }
}

void findClasses(const Description& d, Structure& s) {
  for (const Block& block : s.blocks) {
    int found = -1;
    for (int c = 0; c < s.classCount() && found < 0; ++c) {
      const int representative = s.class_representative[static_cast<std::size_t>(c)];
      if (sameClass(d, block, s.blocks[static_cast<std::size_t>(representative)])) found = c;
    }
    if (found < 0) {
      found = s.classCount();
      s.class_representative.push_back(static_cast<int>(&block - s.blocks.data()));
    }
    s.class_of_block.push_back(found);
  }
}

bool isAligned(const Structure& s) {
  for (std::size_t o = 0; o < s.output_block.size(); ++o) {
    if (static_cast<int>(s.output_block[o].size()) != s.blockCount()) return false;
    for (int c = 0; c < s.blockCount(); ++c) {
      const auto at = static_cast<std::size_t>(c);
      if (s.output_block[o][at] != c || s.output_channel[o][at] != s.output_channel[o][0]) return false;
    }
  }
  return true;
}

}  // namespace

Structure analyse(const Description& description) {
  Structure s;
  makeBlocks(description, s);
  makeChannels(description, s);
  findClasses(description, s);
  for (const Block& block : s.blocks) {
    s.block_states = std::max(s.block_states, static_cast<int>(block.states.size()));
    s.block_inputs = std::max(s.block_inputs, static_cast<int>(block.inputs.size()));
  }
  s.block_states = std::max(s.block_states, 1);
  s.block_inputs = std::max(s.block_inputs, 1);
  for (const Output& output : description.outputs) s.components = std::max(s.components, output.size());
  while (s.lanes < s.blockCount()) s.lanes *= 2;
  s.aligned = isAligned(s);
  return s;
}

}  // namespace codegen
}  // namespace swarm_planner
