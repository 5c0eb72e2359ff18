// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "parameter_table.hpp"

#include <utility>

namespace swarm_planner {
namespace {

using Range = NumberRange;

constexpr const char* kPlannerFile = "planner.yaml";
constexpr const char* kSimulationFile = "simulation.yaml";

/// The default is what a fresh Parameters holds: parameters.hpp alone gives it.
ParameterValue defaultValue(const ParameterSlot& slot) {
  Parameters defaults;
  return std::visit([&defaults](const auto& get) { return ParameterValue(get(defaults)); }, slot);
}

class TableBuilder {
 public:
  /// Of the parameters added from here on: the shipped file, and whether scenarios may set them.
  void section(const char* file, bool overridable) {
    file_ = file;
    overridable_ = overridable;
  }

  void number(const char* name, const char* unit, Range range, double& (*slot)(Parameters&), const char* description) {
    add(name, unit, range, slot, description, range.text());
  }

  void wholeNumber(const char* name, Range range, int& (*slot)(Parameters&), const char* description) {
    add(name, "", range, slot, description, range.text());
  }

  /// Never overridable: overrides are numbers.
  void boolean(const char* name, bool& (*slot)(Parameters&), const char* description) {
    add(name, "", Range::finite(), slot, description, "true or false");
    entries_.back().info.overridable = false;
  }

  /// The parameter added last follows a rule unless it is given.
  void withRule() {
    entries_.back().info.has_rule = true;
    entries_.back().info.default_value = std::string("auto");
  }

  std::vector<ParameterEntry> take() { return std::move(entries_); }

 private:
  void add(const char* name, const char* unit, Range range, ParameterSlot slot, const char* description,
           std::string range_text) {
    ParameterEntry entry;
    entry.info.name = name;
    entry.info.unit = unit;
    entry.info.description = description;
    entry.info.default_value = defaultValue(slot);
    entry.info.range = std::move(range_text);
    entry.info.file = file_;
    entry.info.overridable = overridable_;
    entry.range = range;
    entry.slot = slot;
    entries_.push_back(std::move(entry));
  }

