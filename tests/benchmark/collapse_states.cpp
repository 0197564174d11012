// SPDX-License-Identifier: BSD-3-Clause
#include "tests/benchmark/collapse_states.hpp"
#include "drivers/files/scene_file.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cmath>
#include <omp.h>

namespace benchmark {
namespace {

/// Of the call that is recorded: a VUMAT is a plain function, so what it writes to is found here.
struct Recording {
  vumat::Subroutine<double>* vumat = nullptr;
  States* into = nullptr;
  bool on = false;
};
Recording recording;

std::vector<double> column_of(const double* array, int columns, int points, int k) {
  std::vector<double> out(columns);
  for (int c = 0; c < columns; ++c) out[c] = array[std::size_t(c) * points + k];
  return out;
}

/// Passes the call on, and keeps its inputs while the recording is on.
void recorded(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* nfieldv,
              const int* nprops, const int* lanneal, const double* stepTime, const double* totalTime,
              const double* dt, const char* cmname, const double* coordMp, const double* charLength,
              const double* props, const double* density, const double* strainInc, const double* relSpinInc,
              const double* tempOld, const double* stretchOld, const double* defgradOld,
              const double* fieldOld, const double* stressOld, const double* stateOld,
              const double* enerInternOld, const double* enerInelasOld, const double* tempNew,
              const double* stretchNew, const double* defgradNew, const double* fieldNew, double* stressNew,
              double* stateNew, double* enerInternNew, double* enerInelasNew, std::size_t length) {
  if (recording.on && *totalTime > 0)
    for (int k = 0, n = *nblock; k < n; ++k)
      recording.into->updates.push_back({column_of(stressOld, *ndir + *nshr, n, k),
                                         column_of(strainInc, *ndir + *nshr, n, k),
                                         column_of(stateOld, *nstatev, n, k), density[k]});
  recording.vumat(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, stepTime, totalTime, dt, cmname,
                  coordMp, charLength, props, density, strainInc, relSpinInc, tempOld, stretchOld, defgradOld,
                  fieldOld, stressOld, stateOld, enerInternOld, enerInelasOld, tempNew, stretchNew,
                  defgradNew, fieldNew, stressNew, stateNew, enerInternNew, enerInelasNew, length);
}

/// Records whole steps, evenly in time.
template <class Geometry> void run(const host::Scene& scene, int count, double duration) {
  auto simulation = host::start_simulation<Geometry>(scene);
  const int times = std::max(1, count / simulation.particles.count);
  for (int i = 0; i < times; ++i) {
    while (simulation.time < (i + 0.5) * duration / times) host::step(simulation);
    recording.on = true;
    host::step(simulation);
    recording.on = false;
  }
}

} // namespace

States record_collapse(const std::string& scene_file, int count) {
  omp_set_num_threads(1); // the recording has one order
  host::Scene scene = drivers::read_scene(scene_file);
  States states;
  states.properties = scene.material.properties;
  recording = {scene.material.library.call, &states, false};
  scene.material.library.call = recorded;
  const double duration = 3 * std::sqrt(scene.column.height / scene.gravity); // to rest, Lube et al. 2004
  if (scene.geometry == host::GeometryKind::plane_strain)
    run<host::PlaneStrain>(scene, count, duration);
  else
    run<host::Axisymmetric>(scene, count, duration);
  return states;
}

} // namespace benchmark
