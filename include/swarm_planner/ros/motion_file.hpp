// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "swarm_planner/swarm/flight_memory.hpp"
#include "swarm_planner/swarm/swarm_planner.hpp"

namespace swarm_planner {

/// To which flight a record belongs.
struct FlightIdentity {
  std::uint64_t scenario = 0;  ///< fingerprint of its text
  std::uint64_t run = 0;       ///< fingerprint of /run_id: of this life of the ROS master
};

/// The motions that a planner has committed, in a file that is mapped into memory: it outlives the process however that
/// ends, and writing it takes no system call. Of each UAV the newest two are kept; the older one is left alone while
/// the newest is written, and sums tell what has not been written to its end.
class MotionFile {
 public:
  /// What a planner before has left.
  struct Content {
    FlightIdentity identity;
    double now = 0.0;      ///< ROS time of the last cycle [s]
    double written = 0.0;  ///< wall time of the last cycle [s]
    FlightMemory memory;
  };

  /// Opens or creates the file. Throws std::runtime_error with the reason if that is not possible, among others because
  /// another process that lives has it.
  MotionFile(const std::string& path, std::size_t uavs);
  ~MotionFile();
  MotionFile(const MotionFile&) = delete;
  MotionFile& operator=(const MotionFile&) = delete;

  /// Empty if there is none, or of another format or number of UAVs. Motions that are damaged are left out.
  std::optional<Content> read() const;
  /// Forgets what is in it.
  void clear();
  /// The UAV has a new reference: its progress, as written, is of the one before.
  void noteNewReference(std::size_t uav);
  /// After a cycle, before its setpoints are sent: a motion that others may hear of is in the file. Takes no heap.
  void write(const SwarmPlanner& planner, const FlightIdentity& identity, std::size_t obstacles, double now,
             double wall);

 private:
  struct Header;
  struct Slot;
  struct Entry;
  struct Layout;
  Header& header() const;
  Entry& entry(std::size_t uav) const;

  const std::size_t uavs_;
  std::size_t size_ = 0;
  int file_ = -1;
  void* memory_ = nullptr;
};

}  // namespace swarm_planner
