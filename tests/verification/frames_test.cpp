// SPDX-License-Identifier: BSD-3-Clause
// The two frames of the SPH host under a homogeneous motion: closed forms, what the audit of a Fortran VUMAT finds,
// and agreement of both frames.
#include "drivers/files/material_file.hpp"
#include "host/material/corotational.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/unit/host_stages.hpp"
#include <Eigen/Dense>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <omp.h>

namespace {

using namespace host;

constexpr double young = 2e6, poisson = 0.25, shear_modulus = young / (2 * (1 + poisson));

Material fortran(const std::string& name, std::vector<double> properties, int states, Frame frame) {
  return {load_vumat(fmt::format("{}/test_vumats/{}.so", SIMSAND_BINARY_DIR, name)), name,
          std::move(properties), states, frame};
}

/// Particles at x = 1, 2, ... m that all see one velocity gradient, with the given state at the start.
struct Homogeneous {
  using Geometry = PlaneStrain;
  Particles<Geometry> p;
  Material material;
  StressBlocks blocks;
  host_test::Stages<Geometry> stages{p};
  double time = 0;

  Homogeneous(const Material& m, int count, const std::vector<double>& state, double density = 1500)
      : material(m) {
    omp_set_num_threads(1); // a few particles, a hundred thousand steps
    p.resize(count, m.state_variables);
    for (int i = 0; i < count; ++i) {
      p.id[i] = i;
      p.position[0][i] = 1 + i;
      p.density[i] = density;
      for (std::size_t s = 0; s < state.size(); ++s) p.state[s][i] = state[s];
    }
    if (m.frame == Frame::green_naghdi) carry_deformation(p);
    blocks = make_stress_blocks(m, p, 0.002);
    blocks.failure_state = -1;
    stages = host_test::Stages<Geometry>(p);
  }
  /// L, 1/s, row by row, over `dt`.
  void step(const std::array<double, 4>& l, double dt) {
    for (int e = 0; e < 4; ++e) stages.velocity_gradient[e].assign(p.padded(), l[e]);
    time += dt;
    update_stress(p, material, {time, time, dt}, blocks, stages);
  }
  std::array<double, 4> stress(int i = 0) const {
    return {p.stress[0][i], p.stress[1][i], p.stress[2][i], p.stress[3][i]};
  }
};

double difference(const std::array<double, 4>& a, const std::array<double, 4>& b) {
  double sum = 0;
  for (int c = 0; c < 4; ++c) sum = std::max(sum, std::abs(a[c] - b[c]));
  return sum;
}

double size(const std::array<double, 4>& a) {
  return difference(a, {});
}

/// Stress of hypoelasticity with the rate of Green and Naghdi in simple shear (Johnson and Bammann 1984, Int. J.
/// Solids Struct. 20:725).
std::array<double, 4> green_naghdi_shear(double g) {
  const double b = std::atan(g / 2), log_cosine = std::log(std::cos(b));
  const double normal =
      4 * shear_modulus * (std::cos(2 * b) * log_cosine + b * std::sin(2 * b) - std::pow(std::sin(b), 2));
  const double tangential =
      2 * shear_modulus * std::cos(2 * b) * (2 * b - 2 * std::tan(2 * b) * log_cosine - std::tan(b));
  return {normal, -normal, 0, tangential};
}

/// The same with the rate of Jaumann.
std::array<double, 4> jaumann_shear(double g) {
  const double normal = shear_modulus * (1 - std::cos(g));
  return {normal, -normal, 0, shear_modulus * std::sin(g)};
}

std::array<double, 4> sheared(Material material, double total, int steps,
                              const std::array<double, 4>& start = {},
                              const std::vector<double>& state = {0}) {
  Homogeneous h(material, 1, state);
  for (int c = 0; c < 4; ++c) h.p.stress[c][0] = start[c];
  for (int s = 0; s < steps; ++s) h.step({0, total / steps, 0, 0}, 1);
  return h.stress();
}

TEST(Frames, SimpleShearOfElasticityIsTheClosedFormOfEachRate) {
  for (const double g : {0.5, 2.0, 5.0}) {
    const auto corotational = fortran("elastic", {young, poisson}, 1, Frame::green_naghdi);
    const auto base = fortran("elastic", {young, poisson}, 1, Frame::jaumann);
    double coarse = 0;
    for (const int steps : {500, 1000}) { // of second order in the step
      const double error = difference(sheared(corotational, g, steps), green_naghdi_shear(g));
      EXPECT_LT(error, 0.3 * std::pow(g / steps, 2) * size(green_naghdi_shear(g)));
      if (coarse > 0) {
        EXPECT_NEAR(coarse / error, 4, 0.2);
      }
      coarse = error;
    }
    EXPECT_LT(difference(sheared(base, g, 1000), jaumann_shear(g)), g / 1000 * size(jaumann_shear(g)));
  }
}

TEST(Frames, J2InUniaxialStrainIsTheClosedForm) {
  constexpr double yield = 2e3, hardening = 1e5, bulk = young / (3 * (1 - 2 * poisson));
  for (const auto frame : {Frame::green_naghdi, Frame::jaumann}) {
    Homogeneous h(fortran("j2", {young, poisson, yield, hardening}, 2, frame), 70, {0, 0});
    for (int s = 1; s <= 50; ++s) { // compressed along axis 2 by 1e-4 a step
      h.step({0, 0, 0, -1}, 1e-4);
      const double strain = 1e-4 * s, first = yield / (2 * shear_modulus);
      const double slope = 2 * shear_modulus * hardening / (hardening + 3 * shear_modulus);
      const double q = strain < first ? 2 * shear_modulus * strain : yield + slope * (strain - first);
      const double p = bulk * strain;
      EXPECT_LT(difference(h.stress(69), {q / 3 - p, -p - 2 * q / 3, q / 3 - p, 0}), 1e-9 * yield) << s;
      EXPECT_NEAR(h.p.state[0][69], strain < first ? 0 : (q - yield) / hardening, 1e-12);
    }
    EXPECT_GT(h.p.inelastic_energy[0], 0);
  }
}

/// Result for no step at all, from those of n and 2 n steps of a method of first order.
template <class F> std::array<double, 4> extrapolated(F&& result, int n) {
  const auto coarse = result(n), fine = result(2 * n);
  std::array<double, 4> out;
  for (int c = 0; c < 4; ++c) out[c] = 2 * fine[c] - coarse[c];
  return out;
}

TEST(Frames, AgreeForAnElasticMaterialThatTakesTheRateOfJaumann) {
  for (const double g : {0.5, 2.0, 5.0}) {
    const auto corotational = fortran("elastic", {young, poisson, 1}, 1, Frame::green_naghdi);
    const auto base = fortran("elastic", {young, poisson}, 1, Frame::jaumann);
    const std::array<double, 4> start{-3e4, -8e4, -4e4, 1e4};
    const auto a = extrapolated([&](int n) { return sheared(corotational, g, n, start); }, 5000);
    const auto b = extrapolated([&](int n) { return sheared(base, g, n, start); }, 5000);
    EXPECT_LT(difference(a, b), 1e-6 * size(b)) << "shear " << g;
  }
}

drivers::LoadedMaterial simsand() {
  return drivers::read_material(
      drivers::parse_toml(fmt::format("[material]\nfile = '{}/data/materials/TS.toml'\nlibrary = '{}'\n",
                                      SIMSAND_SOURCE_DIR, SIMSAND_BINARY_DIR "/libsimsand_vumat.so"),
                          "test")
          .table("material"),
      0.5);
}

/// SIMSAND with the rate of Jaumann in any frame: old stress is turned by relSpinInc before the call.
vumat::Subroutine<double>* simsand_call = nullptr;
void turned_simsand(const int* n, const int* ndir, const int* nshr, const int* nstatev, const int* nfieldv,
                    const int* nprops, const int* info, const double* step_time, const double* total,
                    const double* dt, const char* name, const double* x, const double* h, const double* props,
                    const double* density, const double* strain, const double* spin, const double* to,
                    const double* uo, const double* fo, const double* fieldo, const double* stress,
                    const double* state, const double* ei, const double* ep, const double* tn,
                    const double* un, const double* fn, const double* fieldn, double* stress_new,
                    double* state_new, double* ein, double* epn, std::size_t length) {
  std::vector<double> turned(stress, stress + 4 * *n);
  for (int k = 0; k < *n; ++k) {
    const Eigen::Matrix2d q = Eigen::Rotation2Dd(spin[k]).toRotationMatrix();
    Eigen::Matrix2d s;
    s << stress[k], stress[3 * *n + k], stress[3 * *n + k], stress[*n + k];
    s = q * s * q.transpose();
    turned[k] = s(0, 0), turned[*n + k] = s(1, 1), turned[3 * *n + k] = s(0, 1);
  }
  simsand_call(n, ndir, nshr, nstatev, nfieldv, nprops, info, step_time, total, dt, name, x, h, props,
               density, strain, spin, to, uo, fo, fieldo, turned.data(), state, ei, ep, tn, un, fn, fieldn,
               stress_new, state_new, ein, epn, length);
}

TEST(Frames, AgreeForSimsand) {
  const auto loaded = simsand();
  auto base = loaded.material, corotational = base, plain = base;
  simsand_call = base.library.call;
  corotational.library.call = turned_simsand;
  corotational.frame = plain.frame = Frame::green_naghdi;
  const std::array<double, 4> start{-1000, -2000, -1000, 0};
  for (const double g : {0.1, 1.0, 3.0}) {
    const auto in = [&](const Material& m) {
      return extrapolated([&](int n) { return sheared(m, g, n, start, loaded.initial_state); }, 20000);
    };
    const auto a = in(corotational), b = in(base), c = in(plain);
    EXPECT_LT(difference(a, b), 1e-6 * size(b)) << "shear " << g;
    // Called in the frame of Green and Naghdi as it is, SIMSAND has another objective rate. Plastic flow leaves
    // little of the difference, but some.
    EXPECT_LT(difference(c, b), 3e-2 * size(b)) << "shear " << g;
    EXPECT_GT(difference(c, b), 1e-6 * size(b)) << "shear " << g;
    fmt::print("shear {}: frames {:.2g}, rates {:.2g} of the stress\n", g, difference(a, b) / size(b),
               difference(c, b) / size(b));
  }
}

TEST(Frames, AMaterialIsIndifferentToATurnOfEverything) {
  // A path, and the same path while everything turns: the material sees the same, stress and F turn along.
  const auto material = fortran("elastic", {young, poisson}, 1, Frame::green_naghdi);
  Homogeneous still(material, 70, {0}), turning(material, 70, {0});
  const double rate = 0.3;
  for (int s = 0; s < 40; ++s) {
    Eigen::Matrix2d l;
    l << 0.01 * std::sin(s), 0.03, -0.02 * std::cos(s), 0.005;
    still.step({l(0, 0), l(0, 1), l(1, 0), l(1, 1)}, 1);
    // Half a turn before the strain and half of it after: each exact.
    const auto turn = [&] { turning.step({0, -rate / 2, rate / 2, 0}, 1); };
    turn();
    const Eigen::Matrix2d q = Eigen::Rotation2Dd(rate * (s + 0.5)).toRotationMatrix();
    const Eigen::Matrix2d m = q * l * q.transpose();
    turning.step({m(0, 0), m(0, 1), m(1, 0), m(1, 1)}, 1);
    turn();
  }
  const Eigen::Matrix2d q = Eigen::Rotation2Dd(rate * 40).toRotationMatrix();
  for (const int i : {0, 63, 69}) {
    const auto a = still.stress(i), b = turning.stress(i);
    Eigen::Matrix2d s;
    s << a[0], a[3], a[3], a[1];
    s = q * s * q.transpose();
    EXPECT_LT(difference({s(0, 0), s(1, 1), a[2], s(0, 1)}, b), 1e-11 * size(a));
    EXPECT_NEAR(turning.p.density[i], still.p.density[i], 1e-10);
  }
}

TEST(Frames, TheAuditFindsNothingInTheSphHost) {
  auto material = fortran("audit", {young, poisson, 1500}, 14, Frame::green_naghdi);
  Homogeneous h(material, 197, std::vector<double>(14, 0.0));
  update_wave_speed(h.p, h.material, h.blocks);
  const double expected = std::sqrt(young * (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson)) / 1500);
  EXPECT_NEAR(h.p.wave_speed[100], expected, 1e-6 * expected);
  for (int s = 0; s < 3000; ++s) { // shear to 15, turning and volume change on the way
    h.step({0.3 * std::sin(0.01 * s), 5, 0.7 * std::cos(0.02 * s), 0.2 * std::sin(0.013 * s)}, 1e-3);
    if (s % 100 == 0) update_wave_speed(h.p, h.material, h.blocks);
  }
  double worst = 0;
  for (int i = 0; i < h.p.count; ++i) {
    ASSERT_EQ(h.p.state[0][i], 0) << "codes of audit.f";
    ASSERT_EQ(h.p.state[1][i], 3000);
    worst = std::max(worst, h.p.state[13][i]);
  }
  EXPECT_GT(worst, 0);
  EXPECT_LT(worst, 0.5);
  // What the audit would say if the host were wrong: particles moved without their F.
  h.p.deformation_gradient[3].assign(h.p.padded(), 0.1);
  h.step({0, 0.1, 0, 0}, 1e-3);
  EXPECT_NE(int(h.p.state[0][0]) & 32, 0);
  // F unity, as in the cheap frame: strain without motion.
  material.frame = Frame::jaumann;
  Homogeneous cheap(material, 3, std::vector<double>(14, 0.0));
  cheap.step({0, 10, 0, 0}, 1e-3);
  EXPECT_EQ(int(cheap.p.state[0][0]) & 2, 2);
}

} // namespace
