// SPDX-License-Identifier: BSD-3-Clause
// The tests of a fit, simulated at one set of parameters: all of them advance side by side in blocks of the VUMAT, each
// in its own increments of axial strain (specimen_run.hpp).
#pragma once
#include "calibration/specimen_run.hpp"
#include "drivers/files/material_file.hpp"
#include <memory>

namespace calibration {

/// Simulates the same specimens again and again. One per thread.
class Simulator {
public:
  /// SIMSAND alone.
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

} // namespace calibration
