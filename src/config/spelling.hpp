// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <string>
#include <vector>

namespace swarm_planner {

/// `text` in double quotes.
std::string quoted(const std::string& text);

/// Message about a key that nobody reads: names the closest known key if one is close, otherwise all of them
/// (or the first few of many).
std::string unknownKeyMessage(const std::string& key, const std::vector<std::string>& known);

}  // namespace swarm_planner
