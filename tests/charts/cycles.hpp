// SPDX-License-Identifier: BSD-3-Clause
// `chart cycles`: the energy of closed cycles of strain.
//
// The elasticity of the model is hypoelastic: G depends on p and e, but p not on shear, so that no function of state is
// its energy. With psi = P(p) / (K0 g(e)) + q^2 / 6G, P = integral of p dy (12), the elastic work is
//     sigma : d eps^e = d psi + d delta,   d delta = q^2 / 6G d ln G + P / (K0 g) d ln g,
// and delta, the stated defect, is an integral over the path of stress and void ratio that any path can be checked with:
//     work of a cycle = dissipation + change of psi + delta.
#pragma once
#include "tests/charts/sand.hpp"
#include <cstdint>
#include <string>

namespace charts {

/// Energies per volume of a path of strain, in units of stress.
struct CycleEnergy {
  double work = 0;        ///< sum of (sigma0 + sigma1)/2 : d eps
  double gross = 0;       ///< the same with the sign of each increment dropped
  double dissipation = 0; ///< as the material reports it
  double stored = 0;      ///< change of psi
  double defect = 0;      ///< delta
  double plastic_strain = 0;
  bool failed = false;
  double gain() const { return work - stored; }
  /// What neither dissipation nor the defect explains; of integration, it falls with the step.
  double unexplained() const { return work - dissipation - stored - defect; }
};

double stored_energy(const Material& m, const Point& point);

/// Leads the point through the corners of a closed path in strain, back to where it began, `cycles` times in `parts`
/// increments per side.
CycleEnergy lead_through(const Material& m, Point& point, const std::vector<Tensor>& corners, int parts,
                         int cycles);

/// A random closed path from a random state: 3 to 8 corners, sides of about `amplitude`.
struct RandomCycle {
  int sand;
  Point start;
  std::vector<Tensor> corners;
};
RandomCycle random_cycle(std::uint64_t number, double amplitude);

struct CycleOptions {
  int count = 2000;   ///< random cycles of each amplitude
  int parts = 64;     ///< increments per side
  std::string output; ///< table (.csv); empty: none
};

/// Prints elastic cycles and random ones. Returns whether no cycle gave energy away beyond the defect.
bool chart_cycles(const CycleOptions& options);

} // namespace charts
