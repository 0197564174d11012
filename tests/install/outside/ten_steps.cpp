// SPDX-License-Identifier: BSD-3-Clause
// Ten steps of a scene in axisymmetry: `ten_steps SCENE.toml [TABLE.KEY=VALUE]...` prints steps, time in s, and the
// kinetic energy over the initial potential energy.
#include "drivers/files/scene_file.hpp"
#include "host/engine/guard.hpp"
#include "host/engine/integrate.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include <cstdio>
#include <exception>

int main(int argc, char** argv) {
  try {
    const auto scene = drivers::read_scene(argv[1], {argv + 2, argv + argc});
    auto simulation = host::start_simulation<host::Axisymmetric>(scene);
    for (int i = 0; i < 10; ++i) host::step(simulation);
    std::printf("%ld %.17g %.17g\n", simulation.steps, simulation.time,
                host::kinetic_energy(simulation.particles) / host::energy_scale(simulation));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ten_steps: %s\n", error.what());
    return 1;
  }
}
