// Copyright (c) 2026, the swarm_planner authors. BSD-3-Clause, see LICENSE.
#include "swarm_planner/experiments/experiment_program.hpp"

#include <cstdio>
#include <memory>

#include "swarm_planner/experiments/atomic_file.hpp"
#include "swarm_planner/experiments/comparison.hpp"
#include "swarm_planner/experiments/csv_recorder.hpp"
#include "swarm_planner/experiments/experiment_flight.hpp"
#include "swarm_planner/experiments/experiment_runs.hpp"
#include "swarm_planner/experiments/json_report.hpp"
#include "swarm_planner/experiments/progress_bar.hpp"
#include "swarm_planner/experiments/text_report.hpp"

namespace swarm_planner {
namespace {

std::vector<RunResult> flyAll(const std::vector<ExperimentRun>& runs, CsvRecorder* recorder) {
  std::vector<RunResult> results;
  ProgressBar progress(stderr, runs.size());
  std::vector<RunObserver*> observers = {&progress};
  if (recorder != nullptr) observers.push_back(recorder);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const ExperimentRun& run = runs[i];
    progress.beginRun(i, run.mission.scenario);
    if (recorder != nullptr) recorder->beginRun(i, run.mission.scenario);
    results.push_back(flyExperimentRun(run, observers));
  }
  return results;
}

void conduct(const ExperimentOptions& options, std::ostream& out) {
  const std::vector<ExperimentRun> runs = makeExperimentRuns(options);
  // What cannot be written is told before the runs, not after them.
  std::unique_ptr<AtomicFile> json;
  if (options.json_file) json = std::make_unique<AtomicFile>(*options.json_file);
  std::unique_ptr<CsvRecorder> recorder;
  if (options.csv_directory) recorder = std::make_unique<CsvRecorder>(*options.csv_directory);

  const std::vector<RunResult> results = flyAll(runs, recorder.get());
  out << toTable(runs, results);
  if (options.command == ExperimentCommand::kCompare) out << "\n" << comparisonTable(runs, results);
  if (recorder) recorder->finish();
  if (json) json->write(toJson(runs, results));
}

}  // namespace

int runExperimentProgram(const std::vector<std::string>& arguments, std::ostream& out, std::ostream& err) {
  try {
    const ExperimentOptions options = parseExperimentOptions(arguments);
    if (options.command == ExperimentCommand::kHelp) {
      out << experimentUsage();
      return kExperimentDone;
    }
    conduct(options, out);
    return kExperimentDone;
  } catch (const OptionError& error) {
    err << "swarm_experiment: " << error.what() << "\nTry: swarm_experiment --help\n";
    return kExperimentMisused;
  } catch (const std::exception& error) {
    err << error.what() << "\n";
    return kExperimentFailed;
  }
}

}  // namespace swarm_planner
