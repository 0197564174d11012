// SPDX-License-Identifier: BSD-3-Clause
// SIMSAND in single precision for hosts in double precision: a `vumat_` of doubles that rounds what it is given, calls
// libsimsand_vumat_sp.so beside it, and widens the answer. To see what single precision does to a result; the copies
// cost more than they save.
#include "vumat/abi.hpp"
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <string>
#include <vector>

namespace {

/// The subroutine of the library in this one's folder. Without it there is nothing to answer: the program ends.
vumat::Subroutine<float>* single_precision() {
  Dl_info here{};
  dladdr(reinterpret_cast<void*>(&single_precision), &here);
  const std::string file(here.dli_fname);
  const auto beside = file.substr(0, file.rfind('/') + 1) + "libsimsand_vumat_sp.so";
  void* library = dlopen(beside.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* found = library ? dlsym(library, "vumat_") : nullptr;
  if (!found) {
    std::fprintf(stderr, "%s: %s\n", beside.c_str(), dlerror());
    std::exit(1);
  }
  return reinterpret_cast<vumat::Subroutine<float>*>(found);
}

/// The numbers of one array in single precision.
struct Rounded {
  Rounded(const double* from, int count) : values(from, from + count) {}
  explicit Rounded(int count) : values(std::size_t(count)) {}
  void widen(double* to) const { std::copy(values.begin(), values.end(), to); }
  std::vector<float> values;
};

} // namespace

extern "C" __attribute__((visibility("default"))) void
vumat_(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* nfieldv,
       const int* nprops, const int* lanneal, const double* stepTime, const double* totalTime,
       const double* dt, const char* cmname, const double*, const double* charLength, const double* props,
       const double* density, const double* strainInc, const double*, const double*, const double*,
       const double*, const double*, const double* stressOld, const double* stateOld,
       const double* enerInternOld, const double* enerInelasOld, const double*, const double*, const double*,
       const double*, double* stressNew, double* stateNew, double* enerInternNew, double* enerInelasNew,
       std::size_t name_length) {
  static const auto call = single_precision();
  const int n = *nblock, tensor = n * (*ndir + *nshr), states = n * *nstatev;
  const float step_time = float(*stepTime), total_time = float(*totalTime), step = float(*dt);
  const Rounded length(charLength, n), constants(props, *nprops), mass(density, n), strain(strainInc, tensor),
      stress(stressOld, tensor), state(stateOld, states), energy(enerInternOld, n), lost(enerInelasOld, n);
  Rounded stress_new(tensor), state_new(states), energy_new(n), lost_new(n);
  call(nblock, ndir, nshr, nstatev, nfieldv, nprops, lanneal, &step_time, &total_time, &step, cmname, nullptr,
       length.values.data(), constants.values.data(), mass.values.data(), strain.values.data(), nullptr,
       nullptr, nullptr, nullptr, nullptr, stress.values.data(), state.values.data(), energy.values.data(),
       lost.values.data(), nullptr, nullptr, nullptr, nullptr, stress_new.values.data(),
       state_new.values.data(), energy_new.values.data(), lost_new.values.data(), name_length);
  stress_new.widen(stressNew);
  state_new.widen(stateNew);
  energy_new.widen(enerInternNew);
  lost_new.widen(enerInelasNew);
}
