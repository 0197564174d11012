// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/simulation.hpp"
#include "vumat/parameters.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace calibration {
namespace {

constexpr double first_increment = 1e-5;    // of axial strain: elastic
constexpr double smallest_increment = 1e-9; // below it the material has failed
constexpr int most_iterations = 30;         // of one increment before it is cut
constexpr std::size_t most_rows = 5000;

/// The material cuts an increment that is too long for it into substeps, which cost more than increments do: the
/// next one is shorter, later ones may grow again.
constexpr double after_substeps = 0.5, without_substeps = 1.1;

/// Position of e0 in PROPS of SIMSAND.
constexpr std::size_t void_ratio_entry = 11;
static_assert(simsand::parameters[void_ratio_entry].key == "e0");

struct Stress {
  double axial, radial;
  double p() const { return (axial + 2 * radial) / 3; }
  double q() const { return axial - radial; }
};

/// The search for the lateral strain increment at which `miss`, increasing in it, vanishes: secants inside a bracket.
struct Search {
  double x = 0, slope = 0; ///< trial; d miss / d x, 0: not known yet
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  double x_before = 0, miss_before = 0;
  int tried = 0;

  void next(double miss, double axial_increment) {
    (miss > 0 ? high : low) = x;
    if (tried > 0 && x != x_before) {
      const double secant = (miss - miss_before) / (x - x_before);
      if (secant > 0) slope = secant;
    }
    x_before = x;
    miss_before = miss;
    ++tried;
    double to = slope > 0 ? x - miss / slope : x - std::copysign(0.1 * axial_increment, miss);
    if (!(to > low && to < high)) to = 0.5 * (low + high);
    if (!std::isfinite(to)) to = x - std::copysign(std::ldexp(std::abs(axial_increment), tried - 2), miss);
    x = to;
  }
};

/// A specimen on its way.
struct Walk {
  Stress stress;
  std::vector<double> state; ///< STATEV
  double axial_strain = 0, radial_strain = 0;
  double increment = 0;               ///< of axial strain, tried
  double done = 0, done_before = 0;   ///< the last two increments
  double ratio = 0, ratio_before = 0; ///< lateral over axial strain in them
  double slope = 0;                   ///< of the last search
  int increments = 0;
  double limit = 1; ///< of increments, so that the material needs no substeps
  Search search;
};

/// Lateral strain per axial strain that the kind of test prescribes, or that an elastic material would show.
double first_ratio(TestKind kind) {
  switch (kind) {
  case TestKind::triaxial_drained:
    return -0.25;
  case TestKind::oedometric:
    return 0;
  default:
    return -0.5;
  }
}

bool strain_is_prescribed(TestKind kind) {
  return kind == TestKind::oedometric || kind == TestKind::triaxial_undrained;
}

/// First trial: the lateral ratio, which belongs to the middle of an increment, continued from the last two.
void begin_increment(Walk& w) {
  double ratio = w.ratio;
  if (w.increments > 1)
    ratio += (w.ratio - w.ratio_before) * (w.increment + w.done) / (w.done + w.done_before);
  if (!(std::abs(ratio - w.ratio) < 0.5)) ratio = w.ratio;
  w.search = {};
  w.search.x = ratio * w.increment;
  w.search.slope = w.slope;
}

double miss(const Stress& s, const Specimen& specimen) {
  if (specimen.kind == TestKind::triaxial_drained) return s.radial - specimen.radial_stress;
  return 3 * s.p() - specimen.axial_stress - 2 * specimen.radial_stress;
}

} // namespace

struct Simulator::State {
  drivers::LoadedMaterial loaded;
  host::Material material;
  std::vector<Specimen> specimens;
  Accuracy accuracy;
  host::VumatBlock block;
  std::vector<Walk> walks;
  std::vector<Path> paths;
  std::vector<int> active;
  long calls = 0, updates = 0;

  State(const drivers::LoadedMaterial& from, std::vector<Specimen> list, Accuracy chosen)
      : loaded(from), material(from.material), specimens(std::move(list)), accuracy(chosen),
        block(from.material, int(std::clamp<std::size_t>(specimens.size(), 1, vumat::max_block)), 1),
        walks(specimens.size()), paths(specimens.size()) {}

  void put(int k, const Stress& stress, const std::vector<double>& state, double axial, double radial) {
    const int n = block.points;
    const double strain[] = {axial, radial, radial, 0},
                 old[] = {stress.axial, stress.radial, stress.radial, 0};
    for (int c = 0; c < 4; ++c) {
      block.strain_increment[c * n + k] = -strain[c];
      block.stress_old[c * n + k] = -old[c];
    }
    for (int c = 0; c < block.state_variables; ++c) block.state_old[c * n + k] = state[c];
    block.density[k] = 1; // energies are not looked at
  }

  void call() {
    host::call_vumat(material, {1, 1, 1}, block);
    ++calls;
    updates += block.points;
  }

  Stress stress_of(int k) const { return {-block.stress_new[k], -block.stress_new[block.points + k]}; }
  bool failed(int k) const {
    const Stress s = stress_of(k);
    return !std::isfinite(s.axial + s.radial) ||
           (loaded.failure_state >= 0 && block.state_new[loaded.failure_state * block.points + k] < 0);
  }