  const char* file_ = kPlannerFile;
  bool overridable_ = true;
  std::vector<ParameterEntry> entries_;
};

void addLimits(TableBuilder& table) {
  using P = Parameters;
  Range or_infinity = Range::above(0.0);
  or_infinity.allows_infinity = true;
  table.section(kPlannerFile, true);
  table.number(
      "max_speed", "m/s", Range::aboveUpTo(0.0, 100.0), [](P& p) -> double& { return p.limits.max_speed; },
      "most speed, Euclidean norm");
  table.number(
      "max_acceleration", "m/s^2", or_infinity, [](P& p) -> double& { return p.limits.max_acceleration; },
      "most acceleration, Euclidean norm; .inf: the thrust alone limits it");
  table.number(
      "max_jerk", "m/s^3", or_infinity, [](P& p) -> double& { return p.limits.max_jerk; },
      "most jerk of a plan that flies, Euclidean norm: attitude has to follow it");
  table.number(
      "max_thrust_ratio", "", Range::aboveUpTo(1.0, 10.0), [](P& p) -> double& { return p.limits.max_thrust_ratio; },
      "most thrust over weight, T_max / (M g) of (6)");
  table.number(
      "min_thrust_ratio", "", Range::open(0.0, 1.0), [](P& p) -> double& { return p.limits.min_thrust_ratio; },
      "least vertical thrust over weight, (A_z + g) / g; keeps the vehicle upright");
  table.number(
      "uav_radius", "m", Range::aboveUpTo(0.0, 10.0), [](P& p) -> double& { return p.limits.uav_radius; },
      "least distance of a UAV's centre to an obstacle's surface");
  table.number(
      "pair_distance", "m", Range::aboveUpTo(0.0, 100.0), [](P& p) -> double& { return p.limits.pair_distance; },
      "R_CA of (14), least centre distance of two UAVs side by side");
  table.number(
      "pair_distance_vertical", "m", Range::aboveUpTo(0.0, 100.0),
      [](P& p) -> double& { return p.limits.pair_distance_vertical; },
      "least centre distance of two UAVs above each other (downwash)");
  table.withRule();
  table.number(
      "tracking_margin", "m", Range::closed(0.0, 10.0), [](P& p) -> double& { return p.limits.tracking_margin; },
      "what the planner keeps on top of uav_radius, and inside the workspace, for tracking errors");
  table.withRule();
  table.number(
      "pair_margin", "m", Range::closed(0.0, 10.0), [](P& p) -> double& { return p.limits.pair_margin; },
      "what the planner keeps on top of the pair distances for the tracking errors of two UAVs");
  table.withRule();
  table.number(
      "tracking_error", "m", Range::closed(0.0, 10.0), [](P& p) -> double& { return p.limits.tracking_error; },
      "how far a vehicle may stray from what it is asked to fly; that part of the margins (twice, of a pair's) no plan "
      "may use up");
  table.withRule();
  table.boolean(
      "avoidance", [](P& p) -> bool& { return p.limits.avoidance; },
      "false: plans ignore obstacles and other UAVs; for negative controls only");
  table.boolean(
      "plan_check", [](P& p) -> bool& { return p.limits.plan_check; },
      "false: plans fly unchecked; for negative controls only");
  table.boolean(
      "segment_constraints", [](P& p) -> bool& { return p.limits.segment_constraints; },
      "false: constraints hold at the samples alone; for negative controls only");
  table.boolean(
      "guide", [](P& p) -> bool& { return p.limits.guide; },
      "false: no ways round what blocks references are searched; for negative controls only");
  table.boolean(
      "right_of_way", [](P& p) -> bool& { return p.limits.right_of_way; },
      "false: no UAV gives way where several block each other; for negative controls only");
  table.boolean(
      "latency_compensation", [](P& p) -> bool& { return p.limits.latency_compensation; },
      "false: measurements count as of the present, and plans start from them; for negative controls only");
  table.boolean(
      "as_paper", [](P& p) -> bool& { return p.limits.as_paper; },
      "true: the paper's method alone, without any of the protections above but avoidance; for comparison only");
}

void addLanding(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, true);
  table.number(
      "land_speed", "m/s", Range::aboveUpTo(0.0, 5.0), [](P& p) -> double& { return p.landing.speed; },
      "speed of the descent; at most half of max_speed is used");
  table.number(
      "ground_height", "m", Range::finite(), [](P& p) -> double& { return p.landing.ground_height; },
      "z of a landed UAV's centre in the planning frame; a UAV that is lower already lands where it is");
}

void addTime(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, true);
  table.number(
      "sampling_time", "s", Range::closed(0.05, 1.0), [](P& p) -> double& { return p.time.sampling_time; },
      "Delta t, length of a stage of the horizon");
  table.withRule();
  table.number(
      "cycle_period", "s", Range::closed(0.01, 1.0), [](P& p) -> double& { return p.time.cycle_period; },
      "time from one plan to the next");
  table.withRule();
}

