// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/run/recorder.hpp"
#include "drivers/run/build_hash.hpp"
#include "drivers/version.hpp"
#include "host/engine/guard.hpp"
#include "host/engine/lists.hpp"
#include "host/files/hdf5_write.hpp"
#include "host/files/whole_file.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>

namespace drivers {
namespace {

template <class Geometry> char axis_name(int a) {
  return Geometry::dimension == 3 ? "xyz"[a] : (Geometry::hoop ? "rz"[a] : "xz"[a]);
}

const std::vector<host::Quantity> general_columns{{"time", "s"},
                                                  {"height", "m"},
                                                  {"front_radius", "m"},
                                                  {"kinetic_energy", "J"},
                                                  {"potential_energy", "J"},
                                                  {"work_stress", "J"},
                                                  {"work_viscosity", "J"},
                                                  {"work_wall", "J"},
                                                  {"work_friction", "J"},
                                                  {"internal_energy", "J"},
                                                  {"inelastic_energy", "J"},
                                                  {"energy_imbalance", "1"},
                                                  {"step_size", "s"}};

/// The general columns, then those of each wall.
template <class Geometry> std::vector<host::Quantity> series_columns(const host::Simulation<Geometry>& s) {
  auto columns = general_columns;
  for (const auto& wall : s.walls) {
    for (const auto& [kind, unit] : {std::pair{"force", "N"}, std::pair{"impulse", "N*s"}}) {
      for (int a = 0; a < Geometry::dimension; ++a)
        columns.push_back({fmt::format("wall_{}_{}_{}", wall.name, kind, axis_name<Geometry>(a)), unit});
      columns.push_back({fmt::format("wall_{}_normal_{}", wall.name, kind), unit});
    }
    columns.push_back({fmt::format("wall_{}_work", wall.name), "J"});
  }
  return columns;
}

std::vector<double> as_row(const Sample& s, int dimension) {
  std::vector<double> row{s.time,        s.height,         s.front,     s.kinetic,       s.potential,
                          s.work.stress, s.work.viscosity, s.work.wall, s.work.friction, s.internal,
                          s.inelastic,   s.imbalance,      s.step_size};
  for (const WallSample& wall : s.walls) {
    row.insert(row.end(), wall.force.begin(), wall.force.begin() + dimension);
    row.push_back(wall.normal_force);
    row.insert(row.end(), wall.load.impulse.begin(), wall.load.impulse.begin() + dimension);
    row.insert(row.end(), {wall.load.normal, wall.load.work});
  }
  return row;
}

Sample from_row(const std::vector<std::vector<double>>& columns, std::size_t row, int dimension) {
  const auto v = [&](std::size_t c) { return columns[c][row]; };
  Sample s{v(0), v(1), v(2), v(3), v(4), {v(5), v(6), v(7), v(8)}, v(9), v(10), v(11), v(12), {}};
  for (std::size_t c = general_columns.size(); c < columns.size(); c += 2 * dimension + 3) {
    WallSample wall;
    for (int a = 0; a < dimension; ++a) {
      wall.force[a] = v(c + a);
      wall.load.impulse[a] = v(c + dimension + 1 + a);
    }
    wall.normal_force = v(c + dimension);
    wall.load.normal = v(c + 2 * dimension + 1);
    wall.load.work = v(c + 2 * dimension + 2);
    s.walls.push_back(wall);
  }
  return s;
}

/// The walls of a sample at `time` that follows `before`.
std::vector<WallSample> wall_samples(const std::vector<host::WallLoad>& loads, double time,
                                     const Sample* before) {
  std::vector<WallSample> walls;
  for (std::size_t w = 0; w < loads.size(); ++w) {
    WallSample wall{loads[w], {}, 0};
    if (before) {
      const double dt = time - before->time;
      for (int a = 0; a < 3; ++a)
        wall.force[a] = (loads[w].impulse[a] - before->walls[w].load.impulse[a]) / dt;
      wall.normal_force = (loads[w].normal - before->walls[w].load.normal) / dt;
    }
    walls.push_back(wall);
  }
  return walls;
}

/// Radii at which the outline is sampled: up to three column heights past the column, farther than any deposit reached.
std::vector<double> outline_places(const host::Scene& scene) {
  const double reach = scene.column.radius + 3 * scene.column.height, middle = scene.column.center[0];
  if (scene.symmetric) return host::outline_radii(scene.spacing, std::abs(middle) + reach);
  return host::outline_radii(scene.spacing, middle + reach, std::min(middle - reach, -scene.spacing));
}

std::filesystem::path result_path(const host::Scene& scene) {
  return std::filesystem::path(scene.output_folder) / "result.h5";
}

template <class Geometry> host::ResultHeader header_of(const host::Simulation<Geometry>& s) {
  return {s.scene.resolved,
          version,
          compiler,
          build_hash("/proc/self/exe", s.scene.material.library.path),
          Geometry::name,
          Geometry::dimension,
          std::size_t(s.particles.count)};
}

std::span<const double> view(const host::Array& a, int count) {
  return {a.data(), std::size_t(count)};
}

template <std::size_t N>
std::vector<std::span<const double>> views(const std::array<host::Array, N>& arrays, int count) {
  std::vector<std::span<const double>> all;
  for (const auto& a : arrays) all.push_back(view(a, count));
  return all;
}

/// What a snapshot holds of each particle; readers find a field by its name.
template <class Geometry> std::vector<host::Field> particle_fields(const host::Simulation<Geometry>& s) {
  const auto& p = s.particles;
  std::vector<host::Field> fields{{"position", "m", views(p.position, p.count)},
                                  {"velocity", "m/s", views(p.velocity, p.count)},
                                  {"stress", "Pa", views(p.stress, p.count)},
                                  {"density", "kg/m3", {view(p.density, p.count)}}};
  for (std::size_t v = 0; v < p.state.size(); ++v)
    fields.push_back({"state_" + s.scene.state_names[v], "1", {view(p.state[v], p.count)}});
  return fields;
}

double total_of(const host::Array& per_mass, const host::Array& mass, int count) {
  double sum = 0;
  for (int i = 0; i < count; ++i) sum += per_mass[i] * mass[i];
  return sum;
}

} // namespace

template <class Geometry>
Recorder<Geometry>::Recorder(const host::Simulation<Geometry>& s)
    : abscissa(outline_places(s.scene)), result(result_path(s.scene), header_of(s), series_columns(s)) {
  write_constants(s);
}

template <class Geometry>
Recorder<Geometry>::Recorder(const host::Simulation<Geometry>& s, const host::RunProgress& progress)
    : abscissa(outline_places(s.scene)), next_sample(progress.next_sample),
      next_snapshot(progress.next_snapshot), last_snapshot(progress.last_snapshot),
      result(result_path(s.scene), header_of(s), series_columns(s), progress.result) {
  if (progress.result.series.size() != series_columns(s).size())
    throw std::runtime_error(fmt::format("{}: its checkpoint has another time series", file()));
  for (std::size_t row = 0; row < progress.result.series.front().size(); ++row)
    series.push_back(from_row(progress.result.series, row, Geometry::dimension));
  if (progress.rest_time >= 0) rest_time = progress.rest_time;
  write_constants(s);
}

/// Writes what does not change in time: masses, first positions, radii of the outline; and scene.toml.
template <class Geometry> void Recorder<Geometry>::write_constants(const host::Simulation<Geometry>& s) {
  const auto& p = s.particles;
  const std::vector<host::Field> fields{{"mass", "kg", {view(p.mass, p.count)}},
                                        {"initial_position", "m", views(p.position, p.count)}};
  result.particles(fields, std::span(p.id).first(p.count));
  result.outline_radii(abscissa);
  const auto scene = std::filesystem::path(s.scene.output_folder) / "scene.toml";
  host::guarded_write(scene, "the scene", [&] { host::write_whole(scene, s.scene.resolved); });
}

template <class Geometry> host::RunProgress Recorder<Geometry>::progress() {
  result.flush();
  return {result.progress(), next_sample, next_snapshot, last_snapshot, rest_time.value_or(-1), {}};
}

/// True if no wall within reach of the sand will move any more.
template <class Geometry> bool walls_are_done(const host::Simulation<Geometry>& s) {
  for (int w = 0; w < int(s.walls.size()); ++w)
    if (s.time < s.walls[w].motion.end() && (s.rebuilds == 0 || host::in_reach(s, w))) return false;
  return true;
}

template <class Geometry> void Recorder<Geometry>::sample(const host::Simulation<Geometry>& s) {
  if (!series.empty() && series.back().time == s.time) return;
  const auto& p = s.particles;
  const auto profiles = host::surface_profiles(p, s.kernel, abscissa, s.scene.sector);
  heights = host::mean_profile(profiles);
  Sample now;
  now.time = s.time;
  now.height = host::outline_height(heights);
  now.front = host::front_of(profiles, abscissa, s.scene.grain_diameter).mean;
  now.kinetic = host::kinetic_energy(p);
  now.potential = host::potential_energy(p, s.scene.gravity);
  now.work = s.work;
  now.internal = total_of(p.internal_energy, p.mass, p.count);
  now.inelastic = total_of(p.inelastic_energy, p.mass, p.count);
  const double scale = host::energy_scale(s);
  now.imbalance = (now.kinetic + now.potential - s.initial_potential_energy - s.work.total()) / scale;
  now.step_size = s.dt;
  now.walls = wall_samples(s.loads, s.time, series.empty() ? nullptr : &series.back());
  const auto row = as_row(now, Geometry::dimension);
  result.sample(row);

  const bool still = !series.empty() && std::abs(now.height - series.back().height) < 5e-3 * s.scene.spacing;
  const bool slow = now.kinetic < s.scene.rest_fraction * scale;
  if (!rest_time && walls_are_done(s) && still && slow) rest_time = s.time;
  series.push_back(now);
}

template <class Geometry> void Recorder<Geometry>::observe(const host::Simulation<Geometry>& s) {
  if (s.time >= next_sample) {
    sample(s);
    next_sample += s.scene.sample_interval;
  }
  if (s.time >= next_snapshot) {
    write_snapshot(s);
    next_snapshot += s.scene.snapshot_interval;
  }
}

template <class Geometry> void Recorder<Geometry>::write_snapshot(const host::Simulation<Geometry>& s) {
  sample(s);
  if (s.time == last_snapshot) return;
  last_snapshot = s.time;
  const auto& p = s.particles;
  heights = host::outline(p, s.kernel, abscissa, s.scene.sector);
  result.snapshot(s.time, particle_fields(s), std::span(p.id).first(p.count), heights);
}

template <class Geometry>
void Recorder<Geometry>::finish(const host::Simulation<Geometry>& s,
                                std::span<const std::pair<host::Quantity, double>> summary) {
  write_snapshot(s);
  for (const auto& [quantity, value] : summary) result.summary(quantity, value);
  result.close();
}

template class Recorder<host::PlaneStrain>;
template class Recorder<host::Axisymmetric>;
template class Recorder<host::ThreeDimensional>;

} // namespace drivers
