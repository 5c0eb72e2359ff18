// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// An operator who mistypes a parameter must be told which, what was found and what is allowed, in the file or on the
// parameter server; a value that is silently ignored or out of range flies with limits that nobody chose.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <limits>

#include "config/fault_table.hpp"
#include "swarm_planner/config/parameter_io.hpp"

namespace swarm_planner {
namespace {

/// A file that holds `text` as long as this object lives.
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string& text) : path_(testing::TempDir() + "swarm_planner_parameters.yaml") {
    std::ofstream(path_) << text;
  }
  ~TemporaryFile() { std::remove(path_.c_str()); }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

constexpr const char* kGood = R"(max_speed: 5
max_acceleration: .inf
sampling_time: auto
max_iterations: 5
autostart: true
robustness_inner: 1.2
robustness_outer: 2.5
)";

TEST(ParameterFile, RightFileIsReadAsItStands) {
  const TemporaryFile file(kGood);
  Faults faults;
  const ParameterMap parameters = parseParameterFile(file.path(), false, faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  const ParameterMap expected = {{"max_speed", 5},
                                 {"max_acceleration", std::numeric_limits<double>::infinity()},
                                 {"sampling_time", std::string("auto")},
                                 {"max_iterations", 5},
                                 {"autostart", true},
                                 {"robustness_inner", 1.2},
                                 {"robustness_outer", 2.5}};
  EXPECT_EQ(parameters, expected);
}

class ParameterFileFault : public testing::TestWithParam<FaultCase> {};

TEST_P(ParameterFileFault, IsTheOnlyOneReportedAndTheValueIsLeftOut) {
  const TemporaryFile file(changed(kGood, GetParam().original, GetParam().replacement));
  Faults faults;
  const ParameterMap parameters = parseParameterFile(file.path(), false, faults);
  expectOnlyFault(faults, file.path(), GetParam());
  // Of a repeated key the first value counts.
  const bool is_repetition = GetParam().message.find("repeated") != std::string::npos;
  EXPECT_EQ(parameters.count(GetParam().key), is_repetition ? 1u : 0u);
}

const FaultCase kFile[] = {
    {"EmptyFile", kGood, "", "", "found nothing, expected a YAML map"},
    {"List", kGood, "[1, 2]", "", "found a list of 2, expected a map (line 1)"},
    {"SyntaxError", "auto", "[auto", "", "no legal YAML"},
    {"UnknownKey", "max_speed", "max_sped", "max_sped", "unknown key, did you mean \"max_speed\"? (line 1)"},
    {"UnknownKeyUnlikeAny", "max_speed", "weather", "weather",
     "unknown key, expected one of: max_speed, max_acceleration, max_jerk, max_thrust_ratio"},
    {"RepeatedKey", "max_iterations", "max_speed: 3\nmax_iterations", "max_speed",
     "repeated key, first given in line 1 (line 4)"},
    {"Text", "max_speed: 5", "max_speed: fast", "max_speed", "found \"fast\", expected a number in (0, 100] [m/s]"},
    {"NumberInQuotes", "max_speed: 5", "max_speed: \"5\"", "max_speed", "found \"5\", expected a number in (0, 100]"},
    {"Nothing", "max_speed: 5", "max_speed:", "max_speed", "found nothing, expected a number in (0, 100]"},
    {"Vector", "max_speed: 5", "max_speed: [5]", "max_speed", "found a list of 1, expected a number in (0, 100]"},
    {"Section", "max_speed: 5", "max_speed: {x: 5}", "max_speed", "found a map, expected a number in (0, 100]"},
    {"Boolean", "max_speed: 5", "max_speed: true", "max_speed", "found true, expected a number in (0, 100]"},
    {"NaN", "max_speed: 5", "max_speed: .nan", "max_speed", "found .nan, expected a number in (0, 100]"},
    {"Infinite", "max_speed: 5", "max_speed: .inf", "max_speed", "found .inf, expected a number in (0, 100]"},
    {"TooLargeForADouble", ".inf", "1e400", "max_acceleration", "found 1e400, expected a number > 0 or .inf [m/s^2]"},
    {"NegativeInfinity", ".inf", "-.inf", "max_acceleration", "found -.inf, expected a number > 0 or .inf"},
    {"Zero", "max_speed: 5", "max_speed: 0", "max_speed", "found 0, expected a number in (0, 100] [m/s] (line 1)"},
    {"Negative", "max_speed: 5", "max_speed: -5", "max_speed", "found -5, expected a number in (0, 100]"},
    {"AboveRange", "max_speed: 5", "max_speed: 500", "max_speed", "found 500, expected a number in (0, 100]"},
    {"AutoWithoutRule", "max_speed: 5", "max_speed: auto", "max_speed",
     "found \"auto\", expected a number in (0, 100]"},
    {"NeitherNumberNorAuto", "auto", "automatic", "sampling_time",
     "found \"automatic\", expected a number in [0.05, 1] [s] or auto (line 3)"},
    {"FractionalCount", "max_iterations: 5", "max_iterations: 5.5", "max_iterations",
     "found 5.5, expected a whole number in [1, 50] (line 4)"},
    {"NoIterations", "max_iterations: 5", "max_iterations: 0", "max_iterations",
     "found 0, expected a whole number in [1, 50]"},
    {"NumberForBoolean", "autostart: true", "autostart: 1", "autostart", "found 1, expected true or false (line 5)"},
    {"YesForBoolean", "autostart: true", "autostart: yes", "autostart", "found \"yes\", expected true or false"},
    {"InnerNotOutside", "robustness_inner: 1.2", "robustness_inner: 1.0", "robustness_inner",
     "found 1.0, expected a number > 1"},
};
INSTANTIATE_TEST_SUITE_P(Table, ParameterFileFault, testing::ValuesIn(kFile), caseName);

TEST(ParameterFile, RequiredKeysOfTheSameShippedFileMayNotBeMissing) {
  std::string text;
  std::size_t simulation_parameters = 0;
  for (const ParameterInfo& info : parameterTable()) simulation_parameters += info.file == "simulation.yaml";
  const TemporaryFile file("step: 0.01\nodometry_rate: 20\n");
  Faults faults;
  const ParameterMap parameters = parseParameterFile(file.path(), true, faults);
  EXPECT_EQ(parameters.size(), 2u);
  ASSERT_EQ(faults.list().size(), simulation_parameters - 2u) << faults.text();
  EXPECT_EQ(faults.list()[0].key, "track_rate");
  EXPECT_EQ(faults.list()[0].message, "missing, expected a number in (0, 1000] [Hz] (line 1)");
}

TEST(ParameterFile, UnreadableFileIsNamed) {
  Faults faults;
  EXPECT_TRUE(parseParameterFile("config/no_such_file.yaml", true, faults).empty());
  EXPECT_EQ(faults.text(), "config/no_such_file.yaml: cannot be read, expected a YAML file");
}

/// A wrong value from the parameter server, a program or a scenario, and its fault.
struct ValueCase {
  std::string name;
  ParameterMap given;
  std::map<std::string, double> overrides;
  std::string fault;
};

std::ostream& operator<<(std::ostream& stream, const ValueCase& value_case) { return stream << value_case.name; }

class ParameterValueFault : public testing::TestWithParam<ValueCase> {};

TEST_P(ParameterValueFault, IsTheOnlyOneReported) {
  Faults faults;
  resolveParameters(GetParam().given, GetParam().overrides, "file.yaml", faults);
  EXPECT_EQ(faults.text(), GetParam().fault);
}

constexpr double kInfinity = std::numeric_limits<double>::infinity();

const ValueCase kValues[] = {
    {"UnknownName", {{"max_sped", 5.0}}, {}, "parameters: max_sped: unknown key, did you mean \"max_speed\"?"},
    {"TextForNumber",
     {{"max_speed", std::string("5")}},
     {},
     "parameters: max_speed: found \"5\", expected a number in (0, 100] [m/s]"},
    {"BooleanForNumber", {{"mass", true}}, {}, "parameters: mass: found true, expected a number > 0 [kg]"},
    {"NumberForBoolean", {{"autostart", 1}}, {}, "parameters: autostart: found 1, expected true or false"},
    {"NotANumber", {{"mass", std::nan("")}}, {}, "parameters: mass: found .nan, expected a number > 0 [kg]"},
    {"Infinite", {{"mass", kInfinity}}, {}, "parameters: mass: found .inf, expected a number > 0 [kg]"},
    {"WholeNumberOutOfRange", {{"mass", -1}}, {}, "parameters: mass: found -1, expected a number > 0 [kg]"},
    {"AutoWithoutRule",
     {{"alpha", std::string("auto")}},
     {},
     "parameters: alpha: found \"auto\", expected a number >= 0"},
    {"StepTooLong", {{"step", 0.02}}, {}, "parameters: step: found 0.02, expected a number in (0, 0.02) [s]"},
    {"UprightLimitAboveWeight",
     {{"min_thrust_ratio", 1.0}},
     {},
     "parameters: min_thrust_ratio: found 1, expected a number in (0, 1)"},
    {"ThrustBelowWeight",
     {{"max_thrust_ratio", 1.0}},
     {},
     "parameters: max_thrust_ratio: found 1, expected a number in (1, 10]"},
    {"SeedTooLarge", {{"seed", 3e9}}, {}, "parameters: seed: found 3000000000, expected a whole number >= 0"},
    {"UnknownOverride", {}, {{"alhpa", 1.0}}, "file.yaml: overrides.alhpa: unknown key, did you mean \"alpha\"?"},
    {"OverrideOfInput",
     {},
     {{"track_timeout", 1.0}},
     "file.yaml: overrides.track_timeout: cannot be set by a scenario, expected a planner or vehicle parameter that is "
     "a number"},
    {"OverrideOutOfRange", {}, {{"eta", 0.0}}, "file.yaml: overrides.eta: found 0, expected a number > 0"},
    {"RadiiOfRobustnessSwapped",
     {{"robustness_inner", 3.0}},
     {},
     "parameters: robustness_inner: expected robustness_inner < robustness_outer, found 3 and 2.5"},
    {"RadiiOfRobustnessEqual",
     {{"robustness_inner", 2.0}},
     {{"robustness_outer", 2.0}},
     "file.yaml: overrides.robustness_outer: expected robustness_inner < robustness_outer, found 2 and 2"},
    {"ThrustThatRotorsCannotGive",
     {},
     {{"max_thrust_ratio", 3.0}},
     "file.yaml: overrides.max_thrust_ratio: expected at most what four rotors give, 4 force_constant "
     "max_rotor_speed^2 / (mass gravity) = 2.5963, found 3"},
    {"SwappedLabelsOfTableOne",
     {{"force_constant", 1.14e-7}},
     {},
     "parameters: max_thrust_ratio: expected at most what four rotors give, 4 force_constant max_rotor_speed^2 / (mass "
     "gravity) = 0.0993, found 2"},
    {"CycleOutlastsPlans",
     {{"sampling_time", 0.1}, {"cycle_period", 0.51}},
     {},
     "parameters: cycle_period: expected at most 5 sampling times of 0.1 s, found 0.51 s"},
    {"OdometryBetweenSteps",
     {{"step", 0.01}, {"odometry_rate", 200.0}},
     {},
     "parameters: step: expected at most one period of odometry_rate and of track_rate, found 0.01 s against 0.005 s"},
};
INSTANTIATE_TEST_SUITE_P(Table, ParameterValueFault, testing::ValuesIn(kValues),
                         [](const auto& value_case) { return value_case.param.name; });

TEST(ParameterFaults, EveryFaultIsListedAtOnce) {
  Faults faults;
  resolveParameters({{"mass", -1.0}, {"max_sped", 5.0}, {"robustness_inner", 0.5}}, {{"eta", -1.0}}, "file.yaml",
                    faults);
  EXPECT_EQ(faults.text(),
            "parameters: mass: found -1, expected a number > 0 [kg]\n"
            "parameters: max_sped: unknown key, did you mean \"max_speed\"?\n"
            "parameters: robustness_inner: found 0.5, expected a number > 1\n"
            "file.yaml: overrides.eta: found -1, expected a number > 0");
}

}  // namespace
}  // namespace swarm_planner
