// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/abaqus/model.hpp"
#include "drivers/run/laws.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <numbers>
#include <stdexcept>

namespace drivers {
namespace {

Point3 operator+(const Point3& a, const Point3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Point3 operator*(double s, const Point3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}

bool is_slab(const host::Scene& scene) {
  return scene.geometry == host::GeometryKind::plane_strain;
}

/// A flat part: `m` x `n` facets that span the edges u and v from `corner`; its normal is u x v.
void add_patch(AbaqusPart& part, const Point3& corner, const Point3& u, const Point3& v, int m, int n) {
  const std::size_t base = part.nodes.size(), row = std::size_t(m) + 1;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= m; ++i) part.nodes.push_back(corner + (double(i) / m * u + double(j) / n * v));
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < m; ++i) {
      const std::size_t at = base + std::size_t(j) * row + std::size_t(i);
      part.facets.push_back({at, at + 1, at + 1 + row, at + row});
    }
}

/// A cylinder around z whose facets touch the circle `radius` from outside; normals towards the axis.
void add_cylinder(AbaqusPart& part, double radius, double height, int around, int upwards) {
  const double corner = radius / std::cos(std::numbers::pi / around);
  for (int k = 0; k <= upwards; ++k)
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      part.nodes.push_back({corner * std::cos(angle), corner * std::sin(angle), height * k / upwards});
    }
  const auto node = [&](int i, int k) { return std::size_t(k) * around + std::size_t(i % around); };
  for (int k = 0; k < upwards; ++k)
    for (int i = 0; i < around; ++i)
      part.facets.push_back({node(i, k), node(i, k + 1), node(i + 1, k + 1), node(i + 1, k)});
}

/// How far particles stand out towards the facets of such a cylinder.
double farthest(const AbaqusModel& m, int around) {
  double most = 0;
  for (int i = 0; i < around; ++i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / around;
    for (std::size_t k = 0; k <= m.layers.front().last; ++k)
      most = std::max(most, m.particles[k][0] * std::cos(angle) + m.particles[k][1] * std::sin(angle));
  }
  return most;
}

/// Whole number of facets of about `size` along `length`, within reason.
int facets_along(double length, double size) {
  return std::clamp(int(std::lround(length / size)), 1, 200);
}

/// Centres of a square lattice inside the cylinder (slab: the rectangle), one layer on the other.
void place_particles(const host::Scene& scene, double spacing, AbaqusModel& m) {
  const int columns = int(std::lround(scene.column.radius / spacing));
  const int rows = int(std::lround(scene.column.height / spacing));
  if (columns < 1 || rows < 1)
    throw std::runtime_error(
        fmt::format("scene without particles: a column of {} m x {} m holds none at a spacing of {} m",
                    scene.column.radius, scene.column.height, spacing));
  m.pitch = scene.column.radius / columns;
  m.rise = scene.column.height / rows;
  m.depth = is_slab(scene) ? slab_particles * m.pitch : 0;
  std::vector<Point3> disc;
  for (int i = -columns; i < columns; ++i)
    if (is_slab(scene))
      for (int j = 0; j < slab_particles; ++j) disc.push_back({(i + 0.5) * m.pitch, (j + 0.5) * m.pitch, 0});
    else
      for (int j = -columns; j < columns; ++j)
        if (std::hypot(i + 0.5, j + 0.5) <= columns)
          disc.push_back({(i + 0.5) * m.pitch, (j + 0.5) * m.pitch, 0});
  const double area = is_slab(scene) ? 2 * scene.column.radius * m.depth
                                     : std::numbers::pi * scene.column.radius * scene.column.radius;
  m.volume = area * scene.column.height;
  m.edge = std::cbrt(m.volume / (double(disc.size()) * rows));
  for (int k = 0; k < rows; ++k) {
    const double z = (k + 0.5) * m.rise;
    const double vertical = -scene.bulk_density * scene.gravity * (scene.column.height - z);
    const std::size_t first = m.particles.size();
    m.layers.push_back(
        {z, first, first + disc.size() - 1, scene.earth_pressure_ratio * vertical, vertical, {}});
    for (const auto& p : disc) m.particles.push_back({p[0], p[1], z});
  }
}

/// STATEV of a layer. SIMSAND places its hardening variable under the stress at its first update: the answer
/// to an increment without strain is written out, so that the deck shows what the run starts from. Of
/// other materials nothing is known but the scene's own values.
std::vector<double> initial_state(const host::Scene& scene, const AbaqusModel& m, const AbaqusLayer& layer) {
  if (scene.friction_angle <= 0) return scene.initial_state;
  host::VumatBlock block(scene.material, 1, 3);
  block.density[0] = scene.bulk_density;
  block.char_length[0] = m.edge;
  block.stress_old = {layer.horizontal, layer.horizontal, layer.vertical, 0, 0, 0};
  block.state_old = scene.initial_state;
  constexpr double instant = 1e-9; // s: any, as nothing moves
  host::call_vumat(scene.material, {instant, instant, instant}, block);
  if (scene.failure_state >= 0 && block.state_new[scene.failure_state] < 0)
    throw std::runtime_error(fmt::format("the material refuses the initial stress at {} m height: status {}",
                                         layer.height, block.state_new[scene.failure_state]));
  return block.state_new;
}

