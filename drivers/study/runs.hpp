// SPDX-License-Identifier: BSD-3-Clause
// The runs of a study: scenes with some values set, each in a folder of its own. Complete ones are not run again.
#pragma once
#include <string>
#include <vector>

namespace drivers {

struct StudyOptions {
  std::string folder; ///< of the results
  std::string data;   ///< the project's data folder
  int parallel = 2;   ///< runs at a time, one thread each
  bool quiet = false;
  bool again = false; ///< run complete ones again that another build has made
};

struct StudyRun {
  std::string name;
  std::string scene;                 ///< file
  std::string folder;                ///< of the results
  std::vector<std::string> settings; ///< "table.key=value"
};

/// Runs those that have no complete result of exactly this scene, as many at a time as `parallel` and the memory
/// allow, and warns of results of another build, unless they are to be run again; interrupted ones go on from their
/// checkpoints. Leaves beside each result the processor's seconds
/// (`cpu_seconds`), but not of a run that was interrupted. Throws std::runtime_error naming the runs that failed and
/// their logs, after all others have ended.
void run_missing(std::vector<StudyRun> runs, const StudyOptions& options);

/// Tables, pictures and the page of the runs that are complete, by a script of drivers/figures. Throws
/// std::runtime_error with the command if it fails.
void report_study(const std::string& script, const StudyOptions& options);

/// Both; where runs fail, the report is made of the others first.
void run_and_report(std::vector<StudyRun> runs, const std::string& script, const StudyOptions& options);

} // namespace drivers
