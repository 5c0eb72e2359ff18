// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/atomic_file.hpp"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <stdexcept>

namespace swarm_planner {

AtomicFile::AtomicFile(const std::string& path)
    : path_(path), unfinished_path_(path + "." + std::to_string(getpid()) + ".unfinished") {
  if (std::filesystem::is_directory(path)) throw std::runtime_error(path + ": is a directory");
  stream_.open(unfinished_path_, std::ios::binary | std::ios::trunc);
  if (!stream_) throw std::runtime_error(path + ": cannot be written");
}

AtomicFile::~AtomicFile() {
  stream_.close();
  std::remove(unfinished_path_.c_str());  // no longer there once it has been renamed
}

void AtomicFile::write(const std::string& content) {
  stream_ << content;
  stream_.close();
  if (!stream_ || std::rename(unfinished_path_.c_str(), path_.c_str()) != 0) {
    throw std::runtime_error(path_ + ": cannot be written");
  }
}

}  // namespace swarm_planner
