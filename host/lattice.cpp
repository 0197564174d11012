// SPDX-License-Identifier: BSD-3-Clause
#include "host/lattice.hpp"
#include "host/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace host {

template <class Geometry> Particles<Geometry> make_column(const Scene& scene) {
  constexpr double most = 1e8; // particles
  if (scene.column.radius / scene.spacing * (scene.column.height / scene.spacing) > most)
    throw std::runtime_error(
        fmt::format("more than {:g} particles: a column of {} m x {} m at a spacing of {} m", most,
                    scene.column.radius, scene.column.height, scene.spacing));
  const int columns = int(std::lround(scene.column.radius / scene.spacing));
  const int rows = int(std::lround(scene.column.height / scene.spacing));
  if (std::min(scene.column.radius, scene.column.height) < (1 - 1e-9) * scene.spacing)
    throw std::runtime_error(
        fmt::format("scene without particles: a column of {} m x {} m holds none at a spacing of {} m",
                    scene.column.radius, scene.column.height, scene.spacing));
  // The lattice fills the column exactly: the spacing is rounded to a whole number of particles.
  const double dx = scene.column.radius / columns, dy = scene.column.height / rows;
  Particles<Geometry> p;
  p.resize(columns * rows, scene.material.state_variables);
  for (int row = 0, i = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column, ++i) {
      const double x = (column + 0.5) * dx, y = (row + 0.5) * dy;
      const double vertical = -scene.bulk_density * scene.gravity * (scene.column.height - y);
      p.id[i] = i;
      p.position[0][i] = p.initial_position[0][i] = x;
      p.position[1][i] = p.initial_position[1][i] = y;
      p.density[i] = scene.bulk_density;
      p.mass[i] = scene.bulk_density * dx * dy * Geometry::depth * Geometry::weight(x);
      p.stress[0][i] = p.stress[2][i] = scene.earth_pressure_ratio * vertical;
      p.stress[1][i] = vertical;
      for (std::size_t v = 0; v < p.state.size(); ++v) p.state[v][i] = scene.initial_state[v];
    }
  return p;
}

template Particles<PlaneStrain> make_column(const Scene&);
template Particles<Axisymmetric> make_column(const Scene&);

} // namespace host
