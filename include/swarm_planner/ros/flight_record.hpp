// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "swarm_planner/ros/motion_file.hpp"
#include "swarm_planner/swarm/flight_mode.hpp"
#include "swarm_planner/swarm/mission.hpp"

namespace swarm_planner {

/// What operators have asked of one UAV, beyond the scenario.
struct UavOrders {
  struct Reference {
    std::vector<Vector3> path;  ///< planning frame [m]
    double start = 0.0;         ///< [m]
    double speed = 0.0;         ///< [m/s]
  };
  FlightMode mode = FlightMode::kWaiting;
  std::optional<Reference> reference;  ///< set by service
};

/// The memory of a flight outside the process, from which a planner that is started in flight takes over: the committed
/// motions (PATH.motions, every cycle) and the operators' orders (PATH.orders.yaml, on every change).
///
/// A record counts only for the same scenario, and only if it was made under the same ROS master (/run_id), or less
/// than kMasterRestart ago should the master have been restarted too. Of such a record
///  - orders hold without limit: a swarm that was told to stay must not fly off;
///  - motions hold if they are younger than kLongestWait, which no battery outlasts, and if ROS time has not gone back
///    since. Each UAV's odometry has to agree with them besides (SwarmPlanner::takeOver).
class FlightRecord {
 public:
  static constexpr double kMasterRestart = 60.0;  ///< [s] of wall time
  static constexpr double kLongestWait = 1800.0;  ///< [s] of wall time

  /// `path` without the files' endings; its folder is made. `run_id`: of the ROS master. `wall`: wall time [s]. Throws
  /// std::runtime_error with the reason if no record can be kept there.
  FlightRecord(const std::string& path, const Mission& mission, const std::string& run_id, double wall);

  /// Orders of the same flight, one per UAV; nothing but defaults if there are none.
  const std::vector<UavOrders>& orders() const { return orders_; }
  /// Motions that hold at ROS time `now` [s]; empty if there are none. Asked once, in the first cycle.
  std::optional<FlightMemory> takeMotions(double now, double wall);
  /// Why something that was found is not used; empty if everything is, or nothing was found.
  const std::string& ignored() const { return ignored_; }

  /// Keep orders, if they are new. False if they could not be written: they do not outlive the process then.
  bool setModes(const std::vector<FlightMode>& modes);
  bool setReference(std::size_t uav, const UavOrders::Reference& reference);

  /// Keeps the motions of a cycle; before its setpoints are sent.
  void write(const SwarmPlanner& planner, std::size_t obstacles, double now, double wall);
  /// ROS time has jumped back: the motions are of another time.
  void forgetMotions();

 private:
  bool isSameFlight(const FlightIdentity& identity, double wall) const;
  void readOrders(double wall);
  bool writeOrders();

  const std::string orders_path_;
  const std::vector<std::string> names_;
  FlightIdentity identity_;
  std::vector<UavOrders> orders_;
  std::string ignored_;
  MotionFile motions_;
  std::optional<MotionFile::Content> left_;
};

/// Where planner `node` (its full name) under the ROS master `master_uri` keeps its record unless told otherwise: in
/// memory, in a folder of the user's own.
std::string defaultRecordPath(const std::string& node, const std::string& master_uri);

}  // namespace swarm_planner
