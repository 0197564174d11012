// SPDX-License-Identifier: BSD-3-Clause
// The call of a subroutine: what it is given before, what is found out after, and the routines it may call.
#include "host/material/block.hpp"
#include "host/material/reproducer.hpp"
#include "host/material/utilities.hpp"
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <tuple>

namespace {

using namespace host;

/// Pointers of one call, by their names in ABAQUS; inputs too, as a Fortran subroutine has them.
struct Arguments {
  int nblock, nstatev;
  double total_time;
  double *dt, *props, *density, *strain, *spin, *stretch_old, *gradient_old, *stress_old, *state_old,
      *energy_old, *temp_new, *gradient_new, *stress_new, *state_new, *energy_new, *inelastic_new;
  std::string name;
  std::size_t name_length;
  int* info;
  char* name_itself;
};

/// What the subroutine of the running test does.
std::function<void(const Arguments&)> action;

void subroutine(const int* nblock, const int*, const int* nshr, const int* nstatev, const int*, const int*,
                const int* info, const double*, const double* total, const double* dt, const char* name,
                const double*, const double*, const double* props, const double* density,
                const double* strain, const double* spin, const double*, const double* stretch,
                const double* gradient, const double*, const double* stress, const double* state,
                const double* energy, const double*, const double* temp_new, const double*,
                const double* gradient_new, const double*, double* stress_new, double* state_new,
                double* energy_new, double* inelastic_new, std::size_t length) {
  const auto open = [](const double* p) { return const_cast<double*>(p); };
  std::copy_n(stress, *nblock * (3 + *nshr), stress_new);
  action({*nblock,
          *nstatev,
          *total,
          open(dt),
          open(props),
          open(density),
          open(strain),
          open(spin),
          open(stretch),
          open(gradient),
          open(stress),
          open(state),
          open(energy),
          open(temp_new),
          open(gradient_new),
          stress_new,
          state_new,
          energy_new,
          inelastic_new,
          {name, length},
          length,
          const_cast<int*>(info),
          const_cast<char*>(name)});
}

Material material() {
  return {{"here", nullptr, subroutine}, "Sand-a", {1, 2, 3}, 2};
}

/// The error of one call for `points` points, "" if there is none.
std::string error_of(const std::function<void(const Arguments&)>& what, Material m = material(),
                     int points = 5, int calls = 1) {
  action = what;
  VumatBlock block(m, points, 1);
  try {
    for (int c = 0; c < calls; ++c) call_vumat(m, {0.5, 0.75, 1e-3}, block);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(VumatCall, FindsWhatIsWrittenBeyondAnArray) {
  const auto beyond = [](const std::string& name) {
    return "material Sand-a: its subroutine wrote beyond the end of " + name;
  };
  const auto before = [](const std::string& name) {
    return "material Sand-a: its subroutine wrote before the start of " + name;
  };
  for (const int n : {1, 5, 64}) {
    const auto error = [&](auto f) { return error_of(f, material(), n); };
    EXPECT_EQ(error([](const Arguments& a) { a.stress_new[4 * a.nblock] = 0; }), beyond("stressNew"));
    EXPECT_EQ(error([](const Arguments& a) { a.state_new[2 * a.nblock + 7] = 0; }), beyond("stateNew"));
    EXPECT_EQ(error([](const Arguments& a) { a.energy_new[a.nblock] = 0; }), beyond("enerInternNew"));
    EXPECT_EQ(error([](const Arguments& a) { a.inelastic_new[-1] = 0; }), before("enerInelasNew"));
    EXPECT_EQ(error([](const Arguments& a) { a.strain[4 * a.nblock] = 0; }), beyond("strainInc"));
    EXPECT_EQ(error([](const Arguments& a) { a.gradient_old[5 * a.nblock] = 0; }), beyond("defgradOld"));
    EXPECT_EQ(error([](const Arguments& a) { a.stretch_old[-1] = 0; }), before("stretchOld"));
    EXPECT_EQ(error([](const Arguments& a) { a.spin[a.nblock] = 0; }), beyond("relSpinInc"));
    EXPECT_EQ(error([](const Arguments& a) { a.props[3] = 0; }), beyond("props"));
    EXPECT_EQ(error([](const Arguments& a) { a.dt[2 * a.nblock + 1] = 0; }), beyond("dt"));
    EXPECT_EQ(error([](const Arguments& a) { a.state_new[3 * a.nblock - 1] = 0; }), beyond("stateNew"));
    EXPECT_EQ(error([](const Arguments& a) { a.info[8 + a.nblock] = 0; }), beyond("jInfoArray"));
    EXPECT_EQ(error([](const Arguments& a) { a.info[-1] = 0; }), before("jInfoArray"));
    EXPECT_EQ(error([](const Arguments& a) { a.name_itself[80] = ' '; }), beyond("cmname"));
    EXPECT_EQ(error([](const Arguments& a) { a.name_itself[-1] = ' '; }), before("cmname"));
    // As if there were six components: nothing of this process is damaged, and it is told.
    EXPECT_EQ(error([](const Arguments& a) { std::fill_n(a.stress_new, 6 * a.nblock, 0.0); }),
              beyond("stressNew"));
  }
}

TEST(VumatCall, FindsWhatIsWrittenToInputs) {
  const auto input = [](const std::string& name) {
    return "material Sand-a: its subroutine wrote to " + name + ", which is an input";
  };
  const auto starts = [](const std::string& text, const std::string& start) {
    EXPECT_EQ(text.substr(0, start.size()), start);
  };
  starts(error_of([](const Arguments& a) { a.strain[0] += 1; }), input("strainInc"));
  starts(error_of([](const Arguments& a) { a.state_old[9] = 1; }), input("stateOld"));
  starts(error_of([](const Arguments& a) { a.stress_old[3] = -0.0; }), input("stressOld"));
  starts(error_of([](const Arguments& a) { a.gradient_new[24] = 1; }), input("defgradNew"));
  starts(error_of([](const Arguments& a) { a.temp_new[0] = 1; }), input("tempNew"));
  starts(error_of([](const Arguments& a) { a.density[4] = 1; }), input("density"));
  starts(error_of([](const Arguments& a) { a.props[1] = 0; }), input("props"));
  // One that starts late is found within about as many calls as the block has points; constants in each.
  int call = 0;
  starts(error_of([&](const Arguments& a) { a.strain[0] += ++call > 20; }, material(), 64, 66),
         input("strainInc"));
  EXPECT_EQ(call, 66);
  call = 0;
  starts(error_of([&](const Arguments& a) { a.props[1] += ++call > 20; }, material(), 5, 65), input("props"));
  EXPECT_EQ(call, 21);
  // One that may is given its inputs anew.
  auto allowed = material();
  allowed.may_write_inputs = true;
  double seen = -1;
  EXPECT_EQ(error_of(
                [&](const Arguments& a) {
                  seen = a.strain[0] + a.props[1] + a.gradient_old[0];
                  a.strain[0] = a.props[1] = a.gradient_old[0] = 77;
                },
                allowed, 5, 3),
            "");
  EXPECT_EQ(seen, 0 + 2 + 1);
}

TEST(VumatCall, GivesCopiesAndPresets) {
  int call = 0;
  EXPECT_EQ(error_of(
                [&](const Arguments& a) {
                  EXPECT_EQ(a.total_time, 0.75);
                  for (int i = 0; i <= 2 * a.nblock; ++i) EXPECT_EQ(a.dt[i], 1e-3);
                  a.dt[0] = 1.1; // as one VUMAT in the wild does
                  EXPECT_EQ(a.name, "SAND-A" + std::string(74, ' '));
                  EXPECT_EQ(a.name_length, 80);
                  for (int i = 0; i < a.nblock * a.nstatev; ++i) EXPECT_EQ(a.state_new[i], a.state_old[i]);
                  for (int i = 0; i < a.nblock; ++i) EXPECT_EQ(a.energy_new[i], a.energy_old[i]);
                  ++call;
                },
                material(), 5, 3),
            "");
  EXPECT_EQ(call, 3);
}

TEST(VumatCall, GivesElementNumbers) {
  auto m = material();
  VumatBlock block(m, 3, 1);
  std::vector<int> seen;
  action = [&](const Arguments& a) {
    seen.assign(a.info, a.info + 8 + a.nblock);
    std::fill_n(a.info, 8 + a.nblock, -1); // without effect on the next call
    std::fill_n(a.name_itself, 80, 'x');
  };
  call_vumat(m, {0.5, 0.75, 1e-3}, block);
  EXPECT_EQ(seen, (std::vector{0, 1, 1, 1, 0, 9, 0, 0, 1, 2, 3}));
  block.elements = {12, 7, 40};
  call_vumat(m, {0.5, 0.75, 1e-3}, block);
  EXPECT_EQ(seen, (std::vector{0, 1, 1, 1, 0, 9, 0, 0, 12, 7, 40}));
  EXPECT_EQ(point_call(m, {0.5, 0.75, 1e-3}, block, 1).block.elements, std::vector{7});
}

TEST(VumatCall, TellsWhyAnAnswerCannotBeUsed) {
  auto m = material();
  VumatBlock block(m, 4, 1);
  const auto fault = [&](auto what, int failure_state = -1) {
    action = what;
    call_vumat(m, {0.5, 0.75, 1e-3}, block);
    return fault_of(block, 2, failure_state);
  };
  EXPECT_EQ(fault([](const Arguments&) {}), "");
  EXPECT_EQ(fault([](const Arguments& a) { a.stress_new[14] = NAN; }),
            "returned a number that is not finite, component 4 of stressNew");
  EXPECT_EQ(fault([](const Arguments& a) { a.stress_new[2] = unwritten_word; }),
            "did not write component 1 of stressNew");
  EXPECT_EQ(fault([](const Arguments& a) { a.state_new[6] = -INFINITY; }),
            "returned a number that is not finite, variable 2 of stateNew");
  EXPECT_EQ(fault([](const Arguments& a) { a.energy_new[2] = NAN; }),
            "returned a number that is not finite, enerInternNew");
  EXPECT_EQ(fault([](const Arguments& a) { a.state_new[6] = -3; }, 1),
            "reported a failure, state variable 2 is -3");
  // What is read beyond an array is no number and spreads.
  EXPECT_EQ(fault([](const Arguments& a) { a.stress_new[2] += a.state_old[8]; }),
            "returned a number that is not finite, component 1 of stressNew, from words beyond an array");
  block.calls = 20; // inputs of this call are not compared
  EXPECT_EQ(fault([](const Arguments& a) { a.stress_old[2] = a.stress_new[2] = NAN; }),
            "wrote a number that is not finite to stressOld, which is an input");
}

TEST(VumatCall, TurnsWhatIsThrownIntoAnError) {
  EXPECT_EQ(error_of([](const Arguments&) { throw std::out_of_range("no such point"); }),
            "material Sand-a: its subroutine threw an exception at time 0.75 s: no such point");
  EXPECT_EQ(error_of([](const Arguments&) { throw 7; }),
            "material Sand-a: its subroutine threw an exception at time 0.75 s");
}

TEST(VumatCall, MessagesAreFilledIn) {
  const int integers[] = {3, -4};
  const double reals[] = {2.5, 1e-7};
  const char texts[] = "sand    gravel  ";
  EXPECT_EQ(substituted("%I of %i, %R and %R: %S, %S.", integers, reals, texts, 8),
            "3 of -4, 2.5 and 1e-07: sand, gravel.");
  EXPECT_EQ(substituted("100 % of %I %R", nullptr, reals, texts, 8), "100 % of %I 2.5");
  EXPECT_EQ(substituted("%", integers, reals, texts, 8), "%");
}

} // namespace
