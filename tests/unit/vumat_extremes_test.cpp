// SPDX-License-Identifier: BSD-3-Clause
// Random states and increments with parameters of sands and with any parameters, in both precisions: the work of one point is
// bounded, no state ends beyond the yield surface, and the order of the axes does not matter. A point that cannot be
// updated like that fails.
#include "tests/unit/vumat_fixture.hpp"
#include "vumat/rescue.hpp"
#include <gtest/gtest.h>

namespace {

using simsand::Material;
using simsand::Parameters;
using simsand::SoilState;
using simsand::Status;
template <class T> using Tensor = simsand::SymmetricTensor<T, 6>;

struct Random {
  explicit Random(int seed) : engine(seed) {}
  double operator()(double from, double to) {
    return from + (to - from) * std::uniform_real_distribution<double>()(engine);
  }
  double power(double from, double to) { return std::pow(10, (*this)(from, to)); }
  bool one_in(int n) { return (*this)(0, n) < 1; }
  std::mt19937_64 engine;
};

/// Parameters of sands, or over all of their ranges; stress in Pa.
Parameters<double> any_parameters(Random& random, bool extreme) {
  using vumat_test::p_at;
  const double nu = random(0, 0.45), e0 = 0.6;
  if (extreme)
    return {random.power(0, 5),
            nu,
            random(0, 0.9),
            random(1, 60),
            random(0.05, 2),
            random(0, 1),
            random(0.01, 2),
            random(0, 10),
            random.power(-5, 0),
            random(0, 20),
            random(0, 20),
            e0,
            p_at,
            random.power(-3, 3)};
  return {random.power(1.5, 3),
          nu,
          random(0.3, 0.8),
          random(15, 40),
          random(0.4, 1.4),
          random(0, 0.2),
          random(0.05, 1),
          random(0, 3),
          random.power(-4, -1),
          random(0, 8),
          random(0, 8),
          e0,
          p_at,
          random.power(-1, 2)};
}

struct Case {
  Parameters<double> parameters;
  SoilState<double, 6> state;
  Tensor<double> strain;
};

/// A state on or within its yield surface, p 1e-8 Pa to 10 MPa or 0, and an increment of 1e-9 to 0.1.
Case any_case(Random& random, bool extreme) {
  Case c{any_parameters(random, extreme), {}, {}};
  const auto s = vumat_test::random_deviator(random.engine), d = vumat_test::random_deviator(random.engine);
  const double p = random.one_in(20) ? 0 : random.power(-8, 7), e = random(0.15, 1.65);
  const double eps_d = random.one_in(13) ? 0 : random.power(-6, 0), length = random.power(-9, -1);
  const double volume = random.one_in(4) ? 0 : length * random(-1, 1) * random.power(-2, 0);
  const Material<double> m(c.parameters);
  const auto M = simsand::slopes(m, e, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(s, 1.));
  const double q = p * M.peak * simsand::mobilised(m, eps_d) * std::min(random(0, 3), 1.);
  c.state = {simsand::add_mean(simsand::scale(q, s), p), e, eps_d,
             random.one_in(30) ? random.power(-8, -1) : 0};
  const auto direction = simsand::add(d, random.one_in(2) ? 0.5 : 0, s);
  c.strain = simsand::add_mean(simsand::scale(length, direction), volume / 3);
  return c;
}

template <class T> Tensor<T> rounded(const Tensor<double>& a) {
  Tensor<T> out;
  for (int c = 0; c < 6; ++c) out[c] = T(a[c]);
  return out;
}

/// The same with axes 1, 2, 3 called 3, 1, 2.
template <class T> Tensor<T> relabelled(const Tensor<T>& a) {
  return {{a[1], a[2], a[0], a[4], a[5], a[3]}};
}

template <class T> double largest_component(const Tensor<T>& a) {
  double largest = 0;
  for (int c = 0; c < 6; ++c) largest = std::max(largest, double(std::abs(a[c])));
  return largest;
}

/// q beyond the yield surface over p, evaluated in double precision.
template <class T> double beyond_yield(const Material<double>& m, const SoilState<T, 6>& state) {
  vumat_test::State6 exact{{}, double(state.void_ratio), double(state.plastic_strain), 0};
  for (int c = 0; c < 6; ++c) exact.stress[c] = state.stress[c];
  return vumat_test::yield_of(m, exact) / vumat_test::mean(exact.stress);
}

struct Outcome {
  int failed = 0, relabelling_matters = 0, most_work = 0;
  double beyond_yield = 0;
};

template <class T> Outcome update_cases(int count, bool extreme, double relabelling_tolerance) {
  Random random(1);
  Outcome out;
  for (int i = 0; i < count; ++i) {
    const Case c = any_case(random, extreme);
    const Parameters<double>& g = c.parameters;
    const Material<T> m({T(g.K0), T(g.nu), T(g.n), T(g.phi), T(g.e_ref), T(g.lambda), T(g.zeta), T(g.A_d),
                         T(g.k_p), T(g.n_p), T(g.n_d), T(g.e0), T(g.p_at), T(g.p_min)});
    const SoilState<T, 6> old{rounded<T>(c.state.stress), T(c.state.void_ratio), T(c.state.plastic_strain),
                              T(c.state.separation_strain)};
    const Tensor<T> strain = rounded<T>(c.strain);
    simsand::IncrementProgress<T, 6> at;
    simsand::begin_increment(at, old, strain);
    out.most_work = std::max(out.most_work, simsand::rescue(m, at));
    const auto a = simsand::update(m, old, strain);
    auto other = old;
    other.stress = relabelled(old.stress);
    const auto b = simsand::update(m, other, relabelled(strain));
    out.failed += int(a.status) < 0;
    if (int(a.status) < 0 || int(b.status) < 0) continue;
    if (a.status != Status::stress_free)
      out.beyond_yield = std::max(out.beyond_yield, beyond_yield(Material<double>(g), a.state));
    const auto difference = simsand::add(relabelled(a.state.stress), T(-1), b.state.stress);
    // Stresses far below p_min are known to some roundings of p_min.
    const double scale =
        std::max({largest_component(a.state.stress), largest_component(old.stress), g.p_min});
    out.relabelling_matters += largest_component(difference) > relabelling_tolerance * scale;
  }
  return out;
}

// The substep in which the limit is reached is completed: at most 100 evaluations and the substep itself.
constexpr int most_work = simsand::largest_work + 101;

TEST(VumatExtremes, StatesOfSands) {
  const auto out = update_cases<double>(10000, false, 1e-3);
  EXPECT_LE(out.failed, 10);
  EXPECT_LE(out.relabelling_matters, 5);
  EXPECT_LE(out.most_work, most_work);
  EXPECT_LE(out.beyond_yield, 1e-9);
}

TEST(VumatExtremes, StatesOfSandsInSinglePrecision) {
  const auto out = update_cases<float>(10000, false, 1e-3);
  EXPECT_LE(out.failed, 10);
  EXPECT_LE(out.relabelling_matters, 20);
  EXPECT_LE(out.most_work, most_work);
  EXPECT_LE(out.beyond_yield, 1e-4);
}

TEST(VumatExtremes, AnyParameters) {
  const auto out = update_cases<double>(10000, true, 1e-3);
  EXPECT_LE(out.failed, 200);
  EXPECT_LE(out.relabelling_matters, 5);
  EXPECT_LE(out.most_work, most_work);
  EXPECT_LE(out.beyond_yield, 1e-9);
}

TEST(VumatExtremes, AnyParametersInSinglePrecision) {
  const auto out = update_cases<float>(10000, true, 0.02);
  EXPECT_LE(out.failed, 200);
  EXPECT_LE(out.relabelling_matters, 50);
  EXPECT_LE(out.most_work, most_work);
  EXPECT_LE(out.beyond_yield, 1e-4);
}

} // namespace
