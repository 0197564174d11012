// SPDX-License-Identifier: BSD-3-Clause
// The command `simsand element`: path files in, tables and pictures out.
#pragma once
#include "drivers/files/toml_text.hpp"

namespace drivers {

struct ElementOptions {
  std::string path_file;
  std::string output;         ///< CSV file; empty or "-": standard output
  std::string resolved;       ///< file for the path with every key written out; empty: none
  std::string envelope;       ///< CSV file of envelope stages; empty: `output` with _envelope at its end
  Words settings{};           ///< KEY=VALUE, which replace keys of the path file
  std::string failed_point{}; ///< file for a call that failed; empty: failed_point.toml beside `output`
};

/// Runs one path: 0, or 1 after one line on standard error.
int run_element(const ElementOptions& options);

struct ElementBatch {
  Words path_files;
  std::string output; ///< CSV file of a single path; a folder, for a table NAME.csv of each path, of several
  std::string resolved, envelope; ///< of a single path, as in ElementOptions
  std::string figures;            ///< folder for pictures of all tables; empty: none
  Words settings{};
  int threads = 0; ///< paths at a time; 0: one per core, but 1 where a path names a library of its own
};

/// Runs all paths, and draws: 0, or 1 after a line on standard error for each that failed.
int run_elements(const ElementBatch& batch);

} // namespace drivers
