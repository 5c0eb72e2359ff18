// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "yaml_reader.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <utility>

#include "number_text.hpp"
#include "spelling.hpp"

namespace swarm_planner {

namespace {

std::string lineNote(const YAML::Mark& mark) {
  return mark.is_null() ? "" : " (line " + std::to_string(mark.line + 1) + ")";
}

/// yaml-cpp also takes yes, on, y and others; YAML 1.2 and this reader do not.
std::optional<bool> parseBoolean(const std::string& text) {
  if (text == "true" || text == "True" || text == "TRUE") return true;
  if (text == "false" || text == "False" || text == "FALSE") return false;
  return std::nullopt;
}

/// The first line of a text, and of that not too much.
std::string excerpt(const std::string& text) {
  constexpr std::size_t kMost = 60;
  const std::string line = text.substr(0, std::min(text.find('\n'), kMost));
  return line.size() < text.size() ? line + "..." : line;
}

}  // namespace

YamlNode::YamlNode(const YAML::Node& node, std::string key, const YamlSource& source)
    : node_(node), key_(std::move(key)), source_(&source) {}

std::optional<YamlNode> YamlNode::parse(const std::string& text, const YamlSource& source) {
  try {
    const std::vector<YAML::Node> documents = YAML::LoadAll(text);
    if (documents.size() == 1 && !documents.front().IsNull()) return YamlNode(documents.front(), "", source);
    source.faults.add(source.name, "",
                      documents.size() > 1
                          ? "found " + std::to_string(documents.size()) + " YAML documents, expected one"
                          : std::string("found nothing, expected a YAML map"));
  } catch (const YAML::Exception& error) {
    source.faults.add(source.name, "", "no legal YAML: " + error.msg + lineNote(error.mark));
  }
  return std::nullopt;
}

std::optional<YamlNode> YamlNode::load(const YamlSource& source) {
  std::error_code ignored;
  std::ifstream file(source.name, std::ios::binary);
  if (!file || std::filesystem::is_directory(source.name, ignored)) {
    source.faults.add(source.name, "", "cannot be read, expected a YAML file");
    return std::nullopt;
  }
  std::ostringstream text;
  text << file.rdbuf();
  return parse(text.str(), source);
}

void YamlNode::fault(const std::string& message) const {
  source_->faults.add(source_->name, key_, message + lineNote(node_.Mark()));
}

void YamlNode::unexpected(const std::string& expected) const { fault("found " + found() + ", expected " + expected); }

void YamlNode::faultAt(const std::string& child, const std::string& message) const {
  source_->faults.add(source_->name, childKey(child), message + lineNote(node_.Mark()));
}

std::optional<double> YamlNode::number(const NumberRange& range) const {
  const std::optional<double> value = anyNumber();
  if (value && range.contains(*value)) return value;
  unexpected(numberIn(range));
  return std::nullopt;
}

std::optional<int> YamlNode::wholeNumber(const NumberRange& range) const {
  const std::optional<std::string> scalar = plainScalar();
  const std::optional<int> value = scalar ? parseWholeNumber(*scalar) : std::nullopt;
  if (value && range.contains(*value)) return value;
  unexpected(wholeNumberIn(range));
  return std::nullopt;
}

std::optional<bool> YamlNode::boolean() const {
  const std::optional<std::string> scalar = plainScalar();
  const std::optional<bool> value = scalar ? parseBoolean(*scalar) : std::nullopt;
  if (!value) unexpected("true or false");
  return value;
}

std::optional<std::string> YamlNode::text() const {
  const std::optional<std::string> scalar = plainScalar();
  const bool is_other_type = scalar && (parseNumber(*scalar) || parseBoolean(*scalar));
  if (node_.IsScalar() && !is_other_type && !node_.Scalar().empty()) return node_.Scalar();
  unexpected(is_other_type ? "text (put it in quotes)" : "text");
  return std::nullopt;
}

std::optional<Vector3> YamlNode::vector3(const NumberRange& range) const {
  const bool is_triple = node_.IsSequence() && node_.size() == 3;
  if (!is_triple) unexpected(vectorIn(range));
  const auto elements = is_triple ? list(vectorIn(range)) : std::nullopt;
  if (!elements) return std::nullopt;
  Vector3 vector = Vector3::Zero();
  bool complete = true;
  Eigen::Index axis = 0;
  for (const YamlNode& element : *elements) {
    const std::optional<double> value = element.number(range);
    complete = complete && value;
    vector[axis++] = value.value_or(0.0);
  }
  return complete ? std::optional<Vector3>(vector) : std::nullopt;
}

std::optional<std::vector<YamlNode>> YamlNode::list(const std::string& expected) const {
  if (!node_.IsSequence()) {
    unexpected(expected);
    return std::nullopt;
  }
  std::vector<YamlNode> elements;
  elements.reserve(node_.size());
  for (const YAML::Node& element : node_) {
    elements.emplace_back(element, key_ + "[" + std::to_string(elements.size()) + "]", *source_);
  }
  return elements;
}

std::optional<std::vector<std::pair<std::string, YamlNode>>> YamlNode::entries() const {
  if (!node_.IsMap()) {
    unexpected("a map");
    return std::nullopt;
  }
  std::vector<std::pair<std::string, YamlNode>> entries;
  std::map<std::string, YAML::Mark> first_marks;
  for (const auto& entry : node_) {
    if (!entry.first.IsScalar()) {
      YamlNode(entry.first, key_, *source_).fault("found a key that is not text");
      continue;
    }
    const std::string& name = entry.first.Scalar();
    const auto [first, is_new] = first_marks.emplace(name, entry.first.Mark());
    if (is_new) {
      entries.emplace_back(name, YamlNode(entry.second, childKey(name), *source_));
    } else {
      YamlNode(entry.first, childKey(name), *source_)
          .fault("repeated key, first given in line " + std::to_string(first->second.line + 1));
    }
  }
  return entries;
}

std::optional<YamlScalar> YamlNode::scalar() const {
  if (!node_.IsScalar()) return std::nullopt;
  if (const std::optional<std::string> plain = plainScalar()) {
    if (const std::optional<bool> boolean = parseBoolean(*plain)) return *boolean;
    if (const std::optional<int> whole = parseWholeNumber(*plain)) return *whole;
    if (const std::optional<double> number = parseNumber(*plain)) return *number;
  }
  return node_.Scalar();
}

std::optional<double> YamlNode::anyNumber() const {
  const std::optional<std::string> plain = plainScalar();
  return plain ? parseNumber(*plain) : std::nullopt;
}

std::optional<std::string> YamlNode::plainScalar() const {
  // yaml-cpp tags plain scalars "?" and those in quotes "!".
  if (!node_.IsScalar() || node_.Tag() != "?") return std::nullopt;
  return node_.Scalar();
}

std::string YamlNode::childKey(const std::string& child) const { return key_.empty() ? child : key_ + "." + child; }

std::string YamlNode::found() const {
  switch (node_.Type()) {
    case YAML::NodeType::Sequence:
      return node_.size() == 0 ? "an empty list" : "a list of " + std::to_string(node_.size());
    case YAML::NodeType::Map:
      return "a map";
    case YAML::NodeType::Scalar:
      break;
    default:
      return "nothing";
  }
  const std::optional<std::string> scalar = plainScalar();
  const bool is_literal = scalar && (parseNumber(*scalar) || parseBoolean(*scalar));
  return is_literal ? *scalar : quoted(excerpt(node_.Scalar()));
}

YamlMap::YamlMap(YamlNode node, const std::vector<std::string>& known) : node_(std::move(node)) {
  std::optional<std::vector<std::pair<std::string, YamlNode>>> entries = node_.entries();
  if (!entries) return;
  is_map_ = true;
  for (std::pair<std::string, YamlNode>& entry : *entries) {
    if (std::find(known.begin(), known.end(), entry.first) == known.end()) {
      entry.second.fault(unknownKeyMessage(entry.first, known));
    } else {
      entries_.push_back(std::move(entry));
    }
  }
}

const YamlNode* YamlMap::find(const std::string& key) const {
  for (const auto& entry : entries_) {
    if (entry.first == key) return &entry.second;
  }
  return nullptr;
}

const YamlNode* YamlMap::require(const std::string& key, const std::string& expected) const {
  const YamlNode* child = find(key);
  if (child == nullptr && is_map_) node_.faultAt(key, "missing, expected " + expected);
  return child;
}

bool YamlMap::read(const std::string& key, const NumberRange& range, double& out) const {
  const YamlNode* child = require(key, numberIn(range));
  const std::optional<double> value = child ? child->number(range) : std::nullopt;
  if (value) out = *value;
  return value.has_value();
}

bool YamlMap::read(const std::string& key, const NumberRange& range, int& out) const {
  const YamlNode* child = require(key, wholeNumberIn(range));
  const std::optional<int> value = child ? child->wholeNumber(range) : std::nullopt;
  if (value) out = *value;
  return value.has_value();
}

bool YamlMap::read(const std::string& key, const NumberRange& range, Vector3& out) const {
  const YamlNode* child = require(key, vectorIn(range));
  const std::optional<Vector3> value = child ? child->vector3(range) : std::nullopt;
  if (value) out = *value;
  return value.has_value();
}

bool YamlMap::read(const std::string& key, std::string& out) const {
  const YamlNode* child = require(key, "text");
  const std::optional<std::string> value = child ? child->text() : std::nullopt;
  if (value) out = *value;
  return value.has_value();
}

}  // namespace swarm_planner
