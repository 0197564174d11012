// SPDX-License-Identifier: BSD-3-Clause
// Elastic bodies that fly freely in the plane, and what tells that one has come apart in numbers only.
#pragma once
#include "host/scheme/geometry.hpp"
#include "tests/stability/stages.hpp"
#include <cmath>
#include <functional>

namespace stability {

/// Elastic, 1 MPa, 0.3, 1000 kg/m3: waves of 37 m/s.
inline constexpr double body_density = 1000; // kg/m3
inline host::Material elastic_material(double poisson = 0.3) {
  return {.library = host::load_vumat(std::string(SIMSAND_BINARY_DIR) + "/libelastic_vumat.so"),
          .name = "ELASTIC",
          .properties = {1e6, poisson}};
}

/// Particles of a square lattice of `spacing` where `inside` holds, moving at `velocity`.
inline host::Simulation<host::PlaneStrain> make_body(double spacing, double extent,
                                                     const std::function<bool(Place)>& inside,
                                                     const std::function<Place(Place)>& velocity,
                                                     const host::Numerics& numerics = {}) {
  std::vector<Place> places;
  const int half = int(std::ceil(extent / spacing));
  for (int k = -half; k < half; ++k)
    for (int l = -half; l < half; ++l)
      if (const Place x{(k + 0.5) * spacing, (l + 0.5) * spacing}; inside(x)) places.push_back(x);
  host::Scene scene;
  scene.geometry = host::GeometryKind::plane_strain;
  scene.symmetric = false; // a body without planes of symmetry
  scene.spacing = spacing;
  scene.material = elastic_material();
  scene.bulk_density = body_density;
  scene.numerics = numerics;
  host::Simulation<host::PlaneStrain> s{
      .scene = scene, .kernel = host::Kernel<2>(numerics.smoothing_length * spacing, numerics.kernel)};
  auto& p = s.particles;
  p.resize(int(places.size()), 0);
  for (int i = 0; i < p.count; ++i) {
    const Place v = velocity(places[i]);
    p.id[i] = i;
    for (int a = 0; a < 2; ++a) {
      p.position[a][i] = places[i][a];
      p.velocity[a][i] = v[a];
    }
    p.density[i] = body_density;
    p.mass[i] = body_density * spacing * spacing;
  }
  s.blocks = host::make_stress_blocks(scene.material, p, spacing);
  return s;
}

/// Longest and shortest distance now of particles that were next neighbours in the lattice, in spacings. A body that
/// is stretched by some per cent keeps both near 1; clumps and cracks do not.
struct Bonds {
  double longest = 0, shortest = 1e9;
};
inline Bonds bonds_of(const host::Simulation<host::PlaneStrain>& s, const Places& lattice) {
  const auto& p = s.particles;
  const double dx = s.scene.spacing;
  Bonds bonds;
  for (int i = 0; i < p.count; ++i)
    for (int j = 0; j < i; ++j) {
      const auto &a = lattice.of(p, i), &b = lattice.of(p, j);
      const double then = std::hypot(a[0] - b[0], a[1] - b[1]);
      if (then > 1.01 * dx) continue;
      const double now =
          std::hypot(p.position[0][i] - p.position[0][j], p.position[1][i] - p.position[1][j]) / dx;
      bonds.longest = std::max(bonds.longest, now);
      bonds.shortest = std::min(bonds.shortest, now);
    }
  return bonds;
}

inline double angular_momentum(const host::Simulation<host::PlaneStrain>& s) {
  const auto& p = s.particles;
  double sum = 0;
  for (int i = 0; i < p.count; ++i)
    sum += p.mass[i] * (p.position[0][i] * p.velocity[1][i] - p.position[1][i] * p.velocity[0][i]);
  return sum;
}

} // namespace stability
