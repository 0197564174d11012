// SPDX-License-Identifier: BSD-3-Clause
#include "host/bodies/column.hpp"
#include "host/bodies/disc.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace host {
namespace {

constexpr double most_particles = 1e8;

/// Horizontal places of the particles of one layer, m, and the area that each stands for.
template <int D> struct LayerCell {
  std::array<double, D - 1> center;
  double area;
};
template <int D> using Layer = std::vector<LayerCell<D>>;

Layer<2> make_row(const Column& column, const Resolution& resolution) {
  const int across = int(std::lround(column.radius / resolution.spacing));
  const double dx = column.radius / across;
  Layer<2> layer;
  for (int k = resolution.planes_of_symmetry > 0 ? 0 : -across; k < across; ++k)
    layer.push_back({{(k + 0.5) * dx}, dx});
  return layer;
}

/// A quarter of the disc, and its reflections where they are simulated.
Layer<3> make_disc(const Column& column, const Resolution& resolution) {
  const int rings = int(std::lround(column.radius / resolution.spacing));
  const auto quarter = quarter_disc(rings, resolution.smoothing_length);
  const double dx = column.radius / rings, square = column.radius * column.radius;
  const double area = std::numbers::pi * square / (4.0 * double(quarter.size()));
  const int planes = resolution.planes_of_symmetry;
  Layer<3> layer;
  for (const double sx : {1, -1})
    for (const double sy : {1, -1}) {
      if ((sx < 0 && planes > 0) || (sy < 0 && planes > 1)) continue;
      for (const auto& [x, y] : quarter) layer.push_back({{sx * dx * x, sy * dx * y}, area});
    }
  return layer;
}

/// A rectangle of squares, as far as it is simulated.
Layer<3> make_rectangle(const Column& column, const Resolution& resolution) {
  const double width[2] = {column.radius, column.depth};
  const int planes = resolution.planes_of_symmetry;
  int half[2];
  double step[2];
  for (int a = 0; a < 2; ++a) {
    half[a] = std::max(int(std::lround(width[a] / resolution.spacing)), 1);
    step[a] = width[a] / half[a];
  }
  Layer<3> layer;
  for (int y = planes > 1 ? 0 : -half[1]; y < half[1]; ++y)
    for (int x = planes > 0 ? 0 : -half[0]; x < half[0]; ++x)
      layer.push_back({{(x + 0.5) * step[0], (y + 0.5) * step[1]}, step[0] * step[1]});
  return layer;
}

template <int D> void check_size(const Column& column, const Resolution& resolution) {
  const double across = column.radius / resolution.spacing, up = column.height / resolution.spacing;
  constexpr bool solid = D == 3;
  const auto error = [&](const std::string& what, const std::string& verb) {
    return std::runtime_error(fmt::format("{}: a column of {} m x {} m{} at a spacing of {} m", what,
                                          column.radius, column.height, verb, resolution.spacing));
  };
  if ((solid ? across * across * up : across * up) > most_particles)
    throw error(fmt::format("more than {:g} particles", most_particles), "");
  if (std::min(across, up) < 1 - 1e-9) throw error("scene without particles", " holds none");
  if (solid && column.depth == 0 && across < 2 * resolution.smoothing_length + resolution.skin + 1)
    throw error("too few particles across the radius for three dimensions", "");
}

} // namespace

template <int D> std::vector<Cell<D>> fill_column(const Column& column, const Resolution& resolution) {
  check_size<D>(column, resolution);
  Layer<D> layer;
  if constexpr (D == 2)
    layer = make_row(column, resolution);
  else
    layer = column.depth > 0 ? make_rectangle(column, resolution) : make_disc(column, resolution);
  const int rows = int(std::lround(column.height / resolution.spacing));
  const double dy = column.height / rows;
  std::vector<Cell<D>> cells;
  cells.reserve(layer.size() * rows);
  for (int row = 0; row < rows; ++row)
    for (const auto& [horizontal, area] : layer) {
      Cell<D> cell{{}, area, dy};
      std::ranges::copy(horizontal, cell.center.begin());
      cell.center[D - 1] = (row + 0.5) * dy;
      cells.push_back(cell);
    }
  return cells;
}

template std::vector<Cell<2>> fill_column(const Column&, const Resolution&);
template std::vector<Cell<3>> fill_column(const Column&, const Resolution&);

} // namespace host
