// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/map/map_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <limits>
#include <locale>
#include <sstream>
#include <system_error>
#include <utility>

namespace swarm_planner {
namespace {

constexpr char kBinaryFirstLine[] = "# Octomap OcTree binary file";
constexpr char kFullFirstLine[] = "# Octomap OcTree file";
// OctoMap's own headers take 150 bytes; the rest is room for comments.
constexpr std::size_t kMostHeaderBytes = 10000;

/// The lines before the nodes.
class Header {
 public:
  explicit Header(const std::vector<std::uint8_t>& bytes)
      : text_(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(std::min(bytes.size(), kMostHeaderBytes))) {}

  bool nextLine(std::string& line) {
    const std::size_t end = text_.find('\n', at_);
    if (end == std::string::npos) return false;
    line = text_.substr(at_, end - at_);
    if (!line.empty() && line.back() == '\r') line.pop_back();
    at_ = end + 1;
    return true;
  }
  /// Of what follows the last line.
  std::size_t position() const { return at_; }

 private:
  std::string text_;
  std::size_t at_ = 0;
};

/// What the header states.
struct Statements {
  bool binary = false;
  std::string id;
  double resolution = std::numeric_limits<double>::quiet_NaN();
  std::optional<std::size_t> nodes;
};

/// One line "key value"; false if it is none that is known.
bool readStatement(const std::string& line, Statements& statements) {
  std::istringstream stream(line);
  stream.imbue(std::locale::classic());
  std::string key;
  stream >> key;
  if (key == "id") return static_cast<bool>(stream >> statements.id);
  if (key == "res") {
    // What is no number, such as nan, leaves the resolution without a value.
    if (!(stream >> statements.resolution)) statements.resolution = std::numeric_limits<double>::quiet_NaN();
    return true;
  }
  if (key != "size") return false;
  std::size_t nodes = 0;
  if (!(stream >> nodes)) return false;
  statements.nodes = nodes;
  return true;
}

std::string shown(const std::string& line) {
  std::string text = line.substr(0, 40);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return "'" + text + "'";
}

bool readHeader(Header& header, Statements& statements, std::string& why) {
  std::string line;
  if (!header.nextLine(line) || (line != kBinaryFirstLine && line != kFullFirstLine)) {
    why = "it is no file of OctoMap: its first line is not '" + std::string(kBinaryFirstLine) + "' or '" +
          kFullFirstLine + "'";
    return false;
  }
  statements.binary = line == kBinaryFirstLine;
  while (header.nextLine(line)) {
    if (line == "data") return true;
    if (line.empty() || line.front() == '#' || readStatement(line, statements)) continue;
    why = "its header has the line " + shown(line) + ", expected id, size, res or data";
    return false;
  }
  why = "its header is cut off";
  return false;
}

}  // namespace

std::optional<OctreeData> parseMapFile(std::vector<std::uint8_t> bytes, std::string& why) {
  if (bytes.empty()) {
    why = "it is empty";
    return std::nullopt;
  }
  Header header(bytes);
  Statements statements;
  if (!readHeader(header, statements, why)) return std::nullopt;
  const std::optional<OctreeEncoding> encoding = encodingOf(statements.id, statements.binary, why);
  if (!encoding) return std::nullopt;
  why = resolutionFault(statements.resolution);
  if (!why.empty()) return std::nullopt;
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(header.position()));
  return OctreeData{*encoding, statements.resolution, statements.nodes, std::move(bytes)};
}

std::optional<OctreeData> readMapFile(const std::string& path, std::string& why) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) {
    why = "there is no such file";
    return std::nullopt;
  }
  // A pipe or a device has no end.
  if (!std::filesystem::is_regular_file(path, error)) {
    why = "it is no regular file";
    return std::nullopt;
  }
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMostMapBytes) {
    why = error ? "it cannot be read" : "it is longer than " + std::to_string(kMostMapBytes) + " bytes";
    return std::nullopt;
  }
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(size));
  std::ifstream file(path, std::ios::binary);
  if (!file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size))) {
    why = "it cannot be read";
    return std::nullopt;
  }
  return parseMapFile(std::move(bytes), why);
}

}  // namespace swarm_planner
