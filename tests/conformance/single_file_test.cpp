// SPDX-License-Identifier: BSD-3-Clause
// The single file for ABAQUS, compiled alone, beside the libraries.
#include "tests/conformance/library_call.hpp"
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>
#include <set>
#include <sstream>

namespace {

using namespace conformance;

/// Compares two subroutines on random blocks over a few increments each.
template <class Real, class Compare>
void on_random_blocks(vumat::Subroutine<Real>* one, vumat::Subroutine<Real>* other, const Compare& compare) {
  for (int i = 0; i < 60; ++i) {
    const int points = std::array{1, 13, 128, 136, 512}[i % 5], shear = i % 2 ? 1 : 3;
    Arguments<Real> a(points, shear, own_states + i % 2, properties(grains[i % 3], 0.5));
    set_random(a, i);
    if (i == 58) a.stepTime = a.totalTime = 0;
    if (i == 59) a.jInfoArray[0] = 1;
    auto b = a;
    for (int step = 0; step < 5; ++step) {
      a.call(one);
      b.call(other);
      compare(a, b);
      a.advance();
      b = a;
    }
  }
}

template <class Real> class SingleFile : public testing::Test {
protected:
  static constexpr const char* suffix = sizeof(Real) == 4 ? "_sp.so" : "_dp.so";
  vumat::Subroutine<Real>* alone = load<Real>(std::string("conformance/single_file") + suffix);
};
using Precisions = testing::Types<double, float>;
TYPED_TEST_SUITE(SingleFile, Precisions);

TYPED_TEST(SingleFile, EqualsItsSourcesBitForBit) {
  // Compiled with the same flags.
  on_random_blocks(this->alone, load<TypeParam>(std::string("conformance/plain") + this->suffix),
                   [](const auto& a, const auto& b) { ASSERT_TRUE(a.outputs_equal(b)); });
}

TYPED_TEST(SingleFile, EqualsTheLibraryButForRounding) {
  // The library fuses multiply-adds and may have wider vectors. In single precision an update in a thousand may turn
  // on a rounding, of which substeps follow.
  std::vector<double> errors;
  on_random_blocks(this->alone, product<TypeParam>(), [&](const auto& a, const auto& b) {
    for (int k = 0; k < a.nblock; ++k) {
      double error = 0, size = 1;
      for (int c = 0; c < 3 + a.nshr; ++c) {
        const int j = c * a.nblock + k;
        error = std::max(error, std::abs(double(a.stressNew[j]) - b.stressNew[j]));
        size = std::max({size, std::abs(double(a.stressOld[j])), std::abs(double(a.stressNew[j]))});
      }
      errors.push_back(error / size);
    }
  });
  std::sort(errors.begin(), errors.end());
  std::printf("%zu updates, relative difference of the stress: median %.1e, 99.9 %% %.1e, largest %.1e\n",
              errors.size(), errors[errors.size() / 2], errors[errors.size() * 999 / 1000], errors.back());
  if (sizeof(TypeParam) == 8)
    EXPECT_LT(errors.back(), 1e-12);
  else
    EXPECT_LT(errors[errors.size() * 999 / 1000], 1e-4);
}

TEST(SingleFileText, NeedsNothingButTheStandardLibrary) {
  std::ifstream in(std::string(SIMSAND_BINARY_DIR) + "/simsand_vumat.cpp");
  ASSERT_TRUE(in);
  std::string line, text;
  std::set<std::string> includes;
  while (std::getline(in, line)) {
    if (line.rfind("#include", 0) == 0) {
      EXPECT_EQ(line[9], '<') << line;
      EXPECT_TRUE(includes.insert(line).second) << line;
    }
    for (const char c : line) ASSERT_TRUE(c >= ' ' && c <= '~') << line;
    text += line + "\n";
  }
  EXPECT_EQ(text.find("vumat_(const"), std::string::npos); // the exported name is a macro
  for (const auto& p : simsand::parameters) EXPECT_NE(text.find(std::string(p.meaning)), std::string::npos);
  for (const auto& s : simsand::state_variables) EXPECT_NE(text.find(std::string(s.name)), std::string::npos);
}

TEST(SingleFileText, WindowsBranchHasTheNameOfWindows) {
  auto* windows = load<double>("conformance/single_file_windows.so", "VUMAT");
  EXPECT_THROW(load<double>("conformance/single_file_windows.so"), std::runtime_error);
  on_random_blocks(windows, windows, [](const auto& a, const auto&) {
    for (int k = 0; k < a.nblock; ++k) ASSERT_GE(a.stateNew[statev::status * a.nblock + k], 0);
  });
}

} // namespace
