// SPDX-License-Identifier: BSD-3-Clause
// Updates per second of processor time of a material library through its calling convention: in blocks of 1 and 128 points,
// beside the same source built without lanes. The libraries take turns; medians over the turns.
#include "vumat/abi.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <dlfcn.h>
#include <random>
#include <vector>

namespace {

constexpr int components = 6, states = 5, status_index = 3, block_count = 8, repetitions = 8, turns = 15;

/// Points of a block, or one: what a call reads and writes.
struct Arrays {
  explicit Arrays(int points_) : points(points_) {
    for (auto* a : {&strain, &stress_old, &stress_new}) a->assign(std::size_t(points) * components, 0);
    for (auto* a : {&state_old, &state_new}) a->assign(std::size_t(points) * states, 0);
    for (auto* a : {&energy_old, &energy_new, &loss_old, &loss_new}) a->assign(points, 0);
    density.assign(points, 1600);
  }
  int points;
  std::vector<double> strain, stress_old, stress_new, state_old, state_new, density;
  std::vector<double> energy_old, energy_new, loss_old, loss_new;
};

void call(vumat::Subroutine<double>* vumat, Arrays& a) {
  static const std::array<double, 14> props{100, 0.2,    0.51, 18.5, 0.76, 0.04,   0.3,
                                            1,   0.0015, 3.3,  1,    0.58, 101325, 0};
  const int direct = 3, shear = 3, fields = 0, constants = int(props.size()), annealing = 0;
  const double time = 1, step = 1e-5;
  const std::array<char, vumat::name_length> name{};
  vumat(&a.points, &direct, &shear, &states, &fields, &constants, &annealing, &time, &time, &step,
        name.data(), nullptr, nullptr, props.data(), a.density.data(), a.strain.data(), nullptr, nullptr,
        nullptr, nullptr, nullptr, a.stress_old.data(), a.state_old.data(), a.energy_old.data(),
        a.loss_old.data(), nullptr, nullptr, nullptr, nullptr, a.stress_new.data(), a.state_new.data(),
        a.energy_new.data(), a.loss_new.data(), name.size());
}

using Deviator = std::array<double, components>;

Deviator random_deviator(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Deviator s;
  for (double& c : s) c = normal(random);
  const double mean = (s[0] + s[1] + s[2]) / 3;
  double square = 0;
  for (int c = 0; c < components; ++c) {
    if (c < 3) s[c] -= mean;
    square += (c < 3 ? 1.5 : 3) * s[c] * s[c];
  }
  for (double& c : s) c /= std::sqrt(square);
  return s; // q = 1
}

/// A collapse: 50 Pa to 2 kPa, at yield; strain of a length within 10^range, its direction that of the stress
/// and as much of any other, and some volume.
std::vector<Arrays> collapse(std::array<double, 2> range, double larger_share) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> uniform;
  const auto power = [&](double from, double to) {
    return std::pow(10, from + (to - from) * uniform(random));
  };
  std::vector<Arrays> blocks(block_count, Arrays(128));
  for (Arrays& b : blocks)
    for (int k = 0; k < b.points; ++k) {
      const double p = power(std::log10(50), std::log10(2000)), q = p * 0.6 * uniform(random);
      const bool larger = uniform(random) < larger_share;
      const double length = larger ? power(-4, -3) : power(range[0], range[1]);
      const double volume = 0.3 * length * (2 * uniform(random) - 1);
      const Deviator s = random_deviator(random), d = random_deviator(random);
      for (int c = 0; c < components; ++c) {
        b.stress_old[c * b.points + k] = -(q * s[c] + (c < 3 ? p : 0));
        b.strain[c * b.points + k] = -(length * (s[c] + d[c]) / 2 + (c < 3 ? volume / 3 : 0));
      }
      b.state_old[k] = 0;
    }
  return blocks;
}

