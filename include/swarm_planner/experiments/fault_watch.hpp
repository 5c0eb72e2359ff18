// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <vector>

#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/experiments/fault_summary.hpp"

namespace swarm_planner {

/// Watches what the planner makes of injected faults.
///
/// A fault is reported when its UAV's report bears a reason that tells of the vehicle, its odometry or its setpoints,
/// while the fault lasts or within kReportTime after it. Noticeable, so that it has to be reported, is
///   - odometry that cannot be used, once two cycles have met it (lost odometry: after odometry_timeout);
///   - odometry in whose place the fault makes a difference beyond what noise is taken for, two tracking margins, once
///     two cycles have met it (frozen odometry: after odometry_timeout);
///   - a vehicle that is off the motion that it should fly, and the one before, by more than noise and tracking
///   explain,
///     in position or velocity (FollowingWatch), to the same side in kStrayCycles cycles in a row: less cannot be told
///     from a gust or a push. One that rests where it is to rest, or flies on as its newest trajectory would have it,
///     does not show.
/// What concerns the whole swarm is not reported for a UAV and never counts as noticeable.
///
/// A UAV flies again when a new plan for it begins and its state is TRACKING; the time counts from the end of the last
/// of the faults that concerned it and overlapped. It also does when it is planned for, flies a motion that passes the
/// check, and new plans are refused for nothing but an obstacle that will come to where they rest: faults have no part
/// in that. Such recoveries are counted by themselves. For the same reason a UAV that was not tracking anyway when the
/// fault began is not waited for.
class FaultWatch : public RunObserver {
 public:
  static constexpr double kReportTime = 1.0;  ///< [s]
  static constexpr int kStrayCycles = 2;
  static constexpr double kRecoveryTime = 5.0;  ///< longer is listed among the misses [s]

  /// All must outlive the watch. No heap allocation afterwards.
  FaultWatch(const Mission& mission, const CyclePlanner& planner);

  void onSample(double t, const std::vector<QuadSimulator>& vehicles, const std::vector<Superellipsoid>&) override;
  void onCycle(double epoch, const CycleReport& report) override;

  FaultSummary summary() const;

 private:
  struct Record {
    FaultInjection fault;
    std::size_t uav = 0;              ///< uavs_.size(): all
    double end = 0.0;                 ///< [s]
    int met = 0;                      ///< cycles that had to see it
    Vector3 place = Vector3::Zero();  ///< of the vehicle when it began [m]
    double moved = 0.0;               ///< farthest from there until two cycles before its end [m]
    int strays = 0;                   ///< cycles in a row that have found the vehicle off its motion, to the same side
    int strayed = 0;                  ///< the most of them
    Vector3 side = Vector3::Zero();   ///< in the last of them [m]
    double first_report = 0.0;
    bool reported = false;
    double recovery_time = 0.0;
    std::size_t waiting = 0;  ///< UAVs that have not recovered yet
  };
  struct Uav {
    CommittedMotion due, before;  ///< made in the last cycle, and in that before
    bool has_due = false, has_before = false;
    QuadState state;              ///< of the vehicle, at the last sample
    bool tracks = false;          ///< in the last cycle
    double clear_at = 0.0;        ///< end of the last fault that has begun
    bool waiting = false;         ///< has not flown since
    std::size_t unrecovered = 0;  ///< the first record that it has not recovered from, if it is concerned
  };

  double twoCycles() const { return 2.0 * parameters_.time.cycle_period; }  ///< [s]
  bool concerns(const Record& record, std::size_t uav) const { return record.uav == uav || record.uav == uavs_.size(); }
  void watchVehicle(Record& record, double now) const;
  void begin(Record& record);
  void recover(std::size_t uav, double epoch);
  /// When the planner can see the fault at the earliest [s].
  double visibleFrom(const Record& record) const;
  bool isNoticeable(const Record& record) const;

  const Parameters& parameters_;
  const CyclePlanner& planner_;
  std::vector<Record> records_;  ///< by beginning
  std::vector<Uav> uavs_;
  std::size_t begun_ = 0;     ///< records that have begun
  std::size_t finished_ = 0;  ///< so many of the first ones need no more watching
  std::size_t waited_ = 0;    ///< recoveries of UAVs that wait for an obstacle
};

/// Whether a reason tells of a vehicle, its odometry or its setpoints, and not of planning alone.
bool tellsOfFault(Reason reason);

}  // namespace swarm_planner
