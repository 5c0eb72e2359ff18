// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "swarm_planner/solver/codegen/description.hpp"
#include "swarm_planner/solver/codegen/generator.hpp"

namespace swarm_planner {
namespace codegen {

/// What the generated text of all kinds of solver has in common. Identifiers begin with qpc_ and QPC_ until
/// finishCode() puts the name there.

std::string upperCase(std::string text);

/// #define QPC_NAME value, with a comment unless it is empty
void define(std::ostringstream& out, const std::string& name, int value, const std::string& comment = "");

void writeHash(std::ostringstream& out, std::uint64_t hash);
void writePenaltyNames(std::ostringstream& out, const std::vector<Penalty>& penalties);

using Parameters = std::vector<std::pair<std::string, double>>;
/// The struct that set-up takes.
void writeParameterStruct(std::ostringstream& out, const Parameters& parameters);
/// The function that fills it with the defaults.
void writeDefaultParameters(std::ostringstream& out, const Parameters& parameters);

/// Header and source from their contents: banner, include guard, name.
GeneratedCode finishCode(const std::string& name, const std::string& header, const std::string& source);

}  // namespace codegen
}  // namespace swarm_planner
