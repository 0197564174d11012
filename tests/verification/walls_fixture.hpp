// SPDX-License-Identifier: BSD-3-Clause
// Scenes with walls, written as a user would write them, and what is measured on them.
#pragma once
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/verification/scenes.hpp"
#include <cmath>
#include <numbers>

namespace tests {

inline constexpr double g = 9.81;

struct WallCase {
  std::string geometry = "plane_strain", column = "", material = "", walls = "";
  double spacing = 0.01, end_time = 10;
  std::string numerics = "";
};

/// A sand of the library, or an elastic one of density 1500 kg/m3 with K0 = 1.
inline std::string sand(const std::string& name, double void_ratio) {
  return fmt::format("[material]\nfile = \"{}/data/materials/{}.toml\"\nvoid_ratio = {}\n",
                     SIMSAND_SOURCE_DIR, name, void_ratio);
}
inline std::string elastic(double young, double poisson, double K0) {
  return fmt::format(
      "[material]\nlibrary = \"{}/libelastic_vumat.so\"\nname = \"elastic\"\nproperties = [{}, {}]\n"
      "state_variables = 0\ndensity = 1500.0\n[initial_stress]\nK0 = {}\n",
      SIMSAND_BINARY_DIR, young, poisson, K0);
}

inline std::string scene_text(const WallCase& c, const std::string& folder) {
  return fmt::format("[scene]\ngeometry = \"{}\"\nspacing = {}\n[column]\n{}\n{}\n{}\n[end]\ntime = {}\n"
                     "kinetic_energy_fraction = 0\n[output]\nfolder = \"{}\"\nsample_interval = 0.01\n"
                     "snapshot_interval = 0.1\ngrain_diameter = 0.003\n[numerics]\n{}\n",
                     c.geometry, c.spacing, c.column, c.material, c.walls, c.end_time, folder, c.numerics);
}

inline host::Scene wall_scene(const WallCase& c, const std::string& name) {
  const auto folder = fresh_folder(name), path = folder + "/scene.toml";
  std::ofstream(path) << scene_text(c, folder);
  return drivers::read_scene(path);
}

/// Mass of all particles, kg.
template <class Geometry> double mass_of(const host::Particles<Geometry>& p) {
  double sum = 0;
  for (int i = 0; i < p.count; ++i) sum += p.mass[i];
  return sum;
}

/// Momentum of all particles, N s.
template <class Geometry> host::WallVector momentum_of(const host::Particles<Geometry>& p) {
  host::WallVector sum{};
  for (int i = 0; i < p.count; ++i)
    for (int a = 0; a < Geometry::dimension; ++a) sum[a] += p.mass[i] * p.velocity[a][i];
  return sum;
}

template <class Geometry> void run_until(host::Simulation<Geometry>& s, double time) {
  while (s.time < time) host::step(s);
}

/// Expects two simulations to hold the same numbers to the last bit, walls being the same in their order.
template <class Geometry>
void expect_same_bits(const host::Simulation<Geometry>& s, const host::Simulation<Geometry>& t) {
  EXPECT_EQ(s.steps, t.steps);
  EXPECT_EQ(s.time, t.time);
  EXPECT_EQ(s.particles.id, t.particles.id);
  std::vector<host::Array> arrays;
  s.particles.each_persistent([&](const host::Array& a) { arrays.push_back(a); });
  std::size_t k = 0;
  t.particles.each_persistent([&](const host::Array& a) { EXPECT_EQ(a, arrays[k++]) << "array " << k; });
  EXPECT_EQ(s.work.total(), t.work.total());
  for (std::size_t w = 0; w < std::min(s.loads.size(), t.loads.size()); ++w) {
    EXPECT_EQ(s.loads[w].impulse, t.loads[w].impulse);
    EXPECT_EQ(s.loads[w].normal, t.loads[w].normal);
    EXPECT_EQ(s.loads[w].work, t.loads[w].work);
    EXPECT_EQ(s.loads[w].given, t.loads[w].given);
  }
}

/// Runs a scene whose walls are written in another way until the time of `s`, and expects the same numbers.
template <class Geometry>
void expect_same_if_written(const std::string& walls, WallCase c, const std::string& name,
                            const host::Simulation<Geometry>& s) {
  c.walls = walls;
  auto t = host::start_simulation<Geometry>(wall_scene(c, name));
  run_until(t, s.time);
  expect_same_bits(s, t);
}

/// Largest gap between sand and a level base at height `base`, spacings: for places on it half a spacing apart, what the
/// lowest particle above each (within 0.75 spacings sideways) leaves free below itself, half a spacing being its own;
/// negative where all are nearer. Up to a spacing inside of the outermost particles.
template <class Geometry> double gap_above(const host::Simulation<Geometry>& s, double base) {
  constexpr int D = Geometry::dimension, H = D - 1;
  const double spacing = s.scene.spacing;
  const auto& p = s.particles;
  std::array<double, H> from, to;
  from.fill(host::unbounded);
  to.fill(-host::unbounded);
  for (int i = 0; i < p.count; ++i)
    for (int a = 0; a < H; ++a) {
      from[a] = std::min(from[a], p.position[a][i] + spacing);
      to[a] = std::max(to[a], p.position[a][i] - spacing);
    }
  double widest = -host::unbounded;
  for (std::array<double, H> at = from; at[H - 1] <= to[H - 1];) {
    double lowest = host::unbounded;
    for (int i = 0; i < p.count; ++i) {
      double aside = 0;
      for (int a = 0; a < H; ++a) aside = std::max(aside, std::abs(p.position[a][i] - at[a]));
      if (aside <= 0.75 * spacing) lowest = std::min(lowest, p.position[H][i] - base);
    }
    widest = std::max(widest, lowest / spacing - 0.5);
    at[0] += 0.5 * spacing;
    if (H == 2 && at[0] > to[0]) {
      at[0] = from[0];
      at[H - 1] += 0.5 * spacing;
    }
  }
  return widest;
}

/// Mean force on a wall over the time of `f`, N; the last entry is the normal one.
struct MeanForce {
  host::WallVector force{};
  double normal = 0;
};
template <class Geometry> MeanForce mean_force(host::Simulation<Geometry>& s, int wall, double duration) {
  const auto before = s.loads[wall];
  const double start = s.time;
  run_until(s, start + duration);
  MeanForce mean;
  for (int a = 0; a < 3; ++a)
    mean.force[a] = (s.loads[wall].impulse[a] - before.impulse[a]) / (s.time - start);
  mean.normal = (s.loads[wall].normal - before.normal) / (s.time - start);
  return mean;
}

} // namespace tests
