// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/solver/codegen/description.hpp"

namespace swarm_planner {
namespace codegen {

/// States, inputs and output components that touch no other block's: an axis, if the problem decouples into axes.
struct Block {
  std::vector<int> states;  ///< the description's indices, ascending
  std::vector<int> inputs;
  /// (output, component): first those of the state alone, then, from Structure::state_channels on, those that touch
  /// the input; (-1, -1) fills up.
  std::vector<std::pair<int, int>> channels;
};

/// What the generator found out about a description.
///
/// Blocks are the connected components of the graph whose nodes are states, inputs and output components and whose
/// edges are the nonzeros of A, B, the cost and the outputs. The Hessian in the inputs is then block diagonal, and
/// everything about a block can be tabulated apart from the others. Blocks with the same formulas form a class and
/// share tables: A = M (x) I3 gives three blocks of one class without anyone saying so.
struct Structure {
  std::vector<Block> blocks;
  std::vector<int> class_of_block;
  std::vector<int> class_representative;  ///< one block per class
  int block_states = 0;                   ///< most states of a block; smaller blocks are padded
  int block_inputs = 0;
  int channels = 0;                           ///< channels of every block, filled up
  int state_channels = 0;                     ///< those that depend on the state alone, stages 1..N
  int components = 0;                         ///< most components of an output
  int lanes = 1;                              ///< blocks, rounded up to a power of two
  std::vector<int> state_block, state_index;  ///< where a state went
  std::vector<int> input_block, input_index;
  std::vector<std::vector<int>> output_block;    ///< [output][component]
  std::vector<std::vector<int>> output_channel;  ///< [output][component], within the block
  /// Component c of every output belongs to block c and has the same channel in all blocks: a row's products
  /// then are one table entry times one sum over the blocks.
  bool aligned = false;

  int blockCount() const { return static_cast<int>(blocks.size()); }
  int classCount() const { return static_cast<int>(class_representative.size()); }
};

Structure analyse(const Description& description);

}  // namespace codegen
}  // namespace swarm_planner
