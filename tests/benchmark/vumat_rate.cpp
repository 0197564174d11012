// SPDX-License-Identifier: BSD-3-Clause
// Updates per second of processor time of the material libraries through their calling convention: in double and
// single precision, in blocks of several sizes, beside the same source built without lanes. States and strain
// increments are those of a collapse, and random ones of stated length. The libraries take turns; medians over
// the turns.
#include "tests/benchmark/collapse_states.hpp"
#include "tests/benchmark/random_states.hpp"
#include "vumat/abi.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <dlfcn.h>
#include <stdexcept>

namespace {

using benchmark::States;

constexpr int state_count = 5, status_index = 3, turns = 11;
constexpr double turn_length = 2e4; ///< microseconds
constexpr std::array block_sizes{1, 8, 32, 64, 128, 512};

/// What a call reads and writes.
template <class Real> struct Block {
  Block(const States& states, std::size_t first, int points_)
      : points(points_), components(3 + states.shear_components) {
    for (auto* a : {&strain, &stress_old, &stress_new}) a->assign(std::size_t(points) * components, 0);
    for (auto* a : {&state_old, &state_new}) a->assign(std::size_t(points) * state_count, 0);
    for (auto* a : {&density, &energy_old, &energy_new, &loss_old, &loss_new}) a->assign(points, 0);
    for (int k = 0; k < points; ++k) {
      const auto& point = states.updates[first + k];
      for (int c = 0; c < components; ++c) {
        strain[c * points + k] = Real(point.strain[c]);
        stress_old[c * points + k] = Real(point.stress[c]);
      }
      for (int c = 0; c < state_count; ++c) state_old[c * points + k] = Real(point.state[c]);
      density[k] = Real(point.density);
    }
  }
  int points, components;
  std::vector<Real> strain, stress_old, stress_new, state_old, state_new, density;
  std::vector<Real> energy_old, energy_new, loss_old, loss_new;
};

/// All states that fill whole blocks of the largest size, in blocks of `points`.
template <class Real> struct Blocks {
  Blocks(const States& states, int points) : properties(states.properties.begin(), states.properties.end()) {
    const std::size_t whole = states.updates.size() / block_sizes.back() * block_sizes.back();
    for (std::size_t first = 0; first < whole; first += points) blocks.emplace_back(states, first, points);
    count = double(whole);
  }
  std::vector<Real> properties;
  std::vector<Block<Real>> blocks;
  double count;
};

template <class Real>
void call(vumat::Subroutine<Real>* vumat, const std::vector<Real>& properties, Block<Real>& a, Real time) {
  const int direct = 3, shear = a.components - 3, fields = 0, constants = int(properties.size()),
            annealing = 0;
  const Real step = Real(1e-5);
  const std::array<char, vumat::name_length> name{};
  vumat(&a.points, &direct, &shear, &state_count, &fields, &constants, &annealing, &time, &time, &step,
        name.data(), nullptr, nullptr, properties.data(), a.density.data(), a.strain.data(), nullptr, nullptr,
        nullptr, nullptr, nullptr, a.stress_old.data(), a.state_old.data(), a.energy_old.data(),
        a.loss_old.data(), nullptr, nullptr, nullptr, nullptr, a.stress_new.data(), a.state_new.data(),
        a.energy_new.data(), a.loss_new.data(), name.size());
}

/// Processor time of this thread in microseconds: other programs on the machine do not count.
double now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * double(t.tv_sec) + 1e-3 * double(t.tv_nsec);
}

/// Points per second, in millions; time 0 makes it those of the data check.
template <class Real> double rate(vumat::Subroutine<Real>* vumat, Blocks<Real>& all, Real time = 1) {
  const double start = now();
  double points = 0;
  do {
    for (auto& block : all.blocks) call(vumat, all.properties, block, time);
    points += all.count;
  } while (now() - start < turn_length);
  return points / (now() - start);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

template <class Real> vumat::Subroutine<Real>* open(const char* path) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  void* symbol = library ? dlsym(library, "vumat_") : nullptr;
  if (!symbol) throw std::runtime_error(dlerror());
  return reinterpret_cast<vumat::Subroutine<Real>*>(symbol);
}

struct Libraries {
  vumat::Subroutine<double>* lanes = open<double>(LANES_LIBRARY);
  vumat::Subroutine<double>* scalar = open<double>(SCALAR_LIBRARY);
  vumat::Subroutine<float>* single = open<float>(SINGLE_LIBRARY);
};

