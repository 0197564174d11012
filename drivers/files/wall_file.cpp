// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/files/wall_file.hpp"
#include "host/bodies/initial_particles.hpp"
#include "host/scheme/geometry.hpp"
#include "host/walls/contact.hpp"
#include "host/walls/surfaces.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace drivers {
namespace {

using host::GeometryKind, host::Wall, host::WallShape, host::WallVector;

constexpr Range place{-1e4, 1e4}; ///< m

std::size_t dimension_of(const host::Scene& scene) {
  return scene.geometry == GeometryKind::three_dimensional ? 3 : 2;
}

WallVector vector_of(const std::vector<double>& numbers) {
  WallVector v{};
  std::copy_n(numbers.begin(), std::min<std::size_t>(numbers.size(), 3), v.begin());
  return v;
}

void read_plane(const TomlTable& table, const host::Scene& scene, Wall& wall) {
  const auto n = dimension_of(scene);
  wall.point = vector_of(table.numbers("point", n, place));
  wall.normal = vector_of(table.numbers("normal", n));
  const double length = std::hypot(wall.normal[0], wall.normal[1], wall.normal[2]);
  if (length < 1e-12) table.fail("normal", "a vector that is not zero", fmt::format("{}", wall.normal));
  for (double& component : wall.normal) component /= length;
  if (scene.geometry == GeometryKind::axisymmetric && wall.normal[0] != 0)
    table.fail("normal", "[0, 1] or [0, -1] in axisymmetry, for a cone is no plane",
               fmt::format("{}", wall.normal));
}

void read_cylinder(const TomlTable& table, const host::Scene& scene, Wall& wall) {
  const auto up = dimension_of(scene) - 1;
  wall.inside = table.text("side", {"inside", "outside"}) == "inside";
  wall.radius = table.number("radius", {1e-6, 1e4});
  if (scene.geometry != GeometryKind::axisymmetric)
    wall.center = vector_of(table.numbers("center", up, place, std::vector<double>(up, 0)));
  wall.lower[up] = table.number("lower", {-host::unbounded, host::unbounded}, -host::unbounded);
  wall.upper[up] = table.number("upper", {-host::unbounded, host::unbounded}, host::unbounded);
  if (wall.upper[up] <= wall.lower[up])
    table.fail("upper", fmt::format("a number above {}", wall.lower[up]), fmt::format("{}", wall.upper[up]));
}

void read_box(const TomlTable& table, const host::Scene& scene, Wall& wall) {
  const auto n = dimension_of(scene);
  const Range bound{-host::unbounded, host::unbounded};
  wall.inside = table.text("side", {"inside", "outside"}) == "inside";
  wall.lower = vector_of(table.numbers("lower", n, bound));
  wall.upper = vector_of(table.numbers("upper", n, bound));
  for (std::size_t a = 0; a < n; ++a)
    if (wall.upper[a] <= wall.lower[a])
      table.fail("upper", fmt::format("more than {} for number {}", wall.lower[a], a + 1),
                 fmt::format("{}", wall.upper[a]));
}

/// Constant between two times, or piecewise linear.
host::WallMotion read_motion(const TomlTable& table, const host::Scene& scene) {
  const auto n = dimension_of(scene);
  host::WallMotion motion;
  if (!table.has("times")) {
    if (!table.has("velocity")) return motion;
    const auto velocity = vector_of(table.numbers("velocity", n, {-100, 100}));
    const double start = table.number("start", not_negative, 0);
    const double end = table.number("end", {start + 1e-9}, std::max(scene.end_time, start + 1));
    return {{start, end}, {velocity, velocity}};
  }
  motion.time = table.numbers("times", 0, not_negative);
  if (motion.time.size() < 2 || !std::ranges::is_sorted(motion.time, std::less_equal{}))
    table.fail("times", "at least two numbers, each above the one before", fmt::format("{}", motion.time));
  const bool axis = scene.geometry == GeometryKind::axisymmetric;
  const auto names = n == 3 ? Words{"velocity_x", "velocity_y", "velocity_z"}
                            : Words{axis ? "velocity_r" : "velocity_x", "velocity_z"};
  motion.velocity.resize(motion.time.size());
  for (std::size_t a = 0; a < n; ++a) {
    const auto values =
        table.numbers(names[a], motion.time.size(), {-100, 100}, std::vector<double>(motion.time.size(), 0));
    for (std::size_t k = 0; k < values.size(); ++k) motion.velocity[k][a] = values[k];
  }
  return motion;
}

Wall read_wall(const TomlTable& table, const host::Scene& scene) {
  Wall wall;
  wall.name = table.text("name");
  const auto plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
  if (wall.name.empty() || !std::ranges::all_of(wall.name, plain))
    table.fail("name", "letters, digits and _", fmt::format("\"{}\"", wall.name));
  const auto shape = table.text("shape", {"plane", "cylinder", "box"});
  wall.shape = shape == "plane" ? WallShape::plane : (shape == "box" ? WallShape::box : WallShape::cylinder);
  if (shape == "plane")
    read_plane(table, scene, wall);
  else if (shape == "box")
    read_box(table, scene, wall);
  else
    read_cylinder(table, scene, wall);
  const auto friction = table.number_or_word("friction", {0, 10}, {"no-slip"});
  wall.no_slip = std::holds_alternative<std::string>(friction);
  if (!wall.no_slip) wall.friction = std::get<double>(friction);
  wall.motion = read_motion(table, scene);
  if (scene.geometry == GeometryKind::axisymmetric)
    for (const auto& velocity : wall.motion.velocity)
      if (velocity[0] != 0)
        table.fail(table.has("times") ? "velocity_r" : "velocity", "no radial velocity in axisymmetry",
                   fmt::format("{}", velocity[0]));
  return wall;
}

/// Opposite sides nearer than this would be seen through.
void check_width(const TomlTable& table, const host::Scene& scene, const Wall& wall) {
  const double reach = (2 * scene.numerics.smoothing_length + scene.numerics.skin) * scene.spacing;
  const auto check = [&](const char* key, double width, const std::string& what) {
    if (width < reach)
      table.fail(key, fmt::format("{} of at least {:.4g} m, the reach of particles", what, reach),
                 fmt::format("{:.4g} m", width));
  };
  const int up = int(dimension_of(scene)) - 1;
  if (wall.shape == WallShape::cylinder) {
    check("radius", wall.radius, "a radius");
    if (!wall.inside) check("upper", wall.upper[up] - wall.lower[up], "a height");
  }
  if (wall.shape == WallShape::box)
    for (int a = 0; a <= up; ++a) check("upper", wall.upper[a] - wall.lower[a], "a width");
}

/// Nearest particle of the column to a wall.
template <int D> struct Nearest {
  double distance = host::unbounded;
  host::Vector<D> place{};
};

template <class Geometry> void check_column(const TomlTable& root, const host::Scene& scene) {
  constexpr int D = Geometry::dimension;
  const auto column = host::initial_particles<Geometry>(scene);
  const auto walls = host::all_walls(scene);
  const auto tables = root.tables("wall");
  const double least = host::contact_gap * scene.spacing;
  std::vector<host::Surface<D>> surfaces;
  host::find_surfaces(0, walls, scene.geometry, 0, 0, surfaces);
  for (const auto& s : surfaces) {
    Nearest<D> nearest;
    for (int i = 0; i < column.count; ++i) {
      host::Vector<D> x;
      for (int a = 0; a < D; ++a) x[a] = column.position[a][i];
      const double d = host::body_distance(s, x);
      if (host::beside(s, x) && d < nearest.distance) nearest = {d, x};
    }
    if (nearest.distance >= least * (1 - 1e-9)) continue;
    const auto expected =
        fmt::format("at least {:.4g} m between a particle and the {}", least,
                    s.wall < int(walls.size() - tables.size()) ? walls[s.wall].name : "wall");
    const auto found =
        fmt::format("{:.4g} m at ({:.4g}) m", nearest.distance, fmt::join(nearest.place, ", "));
    const int own = s.wall - int(walls.size() - tables.size());
    if (own < 0) root.table("column").fail("base", expected, found);
    const auto shape = walls[s.wall].shape;
    tables[own].fail(shape == WallShape::plane ? "point" : (shape == WallShape::box ? "lower" : "radius"),
                     expected, found);
  }
}

} // namespace

