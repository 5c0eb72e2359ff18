// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <yaml-cpp/yaml.h>

#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "number_range.hpp"
#include "swarm_planner/config/faults.hpp"
#include "swarm_planner/config/types.hpp"

namespace swarm_planner {

/// A YAML file being read: its name for faults, and where the faults go. Must outlive the nodes read from it.
struct YamlSource {
  std::string name;
  Faults& faults;
};

using YamlScalar = std::variant<bool, int, double, std::string>;

/// A value of a YAML document together with the path of keys that leads to it, e.g. "uavs[2].target.speed".
///
/// The reading functions return nothing after adding a fault that says what was found, what was expected and in
/// which line. They are stricter than yaml-cpp's conversions: "5" in quotes is no number, 5 is no text, yes is no
/// boolean, and numbers must be finite unless the range says otherwise.
class YamlNode {
 public:
  YamlNode(const YAML::Node& node, std::string key, const YamlSource& source);

  /// The root of the only document in `text`; nothing after a fault about syntax, an empty text or more documents.
  static std::optional<YamlNode> parse(const std::string& text, const YamlSource& source);
  /// The same for the file `source.name`, which may also be unreadable.
  static std::optional<YamlNode> load(const YamlSource& source);

  const std::string& key() const { return key_; }
  /// Adds a fault about this node; the message gets the line number.
  void fault(const std::string& message) const;
  /// Adds the fault "found ..., expected ...".
  void unexpected(const std::string& expected) const;
  /// Adds a fault about `child` of this node, a key that is missing or wrong.
  void faultAt(const std::string& child, const std::string& message) const;

  std::optional<double> number(const NumberRange& range) const;
  std::optional<int> wholeNumber(const NumberRange& range) const;
  std::optional<bool> boolean() const;
  std::optional<std::string> text() const;
  /// A list of three numbers, each in `range`.
  std::optional<Vector3> vector3(const NumberRange& range) const;
  /// The elements of a list, keyed "key[0]", "key[1]" ...; `expected` describes the list.
  std::optional<std::vector<YamlNode>> list(const std::string& expected) const;
  /// The entries of a map by name, without repeated keys (each a fault; the first one counts).
  std::optional<std::vector<std::pair<std::string, YamlNode>>> entries() const;
  /// A scalar of whatever type its text has; nothing, without a fault, if this is no scalar.
  std::optional<YamlScalar> scalar() const;
  /// A number as it stands, also an infinity or NaN; nothing, without a fault, if this is no number.
  std::optional<double> anyNumber() const;

 private:
  /// The scalar as written, if it is neither null nor in quotes.
  std::optional<std::string> plainScalar() const;
  std::string childKey(const std::string& child) const;
  std::string found() const;

  YAML::Node node_;
  std::string key_;
  const YamlSource* source_;
};

/// A map of a YAML document with a fixed set of legal keys; anything else in it is a fault.
///
/// The read functions fault a missing key, leave `out` alone after any fault and return whether they wrote it. If the
/// node is no map, that is the one fault, and all keys count as absent without a further one.
class YamlMap {
 public:
  YamlMap(YamlNode node, const std::vector<std::string>& known);

  bool isMap() const { return is_map_; }
  bool has(const std::string& key) const { return find(key) != nullptr; }
  /// The child if the key is there.
  const YamlNode* find(const std::string& key) const;
  /// The child; a missing key is a fault that says what was expected.
  const YamlNode* require(const std::string& key, const std::string& expected) const;

  bool read(const std::string& key, const NumberRange& range, double& out) const;
  bool read(const std::string& key, const NumberRange& range, int& out) const;
  bool read(const std::string& key, const NumberRange& range, Vector3& out) const;
  bool read(const std::string& key, std::string& out) const;

 private:
  YamlNode node_;
  bool is_map_ = false;
  std::vector<std::pair<std::string, YamlNode>> entries_;
};

}  // namespace swarm_planner
