// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include <algorithm>
#include <cmath>
#include <set>

#include "number_text.hpp"
#include "parameter_table.hpp"
#include "spelling.hpp"

namespace swarm_planner {

namespace {

/// A plan has to last until later ones have replaced it, so a cycle may take this many stages at most.
constexpr double kMostStagesPerCycle = 5.0;

/// What of the margins tracking_error is unless it is given.
constexpr double kErrorShare = 0.5;

/// A computed number with as many decimals as a reader wants.
double forMessage(double number) { return std::round(1e4 * number) / 1e4; }

/// Values of all parameters as they are put together, with who gave each of them.
class Resolution {
 public:
  Resolution(const std::string& overrides_source, Faults& faults)
      : overrides_source_(overrides_source), faults_(faults) {}

  void takeGiven(const ParameterMap& given) {
    for (const auto& [name, value] : given) {
      const ParameterEntry* entry = findParameter(name);
      const std::optional<std::string> message = entry ? valueFault(*entry, value) : unknownKeyMessage(name, names());
      if (message) {
        fault(name, *message);
      } else if (!isAuto(value)) {
        set(*entry, value);
      }
    }
  }

  void takeOverrides(const std::map<std::string, double>& overrides) {
    for (const auto& [name, value] : overrides) {
      overridden_.insert(name);
      if (const std::optional<std::string> message = overrideFault(name, value)) {
        fault(name, *message);
      } else {
        set(*findParameter(name), value);
      }
    }
  }

  /// The rules of parameter_io.hpp for whatever is not set. Later rules use the results of earlier ones.
  void applyRules() {
    LimitParameters& limits = parameters.limits;
    TimeParameters& time = parameters.time;
    if (!isSet("sampling_time")) time.sampling_time = samplingTime(limits.pair_distance / limits.max_speed);
    if (!isSet("cycle_period")) time.cycle_period = time.sampling_time;
    const double scale = time.sampling_time / TimeParameters().sampling_time;
    if (!isSet("zeta")) parameters.cost.zeta = CostParameters().zeta * std::pow(scale, 3);
    if (!isSet("velocity_time")) parameters.cost.velocity_time = CostParameters().velocity_time * scale;
    if (!isSet("pair_distance_vertical")) limits.pair_distance_vertical = limits.pair_distance;
    if (!isSet("tracking_margin")) {
      limits.tracking_margin = std::clamp(0.1 * std::min(2.0 * limits.uav_radius, limits.pair_distance), 0.02, 0.2);
    }
    if (!isSet("pair_margin")) {
      limits.pair_margin = std::max(limits.tracking_margin, std::min(0.1 * limits.pair_distance, 0.2));
    }
    if (!isSet("tracking_error"))
      limits.tracking_error = kErrorShare * std::min(limits.tracking_margin, 0.5 * limits.pair_margin);
    if (!isSet("lost_growth_limit")) parameters.input.lost_growth_limit = limits.pair_distance;
    if (!isSet("setpoint_repeats")) parameters.input.setpoint_repeats = parameters.simulation.drop > 0.0 ? 1 : 0;
    if (limits.as_paper) leaveToPaper();
  }

