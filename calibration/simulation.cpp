// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/simulation.hpp"
#include "host/material/point_block.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace calibration {
namespace {

using drivers::AxisymmetricTensor;

constexpr int shear = 1; // component, always 0

/// Components 11, 22, 33, 12 of the interface.
std::array<double, 3 + shear> components(const AxisymmetricTensor& t) {
  return {t.axial, t.radial, t.radial, 0};
}

} // namespace

struct Simulator::State {
  host::Material material;
  const std::vector<double> initial_state;
  const int failure_state;
  const std::size_t void_ratio_entry; ///< of PROPS
  const Accuracy accuracy;
  const std::vector<Specimen> specimens;
  std::vector<Path> paths;
  std::vector<SpecimenRun> runs;
  std::vector<int> active; ///< runs that have not ended
  host::VumatBlock block;
  long calls = 0, updates = 0;

  State(const drivers::LoadedMaterial& from, std::vector<Specimen> list, const Accuracy& chosen)
      : material(from.material), initial_state(from.initial_state), failure_state(from.failure_state),
        void_ratio_entry(std::size_t(simsand::parameter_index("e0"))), accuracy(chosen),
        specimens(std::move(list)), paths(specimens.size()),
        block(from.material, int(std::clamp<std::size_t>(specimens.size(), 1, vumat::max_block)), shear) {
    for (std::size_t i = 0; i < specimens.size(); ++i) runs.emplace_back(specimens[i], accuracy, paths[i]);
    std::fill(block.density.begin(), block.density.end(), 1.0); // energies are not looked at
  }

  void pack(int k, const SpecimenRun& run, const AxisymmetricTensor& strain_increment) {
    const auto stress = components(run.stress), increment = components(strain_increment);
    host::pack_point(std::span(stress), std::span(increment), run.state, k, block);
  }

  void call() {
    host::call_vumat(material, {1, 1, 1}, block); // at any time: the model is independent of it
    ++calls;
    updates += block.points;
  }

  MaterialAnswer answer(int k) const {
    std::array<double, 3 + shear> stress;
    host::unpack_stress(block, k, std::span(stress));
    // A state that is not finite fails the next update.
    const bool usable =
        std::isfinite(stress[0] + stress[1]) && !host::reports_failure(block, k, failure_state);
    const double status = block.state_new[simsand::statev::status * block.points + k];
    return {{stress[0], stress[1]}, usable, status == double(simsand::Status::substepped)};
  }

  /// An update without strain, at the void ratio of the specimen. False: the material refuses it.
  bool start(int i) {
    auto& run = runs[i];
    material.properties.at(void_ratio_entry) = specimens[i].void_ratio;
    run.begin();
    run.state = initial_state;
    block.points = 1;
    pack(0, run, {});
    call();
    if (!run.take_initial_answer(answer(0))) return false;
    host::unpack_state(block, 0, run.state);
    return true;
  }

  /// One trial for each of the first `count` active runs. Those that have ended are taken out.
  void advance(int count) {
    block.points = count;
    for (int k = 0; k < count; ++k) pack(k, runs[active[k]], runs[active[k]].trial());
    call();
    int left = 0;
    for (int k = 0; k < int(active.size()); ++k) {
      auto& run = runs[active[k]];
      const auto verdict = k < count ? run.take_answer(answer(k)) : TrialOutcome::retry;
      if (verdict == TrialOutcome::accepted) host::unpack_state(block, k, run.state);
      if (verdict != TrialOutcome::ended) active[left++] = active[k];
    }
    active.resize(std::size_t(left));
  }

  void run(std::span<const double> properties) {
    material.properties.assign(properties.begin(), properties.end());
    active.clear();
    for (int i = 0; i < int(runs.size()); ++i)
      if (start(i)) active.push_back(i);
    while (!active.empty()) advance(std::min(int(active.size()), vumat::max_block));
  }
};

Simulator::Simulator(const drivers::LoadedMaterial& material, std::vector<Specimen> specimens,
                     Accuracy accuracy)
    : state(std::make_unique<State>(material, std::move(specimens), accuracy)) {}
Simulator::~Simulator() = default;
Simulator::Simulator(Simulator&&) noexcept = default;

std::span<const Path> Simulator::run(std::span<const double> properties) {
  state->run(properties);
  return state->paths;
}

long Simulator::calls() const {
  return state->calls;
}
long Simulator::material_updates() const {
  return state->updates;
}

} // namespace calibration
