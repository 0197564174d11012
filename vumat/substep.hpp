// SPDX-License-Identifier: BSD-3-Clause
// What one substep of the update computes, and groups of registers that go through its parts together.
#pragma once
#include "vumat/integrals.hpp"
#include "vumat/state.hpp"

namespace simsand {

/// Points whose increments are under way, each in its own substeps. Truths are 0 or 1.
template <class Real, int N> struct IncrementProgress {
  SoilState<Real, N> state;
  SymmetricTensor<Real, N> strain; ///< of the whole increment
  Real applied, substep;           ///< shares of the increment: behind, and to be tried next
  Real dissipation, status, nonconvex;
};

/// Invariants of the state at the start of a substep and of its strain, which do not change while the mean stress at
/// its end is sought.
template <class Real> struct SubstepInvariants {
  Pressure<Real> start;
  Real e_start, e_end;
  Real volumetric;               ///< total volumetric strain
  Real bulk_factor;              ///< K0 times the mean of g(e): dy per elastic volumetric strain
  Real eps_d, inverse_start;     ///< eps_d and 1 / (k_p + eps_d) at the start
  Real q_start;                  ///< of the deviator at the start
  Real stress_work, strain_norm; ///< s:de and de:de of the deviators
  Real sin3theta;                ///< of the deviator at the end
  Slopes<Real> slopes_start;
};

template <class Real, int N> struct ElasticTrial {
  SymmetricTensor<Real, N> s_old, s_trial, e_dev; ///< deviators
  Real measure;                                   ///< y, not bounded
  Pressure<Real> pressure;
  Real critical, log_state_ratio; ///< e_c, ln (e_c / e)
  Real tangent, peak;             ///< of the peak friction angle; M_p
  Real q, shear_modulus;
  Real f;                ///< of (8)
  Mask<Real> is_elastic; ///< the trial is the end
};

/// The deviator that plastic flow leads to.
template <class Real, int N> struct FlowDirection {
  SymmetricTensor<Real, N> deviator;
  Real q, turn;      ///< invariant of `deviator`; 2 (1 - cos psi)
  Real f_start;      ///< (8) at the start; positive: the host has put the stress beyond the yield surface
  Real elastic_part; ///< of the trial, before the yield surface
};

/// A mean stress at the end of the substep, and all that follows from it.
template <class Real> struct EndCandidate {
  Pressure<Real> pressure;
  Slopes<Real> slopes;
  Real shear_modulus; ///< mean over the substep
  Real q_trial;
  Real multiplier;         ///< x
  Real inverse;            ///< 1 / (k_p + eps_d)
  Real mobilised;          ///< h at the end
  Real mean_mobilised;     ///< mean of h
  Real plastic_volumetric; ///< multiplier times mean dilatancy
  Real residual;           ///< of (16)
};

template <class Real, int N> struct SubstepEnd {
  SoilState<Real, N> state;
  Real dissipation, error;
  Mask<Real> plastic, nonconvex;
};

/// The points of one register, and what a substep of theirs computes.
template <class Real, int N> struct SubstepWorkspace : IncrementProgress<Real, N> {
  SubstepInvariants<Real> in;
  ElasticTrial<Real, N> trial;
  FlowDirection<Real, N> flow;
  Real critical, log_state_ratio; ///< e_c, ln (e_c / e)
  EndCandidate<Real> full, end;   ///< with all functions evaluated; a step of Newton's rule from there
  Real measure_step, measure;
  Mask<Real> excluded, solved; ///< no plastic substep: elastic or for the rescue; (16) holds
};

/// A group of one point alone.
template <class T, int N> struct OnePoint {
  SubstepWorkspace<T, N>& point;
  template <class F> void each(const F& part) const { part(point); }
};

/// Points that go through rounds of substeps together. No block that a host passes is longer than a few of these.
inline constexpr int points_of_pass = 128;

/// Registers that go through the parts of a substep together: every part runs over all of them before the next part
/// does. The chain of dependent operations of one part is short enough for the processor to work on several registers at
/// once. One part holds one long function, a logarithm or an exponential, at most.
template <class Real, int N> struct RegisterGroup {
  using Workspace = SubstepWorkspace<Real, N>;
  int count = 0;
  Workspace* registers[points_of_pass / lanes_of<Real>];

  void add(Workspace& w) { registers[count++] = &w; }
  template <class F> void each(const F& part) const {
    for (int i = 0; i < count; ++i) part(*registers[i]);
  }
  /// Those with a lane for which the mask does not hold.
  RegisterGroup remaining(Mask<Real> Workspace::*mask) const {
    RegisterGroup out;
    each([&](auto& w) {
      out.registers[out.count] = &w;
      out.count += !all(w.*mask);
    });
    return out;
  }
};

} // namespace simsand