void addCost(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, true);
  table.number(
      "alpha", "", Range::atLeast(0.0), [](P& p) -> double& { return p.cost.alpha; },
      "weight in (16) of the horizontal deviation from the reference");
  table.number(
      "beta", "", Range::atLeast(0.0), [](P& p) -> double& { return p.cost.beta; },
      "weight in (16) of the vertical deviation from the reference");
  table.number(
      "eta", "", Range::above(0.0), [](P& p) -> double& { return p.cost.eta; },
      "weight in (16) of the distance to the moving target's state");
  table.number(
      "zeta", "", Range::above(0.0), [](P& p) -> double& { return p.cost.zeta; },
      "weight in (16) of the rate of change of the control");
  table.withRule();
  table.number(
      "velocity_time", "s", Range::atLeast(0.0), [](P& p) -> double& { return p.cost.velocity_time; },
      "in eta's term a velocity error counts as the way it makes in this time");
  table.withRule();
  table.number(
      "stop_weight", "", Range::atLeast(0.0), [](P& p) -> double& { return p.cost.stop_weight; },
      "weight of velocity and acceleration at a plan's end, which is to be nearly at rest");
  table.number(
      "robustness_gain", "", Range::atLeast(0.0), [](P& p) -> double& { return p.cost.robustness_gain; },
      "q of (9), weight of the robustness function; 0 switches it off");
  table.number(
      "robustness_inner", "", Range::above(1.0), [](P& p) -> double& { return p.cost.robustness_inner; },
      "r_a of (11): up to this value of S the robustness function counts in full");
  table.number(
      "robustness_outer", "", Range::above(1.0), [](P& p) -> double& { return p.cost.robustness_outer; },
      "r_b of (11): from this value of S on it does not count; above robustness_inner");
  table.number(
      "epsilon_s", "", Range::aboveUpTo(0.0, 1.0), [](P& p) -> double& { return p.cost.epsilon_s; },
      "eps_s of (7) and (8): plans keep ln S at least this large");
}

void addSqp(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, true);
  table.wholeNumber(
      "max_iterations", Range::closed(1.0, kMostSqpIterations), [](P& p) -> int& { return p.sqp.max_iterations; },
      "most quadratic programs per UAV and cycle");
  table.number(
      "step_tolerance", "m", Range::above(0.0), [](P& p) -> double& { return p.sqp.step_tolerance; },
      "iterations end once no knot of the plan moves by more");
  table.number(
      "slack_linear", "1/m", Range::above(0.0), [](P& p) -> double& { return p.sqp.slack_linear; },
      "penalty of a violated constraint, linear part");
  table.number(
      "slack_quadratic", "1/m^2", Range::above(0.0), [](P& p) -> double& { return p.sqp.slack_quadratic; },
      "penalty of a violated constraint, quadratic part");
}

void addCompute(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, false);
  table.wholeNumber(
      "threads", Range::closed(1.0, 256.0), [](P& p) -> int& { return p.compute.threads; },
      "UAVs planned at the same time; the plans do not depend on it");
}

