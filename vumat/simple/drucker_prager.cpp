// SPDX-License-Identifier: BSD-3-Clause
// Linear elasticity with the Drucker-Prager yield condition, without cohesion or hardening, as a VUMAT: the
// least a collapsing column needs, to compare SIMSAND with. Equations and limits: README.md.
//
// PROPS: 1 Young's modulus, Pa; 2 Poisson's ratio; 3 friction angle, degrees; 4 dilation angle, degrees;
//        5 cone: 0 through the compression corners of Mohr-Coulomb, 1 matched in plane strain.
// STATEV: 1 separation strain, 2 plastic deviatoric strain, 3 status: 0 elastic, 1 plastic, 2 stress free,
//         -1 shape of the block not supported, -100 - i PROPS(i) refused (the stress is then NaN).
#include "vumat/abi.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace {

enum Property { young, poisson, friction, dilation, cone, property_count };
enum State { separation_strain, plastic_strain, status, state_count };

/// Slope q/p of a cone with this Mohr-Coulomb angle (degrees).
template <class Real> Real slope(Real angle, bool plane_strain) {
  const Real radians = angle * Real(M_PI / 180), sine = std::sin(radians), tangent = std::tan(radians);
  return plane_strain ? 3 * std::sqrt(Real(3)) * tangent / std::sqrt(9 + 12 * tangent * tangent)
                      : 6 * sine / (3 - sine);
}

/// Number, from 1, of the first property that makes no sense; 0: all do.
template <class Real> int refused(const Real* props, int count) {
  if (count < property_count) return count + 1;
  if (!(props[young] > 0)) return young + 1;
  if (!(props[poisson] >= 0 && props[poisson] < Real(0.5))) return poisson + 1;
  if (!(props[friction] > 0 && props[friction] < 90)) return friction + 1;
  if (!(props[dilation] >= 0 && props[dilation] <= props[friction])) return dilation + 1;
  if (!(props[cone] == 0 || props[cone] == 1)) return cone + 1;
  return 0;
}

template <class Real> struct Constants {
  Real bulk, shear, strength, dilatancy; ///< K, G, Pa; M = q/p at yield; D = - d eps_v^p / d eps_d^p
  explicit Constants(const Real* props)
      : bulk(props[young] / (3 * (1 - 2 * props[poisson]))), shear(props[young] / (2 * (1 + props[poisson]))),
        strength(slope(props[friction], props[cone] == 1)),
        dilatancy(slope(props[dilation], props[cone] == 1)) {}
};

template <class Real> struct Arrays {
  int points;
  bool data_check;
  const Real *density, *strain, *stress_old, *state_old, *internal_old, *inelastic_old;
  Real *stress_new, *state_new, *internal_new, *inelastic_new;
};

/// Sum of a_i b_i over all nine components of symmetric tensors with N stored.
template <int N, class Real> Real contract(const Real (&a)[N], const Real (&b)[N]) {
  Real sum = 0;
  for (int c = 0; c < N; ++c) sum += (c < 3 ? 1 : 2) * a[c] * b[c];
  return sum;
}

