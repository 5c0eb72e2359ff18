// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
//
// The YAML files and documents that ship with the package must say what the code does: an operator copies a value or
// a name from there. Runs in the package's root.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>

#include "swarm_planner/config/paper_scenarios.hpp"
#include "swarm_planner/config/parameter_io.hpp"
#include "swarm_planner/config/tight_scenarios.hpp"

namespace swarm_planner {
namespace {

std::vector<std::string> linesOf(const std::string& path) {
  std::ifstream file(path);
  EXPECT_TRUE(file) << path;
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

/// As the documents write it.
std::string defaultText(const ParameterValue& value) {
  if (const bool* boolean = std::get_if<bool>(&value)) return *boolean ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  if (const int* whole = std::get_if<int>(&value)) return std::to_string(*whole);
  std::ostringstream stream;
  stream << std::get<double>(value);
  return stream.str() == "inf" ? ".inf" : stream.str();
}

class ShippedParameterFile : public testing::TestWithParam<const char*> {};

TEST_P(ShippedParameterFile, ListsExactlyTheTablesParametersWithTheirDefaults) {
  Faults faults;
  const ParameterMap shipped = parseParameterFile(std::string("config/") + GetParam(), true, faults);
  EXPECT_TRUE(faults.empty()) << faults.text();
  ParameterMap expected;
  for (const ParameterInfo& info : parameterTable()) {
    if (info.file == GetParam()) expected[info.name] = info.default_value;
  }
  EXPECT_EQ(shipped.size(), expected.size());
  for (const auto& [name, value] : expected) {
    ASSERT_EQ(shipped.count(name), 1u) << name;
    EXPECT_EQ(shipped.at(name), value) << name << " should be " << defaultText(value);
  }
}

TEST_P(ShippedParameterFile, SaysUnitAndMeaningOfEachParameter) {
  std::map<std::string, std::string> lines;
  for (const std::string& line : linesOf(std::string("config/") + GetParam()))
    lines[line.substr(0, line.find(':'))] = line;
  for (const ParameterInfo& info : parameterTable()) {
    if (info.file != GetParam()) continue;
    const std::string comment = info.unit.empty() ? " # " : " # [" + info.unit + "] ";
    EXPECT_NE(lines[info.name].find(comment), std::string::npos) << info.name << ": " << lines[info.name];
  }
}

INSTANTIATE_TEST_SUITE_P(Files, ShippedParameterFile, testing::Values("planner.yaml", "simulation.yaml"),
                         [](const auto& file) { return std::string(file.param, std::string(file.param).find('.')); });

TEST(ParameterDocument, ListsExactlyTheTable) {
  std::vector<std::string> expected;
  for (const ParameterInfo& info : parameterTable()) {
    expected.push_back("| `" + info.name + "` | " + (info.unit.empty() ? "-" : info.unit) + " | " +
                       defaultText(info.default_value) + " | " + info.range + " | " + info.description + " |");
  }
  std::vector<std::string> rows;
  for (const std::string& line : linesOf("doc/parameters.md")) {
    if (line.rfind("| `", 0) == 0) rows.push_back(line);
  }
  EXPECT_EQ(rows, expected);
}

std::vector<std::filesystem::path> shippedScenarios() {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator("config/scenarios")) {
    if (entry.path().extension() == ".yaml") files.push_back(entry.path());
  }
  return files;
}

TEST(ShippedScenarios, LoadWithTheParametersThatTheySet) {
  ASSERT_GE(shippedScenarios().size(), 6u);
  for (const std::filesystem::path& file : shippedScenarios()) {
    Faults faults;
    const Scenario scenario = parseScenarioFile(file.string(), faults);
    resolveParameters({}, scenario.overrides, file.string(), faults);
    EXPECT_TRUE(faults.empty()) << faults.text();
    EXPECT_EQ(scenario.name, file.stem().string());
  }
}

TEST(ShippedScenarios, AreDocumented) {
  std::string document;
  for (const std::string& line : linesOf("doc/scenarios.md")) document += line + '\n';
  for (const std::filesystem::path& file : shippedScenarios()) {
    EXPECT_NE(document.find("`" + file.stem().string() + "`"), std::string::npos) << file;
  }
}

class GeneratedScenario : public testing::TestWithParam<Scenario> {};

/// On a failure the expected text is shown: it belongs below the comment of the file.
TEST_P(GeneratedScenario, ShippedFileIsWhatTheGeneratorMakes) {
  std::string shipped;
  for (const std::string& line : linesOf("config/scenarios/" + GetParam().name + ".yaml")) {
    if (line.rfind('#', 0) != 0) shipped += line + '\n';
  }
  EXPECT_EQ(shipped, toYaml(GetParam()));
}

INSTANTIATE_TEST_SUITE_P(Files, GeneratedScenario,
                         testing::Values(paperSix(), paperScaling(16), paperScaling(32), paperScaling(64), crossing(),
                                         circleSwap(10, 10.0, 0), forest(10, kForestGap, 0), gap(8, kPerturbation, 0),
                                         boxHeadOn(4, kPerturbation, 0), uTrap(3, kPerturbation, 0),
                                         sameGoal(6, kPerturbation, 0)),
                         [](const auto& scenario) { return scenario.param.name; });

}  // namespace
}  // namespace swarm_planner
