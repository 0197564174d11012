// SPDX-License-Identifier: BSD-3-Clause
#include "host/bodies/lattice.hpp"
#include "host/bodies/disc.hpp"
#include "host/bodies/placement.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace host {

namespace {

constexpr double most_particles = 1e8;

/// Places of the particles of one layer, m, and the area or ring's cross-section that each stands for.
template <int D> struct Layer {
  struct Place {
    std::array<double, D - 1> horizontal;
    double area;
  };
  std::vector<Place> places;
};

Layer<2> make_row(const Scene& scene) {
  const int columns = int(std::lround(scene.column.radius / scene.spacing));
  const double dx = scene.column.radius / columns;
  Layer<2> layer;
  for (int column = scene.column.symmetric ? 0 : -columns; column < columns; ++column) {
    const double x = (column + 0.5) * dx;
    layer.places.push_back({{x}, dx});
  }
  return layer;
}

/// A quarter of the disc, and its reflections where they are simulated.
Layer<3> make_disc(const Scene& scene) {
  const int rings = int(std::lround(scene.column.radius / scene.spacing));
  const auto quarter = quarter_disc(rings, scene.numerics.smoothing_length);
  const double dx = scene.column.radius / rings, square = scene.column.radius * scene.column.radius;
  const double area = std::numbers::pi * square / (4.0 * double(quarter.size()));
  const int planes = symmetry_planes(scene.sector);
  Layer<3> layer;
  for (const double sx : {1, -1})
    for (const double sy : {1, -1}) {
      if ((sx < 0 && planes > 0) || (sy < 0 && planes > 1)) continue;
      for (const auto& [x, y] : quarter) layer.places.push_back({{sx * dx * x, sy * dx * y}, area});
    }
  return layer;
}

/// A rectangle of squares, as far as it is simulated.
Layer<3> make_rectangle(const Scene& scene) {
  const double width[2] = {scene.column.radius, scene.column.depth};
  const int planes = symmetry_planes(scene.sector);
  int half[2];
  double step[2];
  for (int a = 0; a < 2; ++a) {
    half[a] = std::max(int(std::lround(width[a] / scene.spacing)), 1);
    step[a] = width[a] / half[a];
  }
  Layer<3> layer;
  for (int y = planes > 1 ? 0 : -half[1]; y < half[1]; ++y)
    for (int x = planes > 0 ? 0 : -half[0]; x < half[0]; ++x)
      layer.places.push_back({{(x + 0.5) * step[0], (y + 0.5) * step[1]}, step[0] * step[1]});
  return layer;
}

template <class Geometry> void check_size(const Scene& scene) {
  const double across = scene.column.radius / scene.spacing, up = scene.column.height / scene.spacing;
  constexpr bool solid = Geometry::dimension == 3;
  const auto error = [&](const std::string& what, const std::string& verb) {
    return std::runtime_error(fmt::format("{}: a column of {} m x {} m{} at a spacing of {} m", what,
                                          scene.column.radius, scene.column.height, verb, scene.spacing));
  };
  if ((solid ? across * across * up : across * up) > most_particles)
    throw error(fmt::format("more than {:g} particles", most_particles), "");
  if (std::min(across, up) < 1 - 1e-9) throw error("scene without particles", " holds none");
  if (solid && scene.column.depth == 0 &&
      across < 2 * scene.numerics.smoothing_length + scene.numerics.skin + 1)
    throw error("too few particles across the radius for three dimensions", "");
}

} // namespace

template <class Geometry> Particles<Geometry> make_column(const Scene& scene) {
  constexpr int D = Geometry::dimension, up = D - 1;
  check_size<Geometry>(scene);
  Layer<D> layer;
  if constexpr (D == 2)
    layer = make_row(scene);
  else
    layer = scene.column.depth > 0 ? make_rectangle(scene) : make_disc(scene);
  // The lattice fills the column exactly: the spacing is rounded to a whole number of particles.
  const int rows = int(std::lround(scene.column.height / scene.spacing));
  const double dy = scene.column.height / rows;
  Particles<Geometry> p;
  p.resize(int(layer.places.size()) * rows, scene.material.state_variables);
  int i = 0;
  for (int row = 0; row < rows; ++row)
    for (const auto& [horizontal, area] : layer.places) {
      const double y = (row + 0.5) * dy;
      const double vertical = -scene.bulk_density * scene.gravity * (scene.column.height - y);
      p.id[i] = i;
      for (int a = 0; a < up; ++a) p.position[a][i] = horizontal[a];
      p.position[up][i] = y;
      p.density[i] = scene.bulk_density;
      p.mass[i] = scene.bulk_density * area * dy * Geometry::depth * Geometry::weight(horizontal[0]);
      for (int c = 0; c < 3; ++c) p.stress[c][i] = (c == up ? 1 : scene.earth_pressure_ratio) * vertical;
      for (std::size_t v = 0; v < p.state.size(); ++v) p.state[v][i] = scene.initial_state[v];
      ++i;
    }
  if (scene.column.placed()) place_column(scene, p);
  return p;
}

template Particles<PlaneStrain> make_column(const Scene&);
template Particles<Axisymmetric> make_column(const Scene&);
template Particles<ThreeDimensional> make_column(const Scene&);

} // namespace host
