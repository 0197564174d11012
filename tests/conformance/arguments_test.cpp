// SPDX-License-Identifier: BSD-3-Clause
// What the calling convention promises to a host, for both libraries: extents, arrays in place of scalars, inputs
// left alone, outputs complete, names and threads without influence.
#include "tests/conformance/library_call.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <thread>

namespace {

using namespace conformance;

template <class Real> class Conformance : public testing::Test {
protected:
  static Arguments<Real> random_block(int points, int shear, int states = own_states) {
    Arguments<Real> a(points, shear, states, properties(grains[1], 0.5));
    set_random(a, 1000 * shear + points);
    return a;
  }
  vumat::Subroutine<Real>* vumat = product<Real>();
};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(Conformance, Precisions);

TYPED_TEST(Conformance, WritesAllOfItsOutputsAndNothingElse) {
  for (const int shear : {1, 3})
    for (const int points : {1, 2, 7, 8, 15, 17, 64, 127, 128, 129, 136, 255, 256, 511, 512})
      for (const int states : {own_states, own_states + 3}) {
        for (const int annealing : {0, 1})
          for (const TypeParam time : {0, 1}) {
            auto a = this->random_block(points, shear, states);
            a.jInfoArray[0] = annealing;
            a.stepTime = a.totalTime = time;
            const auto before = a;
            a.call(this->vumat);
            ASSERT_TRUE(a.inputs_equal(before)) << points;
            for (const auto* output : a.outputs()) {
              ASSERT_TRUE(output->intact()) << points;
              ASSERT_TRUE(output->all_written()) << points;
            }
            for (int k = 0; k < points; ++k) {
              ASSERT_GE(a.stateNew[statev::status * points + k], 0);
              for (int c = own_states; c < states; ++c)
                ASSERT_EQ(a.stateNew[c * points + k], a.stateOld[c * points + k]);
            }
          }
      }
}

TYPED_TEST(Conformance, ReadsNothingBesideItsInputs) {
  for (const int shear : {1, 3})
    for (const int points : {1, 7, 17, 136, 512}) {
      auto a = this->random_block(points, shear), b = a;
      for (auto* input : b.inputs(b)) input->surround(std::numeric_limits<TypeParam>::quiet_NaN());
      a.call(this->vumat);
      b.call(this->vumat);
      EXPECT_TRUE(a.outputs_equal(b)) << points;
    }
}

TYPED_TEST(Conformance, RefusalsWriteNothingElse) {
  // Too few properties, state variables or components: the extents are those that the host announced.
  for (const int shear : {1, 3})
    for (const int states : {0, 1, 4, 5})
      for (const int constants : {0, 1, 11, 14}) {
        auto a = this->random_block(33, shear, own_states);
        a.nstatev = states;
        a.stateOld.resize(33 * states);
        a.stateOld.fill(TypeParam(0.5));
        a.nprops = constants;
        a.clear_outputs();
        a.call(this->vumat);
        for (const auto* output : a.outputs()) ASSERT_TRUE(output->intact() && output->all_written());
        if (states < own_states || constants < 13) {
          for (const TypeParam s : a.stressNew) ASSERT_TRUE(std::isnan(s));
        }
      }
}

TYPED_TEST(Conformance, BlockOf512EqualsItsPoints) {
  for (const int shear : {1, 3}) {
    auto all = this->random_block(512, shear);
    all.call(this->vumat);
    for (int k = 0; k < 512; ++k) {
      Arguments<TypeParam> one(1, shear, own_states, properties(grains[1], 0.5));
      const auto pick = [&](const auto& from, auto& to) {
        for (std::size_t c = 0; c < to.size(); ++c) to[c] = from[c * 512 + k];
      };
      pick(all.strainInc, one.strainInc);
      pick(all.stressOld, one.stressOld);
      pick(all.stateOld, one.stateOld);
      pick(all.density, one.density);
      pick(all.enerInternOld, one.enerInternOld);
      pick(all.enerInelasOld, one.enerInelasOld);
      one.call(this->vumat);
      for (std::size_t c = 0; c < one.stressNew.size(); ++c)
        ASSERT_EQ(one.stressNew[c], all.stressNew[c * 512 + k]) << k;
      for (int c = 0; c < own_states; ++c) ASSERT_EQ(one.stateNew[c], all.stateNew[c * 512 + k]) << k;
      ASSERT_EQ(one.enerInternNew[0], all.enerInternNew[k]);
      ASSERT_EQ(one.enerInelasNew[0], all.enerInelasNew[k]);
    }
  }
}

TYPED_TEST(Conformance, ReadsOneEntryOfTheArraysOf2023) {
  // The scalars that older versions pass, the rest of the arrays other numbers: the same answer.
  auto arrays = this->random_block(136, 3), scalars = arrays, others = arrays;
  scalars.jInfoArray.resize(1);
  scalars.dtArray.resize(1);
  scalars.dtArray[0] = arrays.dtArray[0];
  for (std::size_t i = 1; i < others.jInfoArray.size(); ++i) others.jInfoArray[i] = 1;
  for (std::size_t i = 1; i < others.dtArray.size(); ++i) others.dtArray[i] = TypeParam(i);
  for (auto* a : {&arrays, &scalars, &others}) a->call(this->vumat);
  EXPECT_TRUE(arrays.outputs_equal(scalars));
  EXPECT_TRUE(arrays.outputs_equal(others));
}

TYPED_TEST(Conformance, AnnealingForgetsWhereverTheFlagComesFrom) {
  for (const int shear : {1, 3}) {
    auto a = this->random_block(512, shear);
    a.jInfoArray[0] = 1;
    a.call(this->vumat);
    for (int k = 0; k < 512; ++k) {
      const TypeParam e = a.stateOld[k];
      ASSERT_EQ(a.stateNew[k], e == 0 ? TypeParam(0.5) : e);
      ASSERT_EQ(a.stateNew[statev::separation_strain * 512 + k], 0);
      ASSERT_EQ(a.stateNew[statev::status * 512 + k], 0);
      ASSERT_EQ(a.enerInternNew[k], a.enerInternOld[k]);
      ASSERT_EQ(a.enerInelasNew[k], a.enerInelasOld[k]);
    }
  }
}

TYPED_TEST(Conformance, TheNameOfTheMaterialIsTheUsers) {
  auto a = this->random_block(64, 3);
  a.call(this->vumat);
  for (const char* name : {"", "SAND", "COLUMN-OF-TETRAHEDRA-7"}) {
    auto b = this->random_block(64, 3);
    b.set_name(name);
    b.call(this->vumat);
    EXPECT_TRUE(a.outputs_equal(b)) << name;
  }
}

TYPED_TEST(Conformance, EnergiesArePerMass) {
  for (const int shear : {1, 3}) {
    auto a = this->random_block(512, shear);
    a.call(this->vumat);
    for (int k = 0; k < 512; ++k) {
      double work = 0, terms = 0;
      for (int c = 0; c < 3 + shear; ++c) {
        const double part = (c < 3 ? 0.5 : 1.) *
                            (double(a.stressOld[c * 512 + k]) + a.stressNew[c * 512 + k]) *
                            a.strainInc[c * 512 + k];
        work += part;
        terms += std::abs(part);
      }
      const double scale = terms / a.density[k] + a.enerInternNew[k];
      const double gain = double(a.enerInternNew[k]) - a.enerInternOld[k];
      ASSERT_NEAR(gain, work / a.density[k], 8 * std::numeric_limits<TypeParam>::epsilon() * scale);
      ASSERT_GE(a.enerInelasNew[k], a.enerInelasOld[k]);
    }
  }
}

TYPED_TEST(Conformance, CallsInThreadsEqualCallsAlone) {
  constexpr int count = 8;
  std::vector<Arguments<TypeParam>> alone;
  for (int t = 0; t < count; ++t) {
    alone.emplace_back(64 + t, t % 2 ? 1 : 3, own_states, properties(grains[t % 3], 0.5));
    set_random(alone.back(), t);
  }
  auto together = alone;
  for (auto& a : alone) a.call(this->vumat);
  std::vector<std::thread> threads;
  for (auto& a : together)
    threads.emplace_back([&a, f = this->vumat] {
      for (int i = 0; i < 50; ++i) a.call(f);
    });
  for (auto& t : threads) t.join();
  for (int t = 0; t < count; ++t) EXPECT_TRUE(alone[t].outputs_equal(together[t])) << t;
}

} // namespace
