// SPDX-License-Identifier: BSD-3-Clause
// The result of a run: one HDF5 file and an XDMF side file with which ParaView opens it. The schema is
// in host/files/OUTPUT.md. No file is ever changed in place: while the run goes on, each snapshot is a file of
// its own in a folder beside the result, which links to them and is replaced as a whole whenever a snapshot
// or samples are added; close() joins them. Whatever ends the run, the result on disk is readable.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace host {

/// What is known before the first step.
struct ResultHeader {
  std::string scene;    ///< the resolved scene, TOML: a run of this text gives the same numbers
  std::string version;  ///< of the program
  std::string compiler; ///< compiler and its flags
  std::string build;    ///< of the program's file and of the material library, hashes
  std::string geometry; ///< "axisymmetric", "plane_strain" or "three_dimensional"
  int dimension = 2;
  std::size_t particles = 0; ///< length of every particle dataset
};

/// A column of the time series or a quantity of the summary.
struct Quantity {
  std::string name, unit;
};

/// A particle quantity: one view per component, all of the same length.
struct Field {
  std::string name, unit;
  std::vector<std::span<const double>> components;
};

/// How far a result file has come: what a run needs in order to continue it.
struct ResultProgress {
  std::vector<Quantity> columns;
  std::vector<std::vector<double>> series; ///< one per column
  int snapshots = 0;                       ///< the next one's number
  std::vector<int> lost;                   ///< numbers of those that could not be read when the run went on
  std::string xdmf;                        ///< of the others
};

/// Throws std::runtime_error with one line that names the file, whatever goes wrong.
class ResultFile {
public:
  /// Creates missing folders and the file (an older one is replaced), writes the header.
  ResultFile(const std::filesystem::path& path, const ResultHeader& header,
             const std::vector<Quantity>& series);
  /// Continues a file from `progress`: what was written after that is dropped. Snapshots up to there that are
  /// missing in the folder beside it, or cannot be read, are left out; see `left_out`. The constant particle
  /// data must be written again.
  ResultFile(const std::filesystem::path& path, const ResultHeader& header,
             const std::vector<Quantity>& series, const ResultProgress& progress);
  /// Closes without the mark of completeness.
  ~ResultFile();

  /// Constant particle data: mass, initial_position. Order of rows as for `snapshot`.
  void particles(std::span<const Field> fields, std::span<const std::int32_t> original = {});
  /// Radii of the outline, m: the abscissa of every snapshot's outline.
  void outline_radii(std::span<const double> radii);
  /// State of all particles; `position` must be among the fields. Row i belongs to the particle that
  /// was created as number original[i]; rows with a negative number are padding. Without `original` row i is
  /// particle i. `outline` is the surface height at the outline's radii, m, or empty.
  void snapshot(double time, std::span<const Field> fields, std::span<const std::int32_t> original = {},
                std::span<const double> outline = {});
  /// One row of the time series, a value for each column. On disk with the next snapshot or `flush`, or
  /// before, as long as writing takes no more than a twentieth of the time.
  void sample(std::span<const double> row);
  /// A scalar result; a second value under the same name replaces the first.
  void summary(const Quantity& quantity, double value);
  /// Brings all samples to disk.
  void flush();
  ResultProgress progress() const;
  /// The files of snapshots that were lost when this run went on.
  const std::vector<std::filesystem::path>& left_out() const;
  /// Joins the snapshots to one file, marks the run as complete and closes both files.
  void close();

  const std::filesystem::path& path() const;
  std::filesystem::path xdmf_path() const; ///< beside the HDF5 file, extension .xdmf

private:
  struct Impl;
  std::unique_ptr<Impl> impl;
};

/// The folder of the snapshots of a run that is not complete: NAME.parts beside NAME.h5.
std::filesystem::path parts_folder(const std::filesystem::path& result);

} // namespace host
