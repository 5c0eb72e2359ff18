// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>

namespace swarm_planner {

/// Whether `text` goes on after its first YAML document. Throws YAML::Exception where the syntax is wrong.
/// YAML::Load() ignores what follows the first document, and YAML::LoadAll() never returns for some of it.
bool hasMoreThanOneYamlDocument(const std::string& text);

}  // namespace swarm_planner