void addInput(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, false);
  table.number(
      "odometry_timeout", "s", Range::above(0.0), [](P& p) -> double& { return p.input.odometry_timeout; },
      "older odometry is not used");
  table.number(
      "track_timeout", "s", Range::above(0.0), [](P& p) -> double& { return p.input.track_timeout; },
      "an obstacle track is predicted for at most so long");
  table.wholeNumber(
      "max_tracks", Range::closed(1.0, 10000.0), [](P& p) -> int& { return p.input.max_tracks; },
      "obstacle tracks in use; of more than that the nearest to the UAVs are kept");
  table.number(
      "track_sigmas", "", Range::closed(0.0, 10.0), [](P& p) -> double& { return p.input.track_sigmas; },
      "how many standard deviations of an obstacle track are kept clear of");
  table.number(
      "track_growth_time", "s", Range::closed(0.0, 60.0), [](P& p) -> double& { return p.input.track_growth_time; },
      "a track's velocity is in doubt for at most so long after its stamp");
  table.number(
      "tracking_time", "s", Range::above(0.0), [](P& p) -> double& { return p.input.tracking_time; },
      "time constant with which a vehicle's deviation from its plan decays");
  table.number(
      "odometry_noise", "m", Range::atLeast(0.0), [](P& p) -> double& { return p.input.odometry_noise; },
      "deviations from the plan up to this may be noise alone: a fifth of them is carried into the next plan's start");
  table.number(
      "odometry_doubt_time", "s", Range::aboveUpTo(0.0, 60.0),
      [](P& p) -> double& { return p.input.odometry_doubt_time; },
      "a position that stays the same, and a UAV off its plan, are suffered for so long");
  table.number(
      "relocalisation_time", "s", Range::aboveUpTo(0.0, 3600.0),
      [](P& p) -> double& { return p.input.relocalisation_time; },
      "odometry that has jumped or drifted, and fits itself ever since, is believed after this time");
  table.number(
      "off_plan_distance", "m", Range::above(0.0), [](P& p) -> double& { return p.input.off_plan_distance; },
      "a UAV farther than this from its plan for odometry_doubt_time is planned for anew from where it is");
  table.number(
      "lost_growth_rate", "m/s", Range::closed(0.0, 100.0), [](P& p) -> double& { return p.input.lost_growth_rate; },
      "others keep farther from a UAV by this for every second since it was seen last");
  table.number(
      "lost_growth_limit", "m", Range::closed(0.0, 1000.0), [](P& p) -> double& { return p.input.lost_growth_limit; },
      "the most by which others keep farther from a UAV that is not seen");
  table.withRule();
  table.wholeNumber(
      "lost_setpoints", Range::closed(0.0, 1.0), [](P& p) -> int& { return p.input.lost_setpoints; },
      "so many trajectories in a row may fail to reach a vehicle: with 1 others keep clear of the one before, too");
  table.wholeNumber(
      "setpoint_repeats", Range::closed(0.0, 10.0), [](P& p) -> int& { return p.input.setpoint_repeats; },
      "each trajectory is sent so many times more, spread over its cycle, for links that lose messages");
  table.withRule();
  table.boolean(
      "autostart", [](P& p) -> bool& { return p.input.autostart; },
      "start as soon as the odometry of every UAV has arrived");
}

void addVehicle(TableBuilder& table) {
  using P = Parameters;
  table.section(kPlannerFile, true);
  table.number(
      "mass", "kg", Range::above(0.0), [](P& p) -> double& { return p.vehicle.mass; }, "M of Table 1");
  table.number(
      "gravity", "m/s^2", Range::above(0.0), [](P& p) -> double& { return p.vehicle.gravity; }, "g of Table 1");
  table.number(
      "arm_length", "m", Range::above(0.0), [](P& p) -> double& { return p.vehicle.arm_length; },
      "L of Table 1, half the distance of two opposite rotors");
  table.number(
      "drag_x", "N s/m", Range::atLeast(0.0), [](P& p) -> double& { return p.vehicle.drag_x; }, "K_dx of Table 1");
  table.number(
      "drag_y", "N s/m", Range::atLeast(0.0), [](P& p) -> double& { return p.vehicle.drag_y; }, "K_dy of Table 1");
  table.number(
      "drag_z", "N s/m", Range::atLeast(0.0), [](P& p) -> double& { return p.vehicle.drag_z; }, "K_dz of Table 1");
  table.number(
      "force_constant", "N s^2/rad^2", Range::above(0.0), [](P& p) -> double& { return p.vehicle.force_constant; },
      "k: thrust of a rotor over its speed squared (Table 1 calls it b)");
  table.number(
      "rotor_drag_constant", "N m s^2/rad^2", Range::above(0.0),
      [](P& p) -> double& { return p.vehicle.rotor_drag_constant; },
      "b: drag torque of a rotor over its speed squared (Table 1 calls it k)");
  table.number(
      "inertia_x", "kg m^2", Range::above(0.0), [](P& p) -> double& { return p.vehicle.inertia_x; }, "I_x of Table 1");
  table.number(
      "inertia_y", "kg m^2", Range::above(0.0), [](P& p) -> double& { return p.vehicle.inertia_y; }, "I_y of Table 1");
  table.number(
      "inertia_z", "kg m^2", Range::above(0.0), [](P& p) -> double& { return p.vehicle.inertia_z; }, "I_z of Table 1");
  table.number(
      "max_rotor_speed", "rad/s", Range::above(0.0), [](P& p) -> double& { return p.vehicle.max_rotor_speed; },
      "saturation of each rotor");
}