/// The state that a first update with no strain gives: on the yield surface.
void place_at_yield(vumat::Subroutine<double>* vumat, std::vector<Arrays>& blocks) {
  for (Arrays& b : blocks) {
    std::vector<double> strain(b.strain.size(), 0);
    std::swap(strain, b.strain);
    call(vumat, b);
    b.strain = strain;
    b.stress_old = b.stress_new;
    std::mt19937_64 random(2);
    std::uniform_real_distribution<double> e(0.58, 0.8);
    b.state_old = b.state_new;
    for (int k = 0; k < b.points; ++k) b.state_old[k] = e(random);
  }
}

std::vector<Arrays> one_by_one(const std::vector<Arrays>& blocks) {
  std::vector<Arrays> ones;
  for (const Arrays& b : blocks)
    for (int k = 0; k < b.points; ++k) {
      ones.emplace_back(1);
      for (int c = 0; c < components; ++c) {
        ones.back().strain[c] = b.strain[c * b.points + k];
        ones.back().stress_old[c] = b.stress_old[c * b.points + k];
      }
      for (int c = 0; c < states; ++c) ones.back().state_old[c] = b.state_old[c * b.points + k];
    }
  return ones;
}

/// Processor time of this thread in microseconds: other programs on the machine do not count.
double now() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * double(t.tv_sec) + 1e-3 * double(t.tv_nsec);
}

/// Updates per second, in millions.
double rate(vumat::Subroutine<double>* vumat, std::vector<Arrays>& blocks) {
  const double start = now();
  for (int i = 0; i < repetitions; ++i)
    for (Arrays& b : blocks) call(vumat, b);
  return repetitions * block_count * 128 / (now() - start);
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
  return v[v.size() / 2];
}

void measure(const char* title, vumat::Subroutine<double>* lanes, vumat::Subroutine<double>* scalar,
             std::array<double, 2> range, double larger_share) {
  auto blocks = collapse(range, larger_share);
  place_at_yield(lanes, blocks);
  auto ones = one_by_one(blocks);
  std::vector<double> a, b, c, ratio;
  for (int turn = 0; turn < turns; ++turn) {
    a.push_back(rate(lanes, blocks));
    b.push_back(rate(lanes, ones));
    c.push_back(rate(scalar, ones));
    ratio.push_back(a.back() / c.back());
  }
  std::array<int, 4> share{};
  for (const Arrays& x : blocks)
    for (int k = 0; k < x.points; ++k) {
      const double status = x.state_new[status_index * x.points + k];
      if (status >= 0) ++share[int(status)];
    }
  const double percent = 100. / (block_count * 128);
  std::printf("%-26s %8.2f %8.2f %12.2f %8.1f   %3.0f %3.0f %3.0f %3.0f\n", title, median(a), median(b),
              median(c), median(ratio), share[0] * percent, share[1] * percent, share[2] * percent,
              share[3] * percent);
}

vumat::Subroutine<double>* open(const char* path) {
  void* library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  void* symbol = library ? dlsym(library, "vumat_") : nullptr;
  if (!symbol) std::fprintf(stderr, "%s: %s\n", path, dlerror());
  return reinterpret_cast<vumat::Subroutine<double>*>(symbol);
}

} // namespace

/// vumat_rate [library [library without lanes]]
int main(int count, char** words) {
  auto* lanes = open(count > 1 ? words[1] : LANES_LIBRARY);
  auto* scalar = open(count > 2 ? words[2] : SCALAR_LIBRARY);
  if (!lanes || !scalar) return 1;
  std::printf("million updates per second, nblock       128        1  no lanes, 1    ratio   %%: elastic, "
              "plastic, stress free, substepped\n");
  measure("strain 1e-8 to 1e-6", lanes, scalar, {-8, -6}, 0);
  measure("1e-6 to 1e-4", lanes, scalar, {-6, -4}, 0);
  measure("1e-8 to 1e-4", lanes, scalar, {-8, -4}, 0);
  measure("1e-8 to 1e-4, 10% to 1e-3", lanes, scalar, {-8, -4}, 0.1);
  measure("1e-4 to 1e-3", lanes, scalar, {-4, -3}, 0);
}
