// SPDX-License-Identifier: BSD-3-Clause
#include "host/bodies/initial_particles.hpp"
#include "host/bodies/placement.hpp"
#include "host/scheme/geometry.hpp"

namespace host {
namespace {

/// Particles of the cells of a body that reaches up to the height `top`, m.
template <class Geometry>
Particles<Geometry> geostatic_particles(const std::vector<Cell<Geometry::dimension>>& cells, double top,
                                        const Scene& scene) {
  constexpr int up = Geometry::dimension - 1;
  Particles<Geometry> p;
  p.resize(int(cells.size()), scene.material.state_variables);
  for (int i = 0; i < p.count; ++i) {
    const auto& [center, area, height] = cells[i];
    const double vertical = -scene.bulk_density * scene.gravity * (top - center[up]);
    p.id[i] = i;
    for (int a = 0; a <= up; ++a) p.position[a][i] = center[a];
    p.density[i] = scene.bulk_density;
    p.mass[i] = scene.bulk_density * area * height * Geometry::depth * Geometry::weight(center[0]);
    for (int c = 0; c < 3; ++c) p.stress[c][i] = (c == up ? 1 : scene.earth_pressure_ratio) * vertical;
    for (std::size_t v = 0; v < p.state.size(); ++v) p.state[v][i] = scene.initial_state[v];
  }
  return p;
}

} // namespace

template <class Geometry> Particles<Geometry> initial_particles(const Scene& scene) {
  const Resolution resolution{.spacing = scene.spacing,
                              .smoothing_length = scene.numerics.smoothing_length,
                              .skin = scene.numerics.skin,
                              .planes_of_symmetry = planes_of_symmetry(scene)};
  const auto cells = fill_column<Geometry::dimension>(scene.column, resolution);
  auto particles = geostatic_particles<Geometry>(cells, scene.column.height, scene);
  if (scene.column.placed()) place(scene.column, particles);
  return particles;
}

template decltype(initial_particles<PlaneStrain>) initial_particles<PlaneStrain>;
template decltype(initial_particles<Axisymmetric>) initial_particles<Axisymmetric>;
template decltype(initial_particles<ThreeDimensional>) initial_particles<ThreeDimensional>;

} // namespace host
