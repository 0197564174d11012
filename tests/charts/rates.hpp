// SPDX-License-Identifier: BSD-3-Clause
// SIMSAND in rates: gradients of the yield function, the multiplier from consistency, rates of stress and state.
// Functions and equation numbers: vumat/EQUATIONS.md.
#pragma once
#include "tests/charts/sand.hpp"

namespace charts {

/// What the rate equations see of a state at positive mean stress.
struct Local {
  double p, q, K, G;
  double f;               ///< yield function (8)
  double dilatancy;       ///< (9), on the yield surface
  double f_p, f_e;        ///< df/dp at constant s, df/de
  double hardening;       ///< -df/d eps_d
  double void_per_strain; ///< 1 + e
  Tensor direction;       ///< s/q; where q vanishes, that of `deviator_hint`
  Tensor f_s;             ///< deviatoric part of df/d sigma
};

/// `deviator_hint`: deviator of the strain increment, the direction that shear takes from isotropic stress.
Local local(const Material& m, const Point& point, const Tensor& deviator_hint);

/// Rates of a state per unit of the parameter that the strain grows with.
struct Rate {
  Tensor stress;
  double e, eps_d;
};

/// df along an elastic strain: positive from the yield surface means plastic loading.
double elastic_growth(const Local& at, const Tensor& strain);
/// df per multiplier that the consistency condition divides by; positive in all that the model allows.
double consistency(const Local& at);
Rate elastic_rate(const Local& at, const Tensor& strain);
Rate plastic_rate(const Local& at, const Tensor& strain);

/// The state after `h` of a rate.
Point moved(const Point& from, double h, const Rate& rate);

/// Yield function (8) and mean stress of a point; f = 0 where p is not positive.
double yield_of(const Material& m, const Point& point);

} // namespace charts
