// SPDX-License-Identifier: BSD-3-Clause
// The VUMAT: which task, which properties, which block, and no physics. Arguments: abi.hpp.
// Failure is never silent: STATEV(4) is negative (simsand.hpp, Status) and the stress is NaN.
#include "vumat/abi.hpp"
#include "vumat/rounds.hpp"

namespace simsand {
namespace {

template <class T, int N> void run_points(const Material<T>& m, const Block<T>& b, Task task) {
  if (task == Task::increment) return run_increments<T, N>(m, b);
  for (int k = 0; k < b.points; ++k) run_point<T, N>(m, b, task, k);
}

template <class T>
void run(const Block<T>& b, int direct, int shear, const T* props, int prop_count, Task task) noexcept {
  keep_old(b);
  Parameters<T> parameters;
  const PropsError refused = read_props(props, prop_count, parameters);
  const bool supported =
      direct == 3 && (shear == 1 || shear == 3) && b.state_count >= int(state_variables.size());
  if (!supported || refused.entry) {
    const int code = supported ? int(Status::bad_property) - refused.entry : int(Status::unsupported);
    for (int k = 0; k < b.points; ++k) fail(b, direct + shear, k, code);
    return;
  }
  const Material<T> material(parameters);
  if (shear == 1)
    run_points<T, 4>(material, b, task);
  else
    run_points<T, 6>(material, b, task);
}

} // namespace
} // namespace simsand

// One library for each precision of the host: a host of the other corrupts its memory.
#ifdef SIMSAND_SINGLE
using Real = float;
#else
using Real = double;
#endif

extern "C" __attribute__((visibility("default"))) void
vumat_(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* /*nfieldv*/,
       const int* nprops, const int* lanneal, const Real* stepTime, const Real* totalTime, const Real* /*dt*/,
       const char* /*cmname*/, const Real* /*coordMp*/, const Real* /*charLength*/, const Real* props,
       const Real* density, const Real* strainInc, const Real* /*relSpinInc*/, const Real* /*tempOld*/,
       const Real* /*stretchOld*/, const Real* /*defgradOld*/, const Real* /*fieldOld*/,
       const Real* stressOld, const Real* stateOld, const Real* enerInternOld, const Real* enerInelasOld,
       const Real* /*tempNew*/, const Real* /*stretchNew*/, const Real* /*defgradNew*/,
       const Real* /*fieldNew*/, Real* stressNew, Real* stateNew, Real* enerInternNew, Real* enerInelasNew,
       std::size_t /*cmname_length*/) noexcept {
  using namespace simsand;
  // lanneal may be an array since 2023: its first entry means the same.
  const Task task = *lanneal == 1                         ? Task::annealing
                    : (*stepTime == 0 && *totalTime == 0) ? Task::data_check
                                                          : Task::increment;
  const Block<Real> block{*nblock,       *nstatev,      density,   strainInc, stressOld,     stateOld,
                          enerInternOld, enerInelasOld, stressNew, stateNew,  enerInternNew, enerInelasNew};
  run(block, *ndir, *nshr, props, *nprops, task);
}
