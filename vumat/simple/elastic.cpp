// SPDX-License-Identifier: BSD-3-Clause
// Isotropic linear elasticity as a VUMAT. PROPS: 1 Young's modulus, Pa; 2 Poisson's ratio. No state variables. A
// property that makes no sense gives a stress that is not a number.
#include "vumat/abi.hpp"
#include <algorithm>
#include <limits>

#ifdef SIMSAND_SINGLE
using Real = float;
#else
using Real = double;
#endif

extern "C" __attribute__((visibility("default"))) void
vumat_(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int* /*nfieldv*/,
       const int* nprops, const int* /*lanneal*/, const Real* /*stepTime*/, const Real* /*totalTime*/,
       const Real* /*dt*/, const char* /*cmname*/, const Real* /*coordMp*/, const Real* /*charLength*/,
       const Real* props, const Real* density, const Real* strainInc, const Real* /*relSpinInc*/,
       const Real* /*tempOld*/, const Real* /*stretchOld*/, const Real* /*defgradOld*/,
       const Real* /*fieldOld*/, const Real* stressOld, const Real* stateOld, const Real* enerInternOld,
       const Real* enerInelasOld, const Real* /*tempNew*/, const Real* /*stretchNew*/,
       const Real* /*defgradNew*/, const Real* /*fieldNew*/, Real* stressNew, Real* stateNew,
       Real* enerInternNew, Real* enerInelasNew, std::size_t /*cmname_length*/) noexcept {
  const std::size_t n = *nblock, components = *ndir + *nshr;
  std::copy_n(stateOld, n * *nstatev, stateNew);
  std::copy_n(enerInternOld, n, enerInternNew);
  std::copy_n(enerInelasOld, n, enerInelasNew);
  const bool sound = *nprops >= 2 && props[0] > 0 && props[1] > -1 && props[1] < Real(0.5);
  if (!sound) return void(std::fill_n(stressNew, n * components, std::numeric_limits<Real>::quiet_NaN()));

  const Real twice_shear = props[0] / (1 + props[1]);
  const Real lambda = twice_shear * props[1] / (1 - 2 * props[1]);
  for (std::size_t c = 0; c < components; ++c)
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = c * n + k;
      const Real volumetric = strainInc[k] + strainInc[n + k] + strainInc[2 * n + k];
      stressNew[i] = stressOld[i] + twice_shear * strainInc[i] + (c < 3 ? lambda * volumetric : 0);
      const Real work = (c < 3 ? 1 : 2) * (stressOld[i] + stressNew[i]) / 2 * strainInc[i];
      enerInternNew[k] += work / density[k];
    }
}
