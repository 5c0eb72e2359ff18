// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "swarm_planner/simulation/run_monitor.hpp"

namespace swarm_planner {

/// A JSON object on one line whose members keep the order in which they are added. Numbers have 12 significant digits,
/// whatever the locale.
class JsonObject {
 public:
  JsonObject();

  JsonObject& add(const std::string& key, const std::string& text);
  JsonObject& add(const std::string& key, const JsonObject& object);
  /// null if empty; JSON knows neither NaN nor infinity: they are null, too.
  JsonObject& add(const std::string& key, const std::optional<double>& number);
  JsonObject& addCount(const std::string& key, unsigned long long count);
  JsonObject& addCounts(const std::string& key, const std::vector<unsigned long long>& counts);
  JsonObject& add(const std::string& key, const std::vector<std::string>& texts);
  JsonObject& add(const std::string& key, const std::vector<JsonObject>& objects);
  JsonObject& addFlag(const std::string& key, bool flag);

  std::string text() const { return "{" + members_.str() + "}"; }

 private:
  void addKey(const std::string& key);
  JsonObject& addRaw(const std::string& key, const std::string& value);

  std::ostringstream members_;
};

/// {"mean", "max"}
JsonObject toObject(const MeanMax& x);

}  // namespace swarm_planner