/// Shares of the statuses after a call, in percent.
std::array<double, 4> outcome(const Libraries& libraries, const States& states) {
  std::array<double, 4> share{};
  Blocks<double> all(states, 128);
  for (auto& b : all.blocks) {
    call(libraries.lanes, all.properties, b, 1.);
    for (int k = 0; k < b.points; ++k) {
      const double status = b.state_new[status_index * b.points + k];
      if (status >= 0) share[std::size_t(status)] += 100 / all.count;
    }
  }
  return share;
}

/// Length of the strain increment below which a share of the updates lies.
double strain_quantile(const States& states, double share) {
  std::vector<double> lengths;
  for (const auto& update : states.updates) {
    double square = 0;
    for (std::size_t c = 0; c < update.strain.size(); ++c)
      square += (c < 3 ? 1 : 2) * update.strain[c] * update.strain[c];
    lengths.push_back(std::sqrt(square));
  }
  const auto at = lengths.begin() + std::ptrdiff_t(share * double(lengths.size() - 1));
  std::nth_element(lengths.begin(), at, lengths.end());
  return *at;
}

void describe(const Libraries& libraries, const States& states) {
  const auto share = outcome(libraries, states);
  std::printf("  %zu updates; strain increment %.1e (5 %% below), %.1e (median), %.1e (5 %% above)\n"
              "  elastic %.1f %%, plastic %.1f %%, stress free %.1f %%, substepped %.1f %%\n",
              states.updates.size(), strain_quantile(states, 0.05), strain_quantile(states, 0.5),
              strain_quantile(states, 0.95), share[0], share[1], share[2], share[3]);
}

/// Million points per second in blocks of a size: double, single, without lanes; and the ratio of the first to
/// `scalar_one`, without lanes one by one, in the same turn.
void measure(const char* title, const Libraries& libraries, const States& states, int points) {
  Blocks<double> blocks(states, points), ones(states, 1);
  Blocks<float> single(states, points);
  std::vector<double> lanes, singles, scalar, ratio;
  for (int turn = 0; turn < turns; ++turn) {
    lanes.push_back(rate(libraries.lanes, blocks));
    singles.push_back(rate(libraries.single, single));
    scalar.push_back(rate(libraries.scalar, ones));
    ratio.push_back(lanes.back() / scalar.back());
  }
  std::printf("  %-28s %6d %8.2f %8.2f %12.2f %8.1f\n", title, points, median(lanes), median(singles),
              median(scalar), median(ratio));
}

void measure_data_check(const Libraries& libraries, const States& states) {
  Blocks<double> blocks(states, 64), ones(states, 1);
  std::vector<double> lanes, scalar;
  for (int turn = 0; turn < turns; ++turn) {
    lanes.push_back(rate(libraries.lanes, blocks, 0.));
    scalar.push_back(rate(libraries.scalar, ones, 0.));
  }
  std::printf("  %-28s %6d %8.2f %8s %12.2f %8.1f\n", "data check", 64, median(lanes), "", median(scalar),
              median(lanes) / median(scalar));
}

void print_head() {
  std::printf("  %-28s %6s %8s %8s %12s %8s\n", "million per second", "nblock", "double", "single",
              "no lanes, 1", "ratio");
}

void measure_collapse(const Libraries& libraries, const char* scene) {
  constexpr int count = 8192;
  const States states = benchmark::record_collapse(scene, count);
  std::printf("%s\n", scene);
  describe(libraries, states);
  print_head();
  for (const int points : block_sizes) measure("update", libraries, states, points);
  measure_data_check(libraries, states);
}

void measure_random(const Libraries& libraries) {
  constexpr int count = 2048;
  std::printf("random states at yield, 50 Pa to 2 kPa, 6 components\n");
  print_head();
  for (const double decade : {-8., -7., -6., -5., -4.}) {
    const States states = benchmark::random_states(count, {decade, decade + 1});
    char title[64];
    std::snprintf(title, sizeof title, "strain 1e%.0f to 1e%.0f, %.0f%% cut", decade, decade + 1,
                  outcome(libraries, states)[3]);
    measure(title, libraries, states, 128);
  }
}

} // namespace

/// vumat_rate [SCENE.toml ...]
int main(int count, char** words) try {
  const Libraries libraries;
  for (int i = 1; i < count; ++i) measure_collapse(libraries, words[i]);
  if (count == 1) {
    measure_collapse(libraries, DEFAULT_SCENE);
    measure_random(libraries);
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "vumat_rate: %s\n", error.what());
  return 1;
}
