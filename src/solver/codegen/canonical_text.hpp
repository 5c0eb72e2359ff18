// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "swarm_planner/solver/codegen/sparse_description.hpp"

namespace swarm_planner {
namespace codegen {

/// Everything that decides what the generated code computes, independent of spelling in the file: its hash says whether
/// two descriptions are the same.
std::string canonicalText(const SparseDescription& description);

}  // namespace codegen
}  // namespace swarm_planner
