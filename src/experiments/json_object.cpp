// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/json_object.hpp"

#include <cmath>
#include <cstdio>
#include <locale>

namespace swarm_planner {
namespace {

std::string jsonText(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      quoted += '\\';
      quoted += c;
    } else if (static_cast<unsigned char>(c) < 0x20) {
      char code[8];
      std::snprintf(code, sizeof(code), "\\u%04x", static_cast<unsigned>(c));
      quoted += code;
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

/// An array of what `text` makes of each item.
template <class Item, class Text>
std::string jsonArray(const std::vector<Item>& items, const Text& text) {
  std::string array;
  for (const Item& item : items) array += (array.empty() ? "" : ", ") + text(item);
  return "[" + array + "]";
}

}  // namespace

JsonObject::JsonObject() {
  members_.imbue(std::locale::classic());
  members_.precision(12);
}

JsonObject& JsonObject::add(const std::string& key, const std::string& text) { return addRaw(key, jsonText(text)); }

JsonObject& JsonObject::add(const std::string& key, const JsonObject& object) { return addRaw(key, object.text()); }

JsonObject& JsonObject::add(const std::string& key, const std::optional<double>& number) {
  addKey(key);
  if (number && std::isfinite(*number)) {
    members_ << *number;
  } else {
    members_ << "null";
  }
  return *this;
}

JsonObject& JsonObject::addCounts(const std::string& key, const std::vector<unsigned long long>& counts) {
  std::string list;
  for (const unsigned long long count : counts) list += (list.empty() ? "" : ", ") + std::to_string(count);
  return addRaw(key, "[" + list + "]");
}

JsonObject& JsonObject::add(const std::string& key, const std::vector<std::string>& texts) {
  return addRaw(key, jsonArray(texts, jsonText));
}

JsonObject& JsonObject::add(const std::string& key, const std::vector<JsonObject>& objects) {
  return addRaw(key, jsonArray(objects, [](const JsonObject& object) { return object.text(); }));
}

JsonObject& JsonObject::addCount(const std::string& key, unsigned long long count) {
  return addRaw(key, std::to_string(count));
}

JsonObject& JsonObject::addFlag(const std::string& key, bool flag) { return addRaw(key, flag ? "true" : "false"); }

void JsonObject::addKey(const std::string& key) {
  members_ << (members_.tellp() > 0 ? ", " : "") << jsonText(key) << ": ";
}

JsonObject& JsonObject::addRaw(const std::string& key, const std::string& value) {
  addKey(key);
  members_ << value;
  return *this;
}

JsonObject toObject(const MeanMax& x) {
  JsonObject object;
  object.add("mean", x.mean).add("max", x.max);
  return object;
}

}  // namespace swarm_planner