  void add_row(int i) {
    const Walk& w = walks[i];
    Path& path = paths[i];
    path.axial_strain.push_back(w.axial_strain);
    path.volumetric_strain.push_back(w.axial_strain + 2 * w.radial_strain);
    path.axial_stress.push_back(w.stress.axial);
    path.radial_stress.push_back(w.stress.radial);
  }

  /// An update without strain sets the state that belongs to the stress and void ratio of the start. False where the
  /// material refuses.
  bool start(int i) {
    const Specimen& specimen = specimens[i];
    Path& path = paths[i];
    for (auto* column :
         {&path.axial_strain, &path.volumetric_strain, &path.axial_stress, &path.radial_stress})
      column->clear();
    path.complete = false;
    Walk& w = walks[i];
    w = {};
    w.stress = {specimen.axial_stress, specimen.radial_stress};
    if (material.properties.size() > void_ratio_entry)
      material.properties[void_ratio_entry] = specimen.void_ratio;
    block.points = 1;
    put(0, w.stress, loaded.initial_state, 0, 0);
    call();
    add_row(i);
    if (failed(0)) return false;
    w.stress = stress_of(0);
    take_state(w, 0);
    w.ratio = first_ratio(specimen.kind);
    w.increment =
        std::copysign(std::min(first_increment, std::abs(specimen.end_strain)), specimen.end_strain);
    begin_increment(w);
    return true;
  }

  void take_state(Walk& w, int k) {
    w.state.resize(block.state_variables);
    for (int c = 0; c < block.state_variables; ++c) w.state[c] = block.state_new[c * block.points + k];
  }

  /// How far the point is from the straight continuation of the last increment, over what is allowed.
  double bend(const Walk& w, const Path& path, const Stress& next, double volumetric) const {
    const std::size_t n = path.axial_strain.size();
    if (n < 2) return 0.25;
    const Stress last{path.axial_stress[n - 1], path.radial_stress[n - 1]},
        before{path.axial_stress[n - 2], path.radial_stress[n - 2]};
    const double share = w.increment / (path.axial_strain[n - 1] - path.axial_strain[n - 2]);
    const double level = std::max({last.p(), next.p(), 1e-3 * path.axial_stress[0]});
    const double axial = next.axial - last.axial - share * (last.axial - before.axial);
    const double radial = next.radial - last.radial - share * (last.radial - before.radial);
    const double volume = volumetric - path.volumetric_strain[n - 1] -
                          share * (path.volumetric_strain[n - 1] - path.volumetric_strain[n - 2]);
    return std::max(std::max(std::abs(axial), std::abs(radial)) / (level * accuracy.stress),
                    std::abs(volume) / accuracy.volumetric_strain);
  }

  /// Takes the answer of point k for specimen i. False when the specimen is done, for good or ill.
  bool judge(int i, int k) {
    Walk& w = walks[i];
    const Specimen& specimen = specimens[i];
    Path& path = paths[i];
    const Stress answer = stress_of(k);
    if (failed(k) || w.search.tried > most_iterations) return cut(w);
    const double x = w.search.x;
    if (!strain_is_prescribed(specimen.kind)) {
      const double off = miss(answer, specimen);
      if (std::abs(off) > accuracy.control * (specimen.axial_stress + 2 * specimen.radial_stress) / 3) {
        w.search.next(off, w.increment);
        return true;
      }
    }
    const double volumetric = w.axial_strain + w.increment + 2 * (w.radial_strain + x);
    const double error = bend(w, path, answer, volumetric);
    if (error > 16 && std::abs(w.increment) > first_increment) return cut(w);
    const bool substepped = block.state_new[simsand::statev::status * block.points + k] == 3;
    w.limit = substepped ? after_substeps * std::abs(w.increment) : without_substeps * w.limit;
    w.stress = answer;
    take_state(w, k);
    w.axial_strain += w.increment;
    w.radial_strain += x;
    add_row(i);
    w.slope = w.search.slope;
    w.ratio_before = w.ratio;
    w.ratio = x / w.increment;
    w.done_before = w.done;
    w.done = w.increment;
    ++w.increments;
    if (std::abs(w.axial_strain) >= std::abs(specimen.end_strain)) {
      path.complete = true;
      return false;
    }
    if (path.axial_strain.size() >= most_rows) return false;
    const double grown = std::abs(w.increment) * std::clamp(0.9 / std::sqrt(error), 0.3, 2.0);
    w.increment = std::copysign(std::min({grown, w.limit, accuracy.largest_increment}), specimen.end_strain);
    begin_increment(w);
    return true;
  }

  bool cut(Walk& w) {
    w.increment *= 0.25;
    if (std::abs(w.increment) < smallest_increment) return false;
    begin_increment(w);
    return true;
  }

  void run(std::span<const double> properties) {
    material.properties.assign(properties.begin(), properties.end());
    active.clear();
    for (int i = 0; i < int(specimens.size()); ++i)
      if (start(i)) active.push_back(i);
    while (!active.empty()) {
      const int here = std::min(int(active.size()), vumat::max_block);
      block.points = here;
      for (int k = 0; k < here; ++k) {
        const Walk& w = walks[active[k]];
        put(k, w.stress, w.state, w.increment, w.search.x);
      }
      call();
      int left = 0; // those that go on close up
      for (int k = 0; k < int(active.size()); ++k)
        if (k >= here || judge(active[k], k)) active[left++] = active[k];
      active.resize(left);
    }
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
