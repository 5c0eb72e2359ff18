// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#pragma once

#include <cstdint>
#include <vector>

#include "swarm_planner/experiments/closed_loop_run.hpp"
#include "swarm_planner/simulation/random_stream.hpp"

namespace swarm_planner {

/// One mission after the other: each UAV gets a random goal, out of the way of obstacles, and the next one once it is
/// there or has tried for long enough. What moves through the field comes again from where it began when it has left it
/// as far on the other side.
class RandomMissions : public RunDirector {
 public:
  /// `field`: where goals are. `mission` and `planner` must outlive this.
  RandomMissions(const Mission& mission, const Workspace& field, SwarmCyclePlanner& planner, std::uint64_t seed);

  void beforeCycle(double now, const std::vector<QuadSimulator>& vehicles, bool restarted) override;
  double obstacleTime(std::size_t index, double t) const override;

  std::size_t flown() const;        ///< goals that were reached
  std::size_t fewestFlown() const;  ///< by one UAV
  std::size_t abandoned() const;    ///< goals that were given up

 private:
  struct Leg {
    Vector3 goal = Vector3::Zero();  ///< [m]
    double begin = 0.0;              ///< [s]
    bool given = false;
    std::size_t flown = 0, abandoned = 0;
  };

  Vector3 drawGoal(std::size_t uav, const Vector3& position);
  bool isFree(const Vector3& goal, std::size_t uav) const;

  Workspace field_;
  SwarmCyclePlanner& planner_;
  RandomStream random_;
  double speed_;                           ///< of the targets [m/s]
  double apart_;                           ///< of two goals [m]
  double clearance_;                       ///< of a goal from obstacles, also on their way [m]
  std::vector<Superellipsoid> obstacles_;  ///< at their starts
  std::vector<double> periods_;            ///< after which each obstacle comes again [s]; infinite for those that stand
  std::vector<Leg> legs_;                  ///< one per UAV
};

}  // namespace swarm_planner
