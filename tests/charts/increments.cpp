// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/increments.hpp"
#include "drivers/files/csv_write.hpp"
#include "drivers/files/scene_file.hpp"
#include "host/engine/metrics.hpp"
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/charts/increment_record.hpp"
#include "tests/charts/rates.hpp"
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <omp.h>
#include <optional>
#include <stdexcept>

namespace charts {
namespace {

namespace statev = simsand::statev;

/// What stands between the host and the material. A VUMAT is a plain function, so what it records to is global.
struct Listener {
  vumat::Subroutine<double>* material = nullptr;
  std::optional<Material> sand;
  double collapse_time = 0; ///< s
  std::vector<IncrementRecord> of_thread;
};
Listener listener;

void note_block(int points, double time, const double* place, const double* strain, const double* stress_old,
                const double* state_old, const double* state_new) {
  auto& record = listener.of_thread[omp_get_thread_num()];
  for (int k = 0; k < points; ++k) {
    const auto state = [&](int index) { return state_old[index * points + k]; };
    SampledUpdate update;
    Tensor stress;
    for (int c = 0; c < 4; ++c) {
      update[c] = -strain[c * points + k];
      update[4 + c] = stress[c] = -stress_old[c * points + k];
    }
    update[8] = state(statev::void_ratio);
    update[9] = state(statev::plastic_deviatoric_strain);
    update[10] = state(statev::separation_strain);
    const double p = pressure_of(update);
    const double f = p > 0 ? yield_of(*listener.sand, {stress, update[8], update[9], update[10]}) / p : 0;
    const auto hash = hash_of(hash_of(hash_of(0, time), place[k]), place[points + k]);
    record.note(time > listener.collapse_time, update, int(state_new[statev::status * points + k]), hash, f);
  }
}

void listening_vumat(const int* nblock, const int* ndir, const int* nshr, const int* nstatev,
                     const int* nfieldv, const int* nprops, const int* lanneal, const double* stepTime,
                     const double* totalTime, const double* dt, const char* cmname, const double* coordMp,
                     const double* charLength, const double* props, const double* density,
                     const double* strainInc, const double* relSpinInc, const double* tempOld,
                     const double* stretchOld, const double* defgradOld, const double* fieldOld,
                     const double* stressOld, const double* stateOld, const double* enerInternOld,
                     const double* enerInelasOld, const double* tempNew, const double* stretchNew,
                     const double* defgradNew, const double* fieldNew, double* stressNew, double* stateNew,
                     double* enerInternNew, double* enerInelasNew, std::size_t cmname_length) {
  listener.material(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, stepTime, totalTime, dt, cmname,
                    coordMp, charLength, props, density, strainInc, relSpinInc, tempOld, stretchOld,
                    defgradOld, fieldOld, stressOld, stateOld, enerInternOld, enerInelasOld, tempNew,
                    stretchNew, defgradNew, fieldNew, stressNew, stateNew, enerInternNew, enerInelasNew,
                    cmname_length);
  const bool first = stateOld[statev::void_ratio * *nblock] == 0;
  if (*totalTime > 0 && !first && *nshr == 1)
    note_block(*nblock, *totalTime, coordMp, strainInc, stressOld, stateOld, stateNew);
}

/// Puts the listener between scene and material.
void listen(host::Scene& scene, int samples) {
  auto& material = scene.material;
  if (std::filesystem::path(material.library.path).filename() != "libsimsand_vumat.so")
    throw std::runtime_error(fmt::format(
        "material library {}: the increments of SIMSAND alone can be charted", material.library.path));
  listener.material = material.library.call;
  listener.sand.emplace(material_of(material.properties));
  listener.collapse_time = 3 * std::sqrt(scene.column.height / scene.gravity);
  listener.of_thread.assign(omp_get_max_threads(), {});
  for (auto& record : listener.of_thread) record.most_kept = samples;
  material.library.call = listening_vumat;
}

template <class Geometry> void run(const host::Scene& scene) {
  auto simulation = host::start_simulation<Geometry>(scene);
  const double start_energy = simulation.initial_potential_energy;
  while (simulation.time < scene.end_time) {
    host::step(simulation);
    const bool late = simulation.time > listener.collapse_time;
    if (late && simulation.steps % 64 == 0 &&
        host::kinetic_energy(simulation.particles) < scene.rest_fraction * start_energy)
      break;
  }
  fmt::print("{} particles, {} steps, {:.3g} s\n", simulation.particles.count, simulation.steps,
             simulation.time);
}

void write_counts(const IncrementRecord& record, const std::filesystem::path& file) {
  drivers::CsvWriter table(increments_header);
  const auto edge = [](int step, double least, double per_decade) {
    return drivers::Rounded{step < 0 ? 0. : least * std::pow(10, step / per_decade), 4};
  };
  for (const auto& [at, n] : record.counts)
    table.row(at.phase ? "coming to rest" : "collapse",
              edge(at.strain - 1, least_strain, strain_classes_per_decade),
              edge(at.strain, least_strain, strain_classes_per_decade),
              edge(at.pressure - 1, least_pressure, pressure_classes_per_decade),
              edge(at.pressure, least_pressure, pressure_classes_per_decade), n);
  table.write(file);
}

void write_states(const IncrementRecord& record, const host::Scene& scene,
                  const std::filesystem::path& file) {
  drivers::CsvWriter table(states_header,
                           {fmt::format("properties {:.17g}", fmt::join(scene.material.properties, " "))});
  for (const auto& [hash, update] : record.kept) {
    for (const double value : update) table.cell(drivers::Rounded{value, 17});
    table.end_row();
  }
  table.write(file);
}

/// Upper edge of the class of strain below which this share of the updates lies; of one phase, of some answers.
double percentile(const IncrementRecord& record, int phase, std::initializer_list<int> answers,
                  double share) {
  std::map<int, std::int64_t> by_strain;
  std::int64_t total = 0, sum = 0;
  for (const auto& [at, n] : record.counts)
    for (const int a : answers)
      if (at.phase == phase && n[a] > 0) {
        by_strain[at.strain] += n[a];
        total += n[a];
      }
  for (const auto& [step, n] : by_strain) {
    sum += n;
    if (double(sum) >= share * double(total))
      return least_strain * std::pow(10, step / strain_classes_per_decade);
  }
  return 0;
}

std::string summary(const IncrementRecord& record) {
  std::string text = "# strain: sqrt(d eps : d eps), upper edges of classes of a quarter decade\n";
  for (const int phase : {0, 1}) {
    std::array<std::int64_t, 4> sum{};
    for (const auto& [at, n] : record.counts)
      for (int i = 0; i < 4; ++i) sum[i] += at.phase == phase ? n[i] : 0;
    const double all = std::max(double(sum[0] + sum[1] + sum[2] + sum[3]), 1.);
    text += fmt::format("[{}]\nupdates = {}\n", phase ? "coming_to_rest" : "collapse", std::int64_t(all));
    text += fmt::format("elastic = {:.5f}\nplastic = {:.5f}\nstress_free = {:.5f}\nsubstepped = {:.5f}\n",
                        sum[0] / all, sum[1] / all, sum[2] / all, sum[3] / all);
    for (const double share : {0.05, 0.5, 0.95, 0.99, 0.999})
      text += fmt::format("strain_{:g}_percent = {:.3g}\nplastic_strain_{:g}_percent = {:.3g}\n", 100 * share,
                          percentile(record, phase, {0, 1, 2, 3}, share), 100 * share,
                          percentile(record, phase, {1, 3}, share));
  }
  const double stressed = std::max(double(record.under_stress), 1.);
  return text + fmt::format("[given_outside_of_the_yield_surface]\nby_1e-6_p = {:.5f}\nby_1e-2_p = {:.5f}\n",
                            record.outside[0] / stressed, record.outside[1] / stressed);
}

} // namespace

void chart_increments(const IncrementOptions& options) {
  auto scene = drivers::read_scene(options.scene);
  if (options.end_time > 0) scene.end_time = options.end_time;
  listen(scene, options.samples);
  host::with_geometry(scene.geometry, [&](auto geometry) { run<decltype(geometry)>(scene); });
  IncrementRecord record;
  record.most_kept = options.samples;
  for (const auto& part : listener.of_thread) record.add(part);
  const std::filesystem::path folder = options.folder;
  std::filesystem::create_directories(folder);
  write_counts(record, folder / "increments.csv");
  write_states(record, scene, folder / "states.csv");
  const auto text = summary(record);
  std::ofstream(folder / "increments.toml") << text;
  fmt::print("{}\n{}\n", text, (folder / "increments.csv").string());
}

} // namespace charts