/// One point, compression positive inside; `elastic`: the answer of a data check. Selections of numbers only,
/// no branches, so that the compiler runs points side by side.
template <int N, bool elastic, class Real>
inline void update(const Constants<Real> m, const Arrays<Real> a, int k) {
  const int n = a.points;
  const auto at = [=](int c) { return c * n + k; };
  Real strain[N], deviator[N], mean_stress[N];
  for (int c = 0; c < N; ++c) strain[c] = -a.strain[at(c)];
  const Real volumetric = strain[0] + strain[1] + strain[2];

  // An open gap takes the strain first; only what is left after it has closed loads the grains, and stress
  // that arrives beside a gap is not used.
  const Real gap = a.state_old[at(separation_strain)];
  const Real after_closing = volumetric > gap ? 1 - gap / volumetric : Real(0);
  const Real loading = gap > 0 ? after_closing : Real(1);
  const Real carried = gap > 0 ? Real(0) : Real(1);
  const Real old_p = -(a.stress_old[at(0)] + a.stress_old[at(1)] + a.stress_old[at(2)]) / 3;
  const Real trial_p = carried * old_p + m.bulk * loading * volumetric;
  for (int c = 0; c < N; ++c) {
    const Real old = -a.stress_old[at(c)] - (c < 3 ? old_p : 0);
    deviator[c] = carried * old + 2 * m.shear * loading * (strain[c] - (c < 3 ? volumetric / 3 : 0));
  }
  const Real trial_q = std::sqrt(Real(1.5) * contract<N>(deviator, deviator));

  // On the cone q_trial - 3 G x = M (p_trial + K D x). Where that p is not positive the point has parted: the
  // grains unload to zero and the rest of the extension, less what shear would have dilated, opens a gap.
  const Real excess = trial_q - m.strength * trial_p;
  const Real on_cone = excess / (3 * m.shear + m.strength * m.bulk * m.dilatancy);
  const Real length = elastic ? Real(0) : excess > 0 ? on_cone : Real(0);
  const Real cone_p = trial_p + m.bulk * m.dilatancy * length;
  const Real cone_q = trial_q - 3 * m.shear * length;
  const Real whole = elastic ? Real(1) : cone_p > 0 ? Real(1) : Real(0); // 0: stress free
  const Real p = whole * cone_p, x = whole * length;
  const Real scale = trial_q > 0 ? whole * cone_q / trial_q : Real(0);
  const Real opened = -(trial_p / m.bulk + m.dilatancy * trial_q / (3 * m.shear));
  const Real new_gap = loading > 0 ? (opened > 0 ? opened : Real(0)) : gap - volumetric;

  for (int c = 0; c < N; ++c) {
    const Real stress = scale * deviator[c] + (c < 3 ? p : 0);
    a.stress_new[at(c)] = 0 - stress;
    mean_stress[c] = (stress - a.stress_old[at(c)]) / 2;
  }
  if (elastic) return;
  a.state_new[at(separation_strain)] = (1 - whole) * new_gap;
  a.state_new[at(plastic_strain)] = a.state_old[at(plastic_strain)] + x;
  a.state_new[at(status)] = whole > 0 ? (x > 0 ? Real(1) : Real(0)) : Real(2);
  const Real volume = 1 / a.density[k];
  a.internal_new[k] = a.internal_old[k] + contract<N>(mean_stress, strain) * volume;
  a.inelastic_new[k] = a.inelastic_old[k] + (m.strength - m.dilatancy) * p * x * volume;
}

template <int N, class Real> void run(const Constants<Real>& m, const Arrays<Real>& a) {
  if (a.data_check) {
#pragma GCC ivdep
    for (int k = 0; k < a.points; ++k) update<N, true>(m, a, k);
  } else {
#pragma GCC ivdep
    for (int k = 0; k < a.points; ++k) update<N, false>(m, a, k);
  }
}

template <class Real> void fail(const Arrays<Real>& a, int components, int states, Real code) {
  const std::size_t n = a.points;
  std::fill_n(a.stress_new, n * components, std::numeric_limits<Real>::quiet_NaN());
  if (states > status) std::fill_n(a.state_new + n * status, n, code);
}

} // namespace

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
  const bool data_check = *stepTime == 0 && *totalTime == 0;
  const Arrays<Real> arrays{*nblock,       data_check,    density,   strainInc, stressOld,     stateOld,
                            enerInternOld, enerInelasOld, stressNew, stateNew,  enerInternNew, enerInelasNew};
  const std::size_t n = *nblock;
  std::copy_n(stateOld, n * *nstatev, stateNew);
  std::copy_n(enerInternOld, n, enerInternNew);
  std::copy_n(enerInelasOld, n, enerInelasNew);
  const bool supported = *ndir == 3 && (*nshr == 1 || *nshr == 3) && *nstatev >= state_count;
  const int property = refused(props, *nprops);
  if (!supported || property)
    return fail(arrays, *ndir + *nshr, *nstatev, Real(supported ? -100 - property : -1));
  if (*lanneal == 1) { // keeps the stress, forgets the plastic strain
    std::copy_n(stressOld, n * (*ndir + *nshr), stressNew);
    std::fill_n(stateNew + n * plastic_strain, n, Real(0));
    return;
  }
  const Constants<Real> constants(props);
  if (*nshr == 1)
    run<4>(constants, arrays);
  else
    run<6>(constants, arrays);
}