std::vector<Wall> read_walls(const TomlTable& root, const host::Scene& scene) {
  std::vector<Wall> walls;
  for (const auto& table : root.tables("wall")) {
    const Wall wall = read_wall(table, scene);
    const auto same = [&](const Wall& other) { return other.name == wall.name; };
    if (wall.name == "floor" || wall.name == "gate" || std::ranges::any_of(walls, same))
      table.fail("name", "a name that no other wall has", fmt::format("\"{}\"", wall.name));
    walls.push_back(wall);
  }
  return walls;
}

void read_placement(const TomlTable& table, host::Scene& scene) {
  auto& column = scene.column;
  const bool solid = scene.geometry == GeometryKind::three_dimensional;
  if (scene.geometry == GeometryKind::plane_strain) scene.symmetric = table.flag("symmetric", true);
  if (solid && table.has("depth")) column.depth = table.number("depth", {1e-6, 1e4});
  column.base = table.number("base", {0, 1e4}, 0);
  const bool free = solid ? scene.sector == host::Sector::full
                          : scene.geometry == GeometryKind::plane_strain && !scene.symmetric;
  if (!free) return;
  const auto center = table.numbers("center", solid ? 2 : 1, place, std::vector<double>(solid ? 2 : 1, 0));
  std::ranges::copy(center, column.center.begin());
  column.tilt = table.number("tilt", {-90, 90}, 0);
}

void check_walls(const TomlTable& root, const host::Scene& scene) {
  const auto tables = root.tables("wall");
  for (std::size_t w = 0; w < tables.size(); ++w) check_width(tables[w], scene, scene.walls[w]);
  host::with_geometry(scene.geometry, [&](auto geometry) { check_column<decltype(geometry)>(root, scene); });
}

} // namespace drivers
