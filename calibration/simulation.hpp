// SPDX-License-Identifier: BSD-3-Clause
// The tests of a fit, simulated at one set of parameters: all of them advance side by side in one block of the VUMAT,
// each in its own increments of axial strain. Axisymmetric mixed control has one unknown at most, the lateral
// strain increment.
#pragma once
#include "calibration/lab_test.hpp"
#include "drivers/files/material_file.hpp"
#include <span>

namespace calibration {

/// Size of increments. Where the path bends, an increment is so small that a straight continuation of the one
/// before misses stress (over p) and volumetric strain by about this; errors of the result are far smaller.
struct Accuracy {
  double stress = 5e-4, volumetric_strain = 5e-5;
  double largest_increment = 0.01; ///< of axial strain
  double control = 1e-6;           ///< error of a held stress, over the initial mean stress
};

/// What happened to one specimen: a row for the start and each increment.
struct Path {
  std::vector<double> axial_strain, volumetric_strain, axial_stress, radial_stress;
  bool complete = false; ///< the end strain was reached; else the last row is where the material failed

  double value(Measure measure, std::size_t row, const Specimen& specimen) const;
};

/// Simulates the same specimens again and again. One per thread.
class Simulator {
public:
  Simulator(const drivers::LoadedMaterial& material, std::vector<Specimen> specimens, Accuracy accuracy = {});
  ~Simulator();
  Simulator(Simulator&&) noexcept;

  /// The paths at these PROPS (the void ratio in them is replaced by that of each specimen), valid until the next
  /// call. Never throws for what the material does: a path that fails is incomplete.
  std::span<const Path> run(std::span<const double> properties);

  long calls() const;            ///< of the material, so far
  long material_updates() const; ///< of points, so far
private:
  struct State;
  std::unique_ptr<State> state;
};

/// `measure` of a path at increasing magnitudes of strain, by cubic interpolation between increments. Returns how many
/// of them the path reaches; the values of the others are not written.
std::size_t interpolate(const Path& path, const Specimen& specimen, Measure measure,
                        std::span<const double> strain, std::span<double> values);

} // namespace calibration