/// Distance from the axis that no sand passes: twice the runout of the published laws and no less than two
/// heights; on a floor that brakes little, how far the front of a dam break gets until the end.
double reach(const host::Scene& scene) {
  const auto& column = scene.column;
  double runout = 0;
  for (const auto& law : column_laws(scene.geometry, column.height / column.radius, scene.friction_angle))
    if (std::isfinite(law.runout)) runout = std::max(runout, law.runout * column.radius);
  const double braked = std::max(2 * runout, 2 * column.height);
  const double free = 2 * std::sqrt(scene.gravity * column.height) * scene.end_time;
  constexpr double brakes_well = 0.3;
  const bool brakes = scene.floor.no_slip || scene.floor.friction >= brakes_well;
  return column.radius + (brakes ? braked : std::max(braked, free));
}

void build_rigid_parts(const host::Scene& scene, AbaqusModel& m) {
  const double contact = 0.5 * m.rise; // from the particle's centre to what it touches
  const double far = reach(scene), height = scene.column.height, column_radius = scene.column.radius;
  const double top = 1.5 * height + 10 * m.rise, below = 5 * m.rise, beyond = 2 * m.pitch;
  const double wall_top = height + 4 * m.rise, facet = 2 * m.pitch;
  const bool slab = is_slab(scene), retained = scene.gate.motion != host::GateMotion::remove;
  const double y0 = slab ? 0.5 * m.pitch - contact : -far, y1 = slab ? m.depth - y0 : far;
  const double coarse = far / 20;

  m.floor.name = "FLOOR";
  m.floor.reference = {0, 0.5 * (y0 + y1), 0};
  const double margin = slab ? beyond : 0;
  add_patch(m.floor, {-far, y0 - margin, 0}, {2 * far, 0, 0}, {0, y1 - y0 + 2 * margin, 0}, 40,
            facets_along(y1 - y0, coarse));
  m.box_lower = {-far, y0 - margin, -below};
  m.box_upper = {far, y1 + margin, top};

  m.wall.name = "WALL";
  m.wall.reference = {0, m.floor.reference[1], wall_top};
  const int upwards = facets_along(wall_top, facet);
  const int around = std::max(48, facets_along(2 * std::numbers::pi * column_radius, facet));
  const double wall = contact + (slab ? column_radius - 0.5 * m.pitch : farthest(m, around));
  if (retained && !slab) add_cylinder(m.wall, wall, wall_top, around, upwards);
  if (retained && slab) {
    const double width = y1 - y0 + 2 * beyond;
    add_patch(m.wall, {wall, y0 - beyond, 0}, {0, 0, wall_top}, {0, width, 0}, upwards, 4);
    add_patch(m.wall, {-wall, y0 - beyond, 0}, {0, width, 0}, {0, 0, wall_top}, 4, upwards);
  }
  if (!slab) return;
  m.sides.name = "SIDES";
  m.sides.reference = {0, m.floor.reference[1], top};
  add_patch(m.sides, {-far, y0, -below}, {0, 0, top + below}, {2 * far, 0, 0}, 10, 40);
  add_patch(m.sides, {-far, y1, -below}, {2 * far, 0, 0}, {0, 0, top + below}, 40, 10);
}

} // namespace

double abaqus_particle_count(const host::Scene& scene, double spacing) {
  const double columns = std::round(scene.column.radius / spacing);
  const double rows = std::round(scene.column.height / spacing);
  return rows * columns * (is_slab(scene) ? 2.0 * slab_particles : std::numbers::pi * columns);
}

AbaqusModel make_abaqus_model(const host::Scene& scene, double spacing) {
  // A deck of a cylinder holds the whole of it, whichever way the scene describes it: by its section or a sector.
  if (!scene.walls.empty())
    throw std::runtime_error("an ABAQUS deck has a floor and one retaining wall: expected no [[wall]]");
  if (scene.material.properties.empty())
    throw std::runtime_error("an ABAQUS user material has constants: expected at least one number in the key "
                             "'properties' of [material]");
  AbaqusModel model;
  place_particles(scene, spacing, model);
  for (auto& layer : model.layers) layer.state = initial_state(scene, model, layer);
  build_rigid_parts(scene, model);
  return model;
}

} // namespace drivers
