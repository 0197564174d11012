// SPDX-License-Identifier: BSD-3-Clause
#include "vumat/parameters.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace {

std::vector<double> good() {
  return {100, 0.2, 0.51, 18.5, 0.76, 0.04, 0.3, 1, 0.0015, 3.3, 1, 0.58, 101325, 2};
}

simsand::PropsError read(const std::vector<double>& props) {
  simsand::Parameters<double> out;
  return simsand::read_props(props.data(), int(props.size()), out);
}

TEST(VumatParameters, OrderOfPropsIsFixed) {
  const std::vector<std::string_view> keys = {"K0",  "nu",  "n",   "phi", "e_ref", "lambda", "zeta",
                                              "A_d", "k_p", "n_p", "n_d", "e0",    "p_at",   "p_min"};
  ASSERT_EQ(keys.size(), simsand::parameters.size());
  for (int i = 0; i < int(keys.size()); ++i) {
    EXPECT_EQ(simsand::parameters[i].key, keys[i]);
    EXPECT_EQ(simsand::parameter_index(keys[i]), i);
  }
  EXPECT_EQ(simsand::parameter_index("cohesion"), -1);
}

TEST(VumatParameters, EveryEntryIsReadIntoItsPlace) {
  simsand::Parameters<double> p;
  const auto props = good();
  ASSERT_EQ(simsand::read_props(props.data(), 14, p).entry, 0);
  const std::vector<double> read = {p.K0,  p.nu,  p.n,   p.phi, p.e_ref, p.lambda, p.zeta,
                                    p.A_d, p.k_p, p.n_p, p.n_d, p.e0,    p.p_at,   p.p_min};
  EXPECT_EQ(read, props);
}

TEST(VumatParameters, TheFloorOfPressureHasADefaultWhereAbsentOrZero) {
  simsand::Parameters<double> p;
  auto props = good();
  ASSERT_EQ(simsand::read_props(props.data(), 13, p).entry, 0);
  EXPECT_DOUBLE_EQ(p.p_min, 1.01325);
  props[13] = 0;
  ASSERT_EQ(simsand::read_props(props.data(), 14, p).entry, 0);
  EXPECT_DOUBLE_EQ(p.p_min, 1.01325);
}

TEST(VumatParameters, ABadEntryIsNamed) {
  for (int i = 0; i < 14; ++i) {
    for (const double bad : {std::nan(""), -1.0, 1e12}) {
      auto props = good();
      props[i] = bad;
      const auto error = read(props);
      EXPECT_EQ(error.entry, i + 1) << bad;
      EXPECT_STRNE(error.reason, "");
    }
  }
  for (int count = 0; count < 13; ++count) {
    auto props = good();
    props.resize(count);
    EXPECT_EQ(read(props).entry, count + 1);
  }
}

TEST(VumatParameters, AFloorThatWouldGlueIsRefused) {
  auto props = good();
  props[13] = 0.11 * props[12];
  EXPECT_EQ(read(props).entry, 14);
}

TEST(VumatParameters, BoundsAdmitBothEnds) {
  for (int i = 0; i < 12; ++i)
    for (const double end : {simsand::parameters[i].lower, simsand::parameters[i].upper}) {
      auto props = good();
      props[i] = end;
      EXPECT_EQ(read(props).entry, 0) << simsand::parameters[i].key << " = " << end;
    }
}

TEST(VumatParameters, TablesHoldEveryNameOnce) {
  const std::string table = simsand::parameter_table(), states = simsand::state_table();
  std::set<std::string_view> seen;
  for (const auto& p : simsand::parameters) {
    EXPECT_NE(table.find("| `" + std::string(p.key) + "` |"), std::string::npos);
    EXPECT_TRUE(seen.insert(p.key).second);
    EXPECT_FALSE(p.meaning.empty());
  }
  for (const auto& s : simsand::state_variables) {
    EXPECT_NE(states.find("| `" + std::string(s.name) + "` |"), std::string::npos);
    EXPECT_TRUE(seen.insert(s.name).second);
  }
  EXPECT_EQ(simsand::state_variables[simsand::statev::void_ratio].name, "void_ratio");
  EXPECT_EQ(simsand::state_variables[simsand::statev::status].name, "status");
}

} // namespace
