// SPDX-License-Identifier: BSD-3-Clause
// The counter-case of the material: SIMSAND's equations with one of two faults that look harmless.
#pragma once
#include "tests/charts/elastic.hpp"
#include "vumat/abi.hpp"

namespace stability {

struct Faults {
  bool trial_dilatancy = false; ///< (9) with the q/p of the elastic trial, which has no bound as p goes to 0
  bool no_gap = false;          ///< the strain that parts the grains is forgotten
};
/// A VUMAT is a plain function, so which faults it has is global.
inline Faults faults;

/// The product's update with the faults put in: a plastic point takes the dilation that the trial's q/p has beyond that
/// of the yield surface; a gap is not kept.
inline charts::Point naive_update(const charts::Material& m, charts::Point old,
                                  const charts::Tensor& strain) {
  if (faults.no_gap) old.separation_strain = 0;
  auto end = simsand::update(m, old, strain).state;
  if (faults.no_gap) end.separation_strain = 0;
  const double multiplier = end.plastic_strain - old.plastic_strain;
  const auto trial = charts::elastic_answer(m, old, strain).point;
  const double p = charts::mean(end.stress), p_trial = charts::mean(trial.stress);
  if (!faults.trial_dilatancy || multiplier <= 0 || !(p_trial > 0)) return end;
  const auto at = charts::local(m, trial, strain);
  const double excess = at.f / at.p; // q/p beyond the yield surface
  if (!(excess > 0)) return end;
  const double pumped = p + at.K * m.given.A_d * excess * multiplier;
  end.stress = p > 0 ? simsand::scale(pumped / p, end.stress) : simsand::add_mean(charts::Tensor{}, pumped);
  end.separation_strain = 0;
  return end;
}

inline void naive_vumat(const int* nblock, const int* ndir, const int* nshr, const int* nstatev, const int*,
                        const int* nprops, const int*, const double*, const double* totalTime, const double*,
                        const char*, const double*, const double*, const double* props, const double*,
                        const double* strainInc, const double*, const double*, const double*, const double*,
                        const double*, const double* stressOld, const double* stateOld,
                        const double* enerInternOld, const double* enerInelasOld, const double*,
                        const double*, const double*, const double*, double* stressNew, double* stateNew,
                        double* enerInternNew, double* enerInelasNew, std::size_t) {
  namespace statev = simsand::statev;
  const int n = *nblock, components = *ndir + *nshr;
  const auto m = charts::material_of({props, props + *nprops});
  std::copy_n(stateOld, n * *nstatev, stateNew);
  std::copy_n(enerInternOld, n, enerInternNew);
  std::copy_n(enerInelasOld, n, enerInelasNew);
  for (int k = 0; k < n; ++k) {
    charts::Point point;
    charts::Tensor strain{};
    for (int c = 0; c < components; ++c) {
      point.stress[c] = -stressOld[c * n + k];
      strain[c] = -strainInc[c * n + k];
    }
    const double e = stateOld[statev::void_ratio * n + k];
    point.void_ratio = e == 0 ? m.given.e0 : e;
    point.plastic_strain = stateOld[statev::plastic_deviatoric_strain * n + k];
    point.separation_strain = stateOld[statev::separation_strain * n + k];
    if (e == 0) { // as the product does: inside of its yield surface from the start
      const auto start = simsand::initial_state(m, point.stress, point.void_ratio);
      point.plastic_strain = start.plastic_strain;
    }
    const auto end =
        *totalTime == 0 ? charts::elastic_answer(m, point, strain).point : naive_update(m, point, strain);
    for (int c = 0; c < components; ++c) stressNew[c * n + k] = -end.stress[c];
    stateNew[statev::void_ratio * n + k] = end.void_ratio;
    stateNew[statev::plastic_deviatoric_strain * n + k] = end.plastic_strain;
    stateNew[statev::separation_strain * n + k] = faults.no_gap ? 0 : end.separation_strain;
  }
}

} // namespace stability