  /// Checks of one parameter against another. A parameter that already has a fault is not judged again.
  void crossCheck() {
    const Parameters& p = parameters;
    if (p.cost.robustness_inner >= p.cost.robustness_outer) {
      faultPair("robustness_inner", "robustness_outer",
                "expected robustness_inner < robustness_outer, found " + formatNumber(p.cost.robustness_inner) +
                    " and " + formatNumber(p.cost.robustness_outer));
    }
    const double most_ratio = 4.0 * p.vehicle.force_constant * p.vehicle.max_rotor_speed * p.vehicle.max_rotor_speed /
                              (p.vehicle.mass * p.vehicle.gravity);
    if (most_ratio < p.limits.max_thrust_ratio) {
      faultPair("max_thrust_ratio", "max_rotor_speed",
                "expected at most what four rotors give, 4 force_constant max_rotor_speed^2 / (mass gravity) = " +
                    formatNumber(forMessage(most_ratio)) + ", found " + formatNumber(p.limits.max_thrust_ratio));
    }
    if (p.time.cycle_period > kMostStagesPerCycle * p.time.sampling_time) {
      faultPair("cycle_period", "sampling_time",
                "expected at most " + formatNumber(kMostStagesPerCycle) + " sampling times of " +
                    formatNumber(p.time.sampling_time) + " s, found " + formatNumber(p.time.cycle_period) + " s");
    }
    checkTrackingError("tracking_margin", p.limits.tracking_margin, "");
    checkTrackingError("pair_margin", 0.5 * p.limits.pair_margin, "half of ");
    const double fastest_rate = std::max(p.simulation.odometry_rate, p.simulation.track_rate);
    if (p.simulation.step * fastest_rate > 1.0) {
      faultPair("step", "odometry_rate",
                "expected at most one period of odometry_rate and of track_rate, found " +
                    formatNumber(p.simulation.step) + " s against " + formatNumber(forMessage(1.0 / fastest_rate)) +
                    " s");
    }
  }

  Parameters parameters;

 private:
  /// Everything that the paper's method does not have.
  void leaveToPaper() {
    LimitParameters& limits = parameters.limits;
    limits.plan_check = limits.segment_constraints = limits.guide = limits.right_of_way = false;
    limits.latency_compensation = false;
  }

  static std::vector<std::string> names() {
    std::vector<std::string> names;
    for (const ParameterInfo& info : parameterTable()) names.push_back(info.name);
    return names;
  }

  /// pair_distance / max_speed, the time in which a UAV flies R_CA, rounded down to a multiple of 0.05 s.
  static double samplingTime(double time_for_distance) {
    constexpr double kPerSecond = 20.0, kRounding = 1e-9;
    return std::clamp(std::floor(time_for_distance * kPerSecond + kRounding) / kPerSecond, 0.15, 0.3);
  }

  /// A margin has room for the tracking errors that it is there for.
  void checkTrackingError(const std::string& margin, double most, const std::string& share) {
    const double error = parameters.limits.tracking_error;
    if (error <= most) return;
    faultPair("tracking_error", margin,
              "expected at most " + share + margin + ", " + formatNumber(forMessage(most)) + " m, found " +
                  formatNumber(error) + " m");
  }

  bool isSet(const std::string& name) const { return set_.count(name) > 0; }

  void set(const ParameterEntry& entry, const ParameterValue& value) {
    store(entry, value, parameters);
    set_.insert(entry.info.name);
  }

  void fault(const std::string& name, const std::string& message) {
    faulty_.insert(name);
    if (overridden_.count(name) > 0) {
      faults_.add(overrides_source_, "overrides." + name, message);
    } else {
      faults_.add("parameters", name, message);
    }
  }

  /// Blames the one of two parameters that the scenario sets, otherwise the first.
  void faultPair(const std::string& first, const std::string& second, const std::string& message) {
    if (faulty_.count(first) > 0 || faulty_.count(second) > 0) return;
    const bool only_second = overridden_.count(first) == 0 && overridden_.count(second) > 0;
    fault(only_second ? second : first, message);
  }

  const std::string& overrides_source_;
  Faults& faults_;
  std::set<std::string> set_, overridden_, faulty_;
};

}  // namespace

Parameters resolveParameters(const ParameterMap& given, const std::map<std::string, double>& overrides,
                             const std::string& overrides_source, Faults& faults) {
  Resolution resolution(overrides_source, faults);
  resolution.takeGiven(given);
  resolution.takeOverrides(overrides);
  resolution.applyRules();
  resolution.crossCheck();
  return resolution.parameters;
}

}  // namespace swarm_planner