void addSimulation(TableBuilder& table) {
  using P = Parameters;
  table.section(kSimulationFile, false);
  table.number(
      "step", "s", Range::open(0.0, 0.02), [](P& p) -> double& { return p.simulation.step; },
      "integration step of the dynamics");
  table.number(
      "odometry_rate", "Hz", Range::aboveUpTo(0.0, 1000.0), [](P& p) -> double& { return p.simulation.odometry_rate; },
      "odometry messages per second and UAV");
  table.number(
      "track_rate", "Hz", Range::aboveUpTo(0.0, 1000.0), [](P& p) -> double& { return p.simulation.track_rate; },
      "obstacle track messages per second");
  table.number(
      "position_gain", "1/s^2", Range::above(0.0), [](P& p) -> double& { return p.simulation.position_gain; },
      "acceleration per position error");
  table.number(
      "velocity_gain", "1/s", Range::above(0.0), [](P& p) -> double& { return p.simulation.velocity_gain; },
      "acceleration per velocity error");
  table.number(
      "attitude_gain", "1/s^2", Range::above(0.0), [](P& p) -> double& { return p.simulation.attitude_gain; },
      "angular acceleration per angle error");
  table.number(
      "attitude_rate_gain", "1/s", Range::above(0.0), [](P& p) -> double& { return p.simulation.attitude_rate_gain; },
      "angular acceleration per angular rate error");
  table.number(
      "max_tilt", "rad", Range::aboveUpTo(0.0, 1.5), [](P& p) -> double& { return p.simulation.max_tilt; },
      "commanded roll and pitch saturate here");
  table.number(
      "position_noise", "m", Range::atLeast(0.0), [](P& p) -> double& { return p.simulation.position_noise; },
      "standard deviation of each coordinate of the measured position");
  table.number(
      "velocity_noise", "m/s", Range::atLeast(0.0), [](P& p) -> double& { return p.simulation.velocity_noise; },
      "standard deviation of each coordinate of the measured velocity");
  table.number(
      "position_bias", "m", Range::atLeast(0.0), [](P& p) -> double& { return p.simulation.position_bias; },
      "length of the constant error of each UAV's measured position, its direction random");
  table.number(
      "wind", "m/s", Range::closed(0.0, 30.0), [](P& p) -> double& { return p.simulation.wind; },
      "standard deviation of each coordinate of the gusts' velocity");
  table.number(
      "gust_time", "s", Range::aboveUpTo(0.0, 1000.0), [](P& p) -> double& { return p.simulation.gust_time; },
      "correlation time of the gusts");
  table.number(
      "latency", "s", Range::closed(0.0, 10.0), [](P& p) -> double& { return p.simulation.latency; },
      "delay of each message of odometry, obstacle tracks and setpoints");
  table.number(
      "jitter", "s", Range::closed(0.0, 10.0), [](P& p) -> double& { return p.simulation.jitter; },
      "further delay of each message, uniform between 0 and this");
  table.number(
      "drop", "", Range::closed(0.0, 1.0), [](P& p) -> double& { return p.simulation.drop; },
      "probability that a message is lost");
  table.wholeNumber(
      "seed", Range::atLeast(0.0), [](P& p) -> int& { return p.simulation.seed; },
      "seed of noise, bias, gusts, jitter and losses");
}

}  // namespace

const std::vector<ParameterEntry>& parameterEntries() {
  static const std::vector<ParameterEntry> kEntries = [] {
    TableBuilder table;
    addLimits(table);
    addLanding(table);
    addTime(table);
    addCost(table);
    addSqp(table);
    addCompute(table);
    addInput(table);
    addVehicle(table);
    addSimulation(table);
    return table.take();
  }();
  return kEntries;
}

}  // namespace swarm_planner
