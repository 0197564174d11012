// SPDX-License-Identifier: BSD-3-Clause
// What the protection of a call costs: SIMSAND in blocks of 64 yielding points, called with and without it. Many
// turns in alternation; prints nanoseconds per point and the share.
#include "host/material/block.hpp"
#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

namespace {

constexpr int points = 64;

void call_bare(const host::Material& m, const host::Increment& increment, host::VumatBlock& b) {
  int n = points, direct = 3, shear = b.shear_components, states = b.state_variables, fields = 0;
  int constants = int(m.properties.size());
  std::array<int, 8 + vumat::max_block> info{};
  std::fill(b.dt.begin(), b.dt.end(), increment.dt);
  std::copy(b.state_old.begin(), b.state_old.end(), b.state_new.begin());
  std::copy(b.internal_energy_old.begin(), b.internal_energy_old.end(), b.internal_energy_new.begin());
  std::copy(b.inelastic_energy_old.begin(), b.inelastic_energy_old.end(), b.inelastic_energy_new.begin());
  const std::string name(80, ' ');
  m.library.call(&n, &direct, &shear, &states, &fields, &constants, info.data(), &increment.step_time,
                 &increment.total_time, b.dt.data(), name.data(), b.coordinates.data(), b.char_length.data(),
                 m.properties.data(), b.density.data(), b.strain_increment.data(), b.spin_increment.data(),
                 b.temperature_old.data(), b.stretch_old.data(), b.gradient_old.data(), b.field_old.data(),
                 b.stress_old.data(), b.state_old.data(), b.internal_energy_old.data(),
                 b.inelastic_energy_old.data(), b.temperature_new.data(), b.stretch_new.data(),
                 b.gradient_new.data(), b.field_new.data(), b.stress_new.data(), b.state_new.data(),
                 b.internal_energy_new.data(), b.inelastic_energy_new.data(), name.size());
}

/// Of processor time, so that other programs count as little as possible.
template <class F> double nanoseconds_per_point(F&& call) {
  constexpr int calls = 100;
  const auto now = [] {
    timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return 1e9 * double(t.tv_sec) + double(t.tv_nsec);
  };
  const double start = now();
  for (int c = 0; c < calls; ++c) call();
  return (now() - start) / (calls * points);
}

} // namespace

int main() {
  host::Material m{host::load_vumat(LIBRARY), "SIMSAND", {}, 5};
  m.properties = {100, 0.2, 0.51, 18.5, 0.76, 0.04, 0.3, 1, 0.0015, 3.3, 1, 0.58, 101325, 1};
  host::VumatBlock b(m, points, 1);
  for (int k = 0; k < points; ++k) {
    for (int c = 0; c < 3; ++c) b.stress_old[c * points + k] = -1000;
    b.density[k] = 1600;
    b.strain_increment[k] = -2e-5 * (1 + 0.01 * k);
    b.strain_increment[3 * points + k] = 3e-5;
  }
  const host::Increment increment{1, 1, 1e-5};
  for (int i = 0; i < 200; ++i) { // to yield
    host::call_vumat(m, increment, b);
    std::copy(b.stress_new.begin(), b.stress_new.end(), b.stress_old.begin());
    std::copy(b.state_new.begin(), b.state_new.end(), b.state_old.begin());
  }
  double bare = 1e9, guarded = 1e9;
  std::vector<double> ratios;
  for (int turn = 0; turn < 2000; ++turn) {
    const double one = nanoseconds_per_point([&] { call_bare(m, increment, b); });
    const double other = nanoseconds_per_point([&] { host::call_vumat(m, increment, b); });
    bare = std::min(bare, one);
    guarded = std::min(guarded, other);
    ratios.push_back(other / one);
  }
  std::nth_element(ratios.begin(), ratios.begin() + 1000, ratios.end());
  std::printf(
      "best of all: bare %.2f ns, guarded %.2f ns a point, %.2f %% more; median of pairs %.2f %% more\n",
      bare, guarded, 100 * (guarded / bare - 1), 100 * (ratios[1000] - 1));
}
