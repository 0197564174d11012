// SPDX-License-Identifier: BSD-3-Clause
// Increments per second of processor time of a drained triaxial test through the element driver, the calls
// and points of the VUMAT it makes per increment, and the part of the time that is the VUMAT's own. Nothing is
// written. Medians over the turns. Usage: element_rate
#include "drivers/element/element.hpp"
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <fmt/format.h>

namespace {

using namespace drivers;

/// Processor time of this thread, s.
double seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

constexpr int repetitions = 5, turns = 15;
vumat::Subroutine<double>* own = nullptr;
long calls = 0, points = 0;

/// The subroutine called again and again with the same arguments: what that adds is its own time.
template <class... Arguments> void repeated(const int* nblock, Arguments... rest) {
  for (int i = 0; i <= repetitions; ++i) own(nblock, rest...);
  ++calls;
  points += *nblock;
}

template <class... Arguments> auto repeated_like(void (*)(const int*, Arguments...)) {
  return &repeated<Arguments...>;
}

struct Rate {
  double all, vumat;    ///< s per increment
  double calls, points; ///< per increment
};

Rate measured(const std::string& text) {
  auto element = read_element_case(parse_toml(text, "path.toml", SIMSAND_SOURCE_DIR "/data/paths"));
  const double increments = double(element.stages.back().increments);
  auto& call = element.material.material.library.call;
  const auto run = [&] {
    const double start = seconds();
    run_element_case(element, [](const ElementRow&) {});
    return (seconds() - start) / increments;
  };
  std::vector<double> all, vumat;
  own = call;
  for (int turn = 0; turn < turns; ++turn) {
    call = own;
    all.push_back(run());
    call = repeated_like(own);
    calls = points = 0;
    vumat.push_back((run() - all.back()) / repetitions);
  }
  const auto median = [](std::vector<double>& v) {
    std::sort(v.begin(), v.end());
    return v[v.size() / 2];
  };
  return {median(all), median(vumat), double(calls) / increments, double(points) / increments};
}

} // namespace

int main() {
  for (const char* increment : {"1e-5", "1e-4", "1e-3"}) {
    const auto r =
        measured(fmt::format("[material]\nfile = '../materials/TS.toml'\n[initial]\nmean_stress = 10e3\n"
                             "void_ratio = 0.44\n[[stage]]\ncontrol = 'triaxial-drained'\n"
                             "axial_strain = 0.4\nstrain_increment = {}\noutput_every = 1000000\n",
                             increment));
    fmt::print(
        "{}: {:.0f} increments/s, {:.2f} us each, {:.2f} us of it the VUMAT's own; {:.2f} calls and {:.2f} "
        "points per increment\n",
        increment, 1 / r.all, 1e6 * r.all, 1e6 * r.vumat, r.calls, r.points);
  }
}
