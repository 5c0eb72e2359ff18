// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

namespace swarm_planner {

/// Instruction sets that generated solvers are compiled for.
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

/// The widest one that this machine runs.
InstructionSet bestInstructionSet();

}  // namespace swarm_planner
