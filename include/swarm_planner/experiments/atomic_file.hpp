// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <fstream>
#include <string>

namespace swarm_planner {

/// A file that appears under its name complete or not at all: it is written beside it and renamed.
class AtomicFile {
 public:
  /// Throws std::runtime_error if nothing can be written there, before any work is done.
  explicit AtomicFile(const std::string& path);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  /// Writes `content` and gives the file its name. Throws std::runtime_error if that fails.
  void write(const std::string& content);

 private:
  std::string path_;
  std::string unfinished_path_;
  std::ofstream stream_;
};

}  // namespace swarm_planner
