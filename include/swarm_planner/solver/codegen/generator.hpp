// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

#include "swarm_planner/solver/codegen/description.hpp"
#include "swarm_planner/solver/codegen/sparse_structure.hpp"
#include "swarm_planner/solver/codegen/structure.hpp"

namespace swarm_planner {
namespace codegen {

/// A generated solver: C99 that needs <stdint.h> and <stddef.h>, and nothing at link time.
struct GeneratedCode {
  std::string header;  ///< NAME.h
  std::string source;  ///< NAME.c
  std::string name;
};

/// The same description gives the same bytes.
GeneratedCode generate(const Description& description);
GeneratedCode generate(const SparseDescription& description);
/// From a description of either kind. @throws DescriptionError with every fault found
GeneratedCode generateFromText(const std::string& yaml_text);

/// Sizes and places of rows and points that header and source agree on.
struct Layout {
  int points = 0;         ///< channels * horizon
  int points_padded = 0;  ///< room for whole vectors at the end of every range that is read
  int row_slots = 0;
  int groups = 0;                                         ///< most groups of rows that a scan visits
  std::vector<int> first_slot, stage_stride, row_stride;  ///< per output
  std::vector<std::pair<int, int>> bound_ranges;          ///< first point, points; channels with bounds
};

Layout makeLayout(const Description& description, const Structure& structure);

/// Parts of the generated text; identifiers begin with qpc_ and QPC_ until generate() puts the name there.
std::string writeSizes(const Description& description, const Structure& structure, const Layout& layout);
std::string writeInterface(const Description& description, const Structure& structure, const Layout& layout);
std::string writeConstants(const Description& description, const Structure& structure, const Layout& layout);
std::string writeEvaluate(const Description& description, const Structure& structure);
std::string writeStage(const Description& description, const Structure& structure);
/// The interior-point method's Riccati recursion, stage by stage in straight-line code.
std::string writeRiccati(const Description& description, const Structure& structure);

/// The same for the sparse kind.
std::string writeSizes(const SparseDescription& description, const SparseStructure& structure);
std::string writeInterface(const SparseDescription& description);
std::string writeTables(const SparseDescription& description, const SparseStructure& structure);
std::string writeEvaluate(const SparseDescription& description);
/// Factorisation and substitution without tables, for small problems.
std::string writeStraightLineFactor(const SparseStructure& structure);

/// The text of a file in templates/, which the build embeds.
/// @throws std::out_of_range if there is none of that name
const std::string& templateText(const std::string& name);

}  // namespace codegen
}  // namespace swarm_planner
