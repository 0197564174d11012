// SPDX-License-Identifier: BSD-3-Clause
// Finds curves that no test on sand can have given: swapped columns, wrong units, dead sensors.
#include "calibration/test_file.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <stdexcept>

namespace calibration {
namespace {

struct Checks {
  const RawCurves& raw;
  const Specimen& specimen;
  const std::string& where;

  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(fmt::format("{}: {}", where, what));
  }
  const std::vector<double>* given(Measure m) const {
    const auto& values = raw.given[std::size_t(m)];
    return values ? &*values : nullptr;
  }
  bool shears() const { return !specimen.kind->holds("radial_strain"); }

  void strains() const {
    if (raw.strain.size() < 2) fail("fewer than two rows");
    const double end = std::abs(raw.strain.back());
    if (end == 0) fail("the axial strain is 0 throughout");
    if (end > 1)
      fail(fmt::format("the axial strain ends at {:.3g}, more than 100 %: check its column and unit",
                       raw.strain.back()));
    if (end < 1e-5)
      fail(fmt::format("the axial strain ends at {:.3g}: check its column and unit", raw.strain.back()));
    if (const auto* volume = given(Measure::volumetric_strain))
      for (std::size_t i = 0; i < volume->size(); ++i) {
        const double v = (*volume)[i];
        if (std::abs(v) > 0.5)
          fail(fmt::format("a volumetric strain of {:.3g}: check its column and unit", v));
        // Dilatancy angles end near 30 degrees: volume does not grow faster than about twice the axial strain.
        if (-v > 3 * std::abs(raw.strain[i]) + 0.01 && shears())
          fail(fmt::format(
              "at an axial strain of {:.3g} the volume has grown by {:.3g}: check columns and units",
              raw.strain[i], -v));
      }
  }

  /// Range of q/p, where it follows from the columns.
  void stress_ratios() const {
    const auto *q = given(Measure::deviatoric_stress), *p = given(Measure::mean_stress),
               *ratio = given(Measure::stress_ratio), *axial = given(Measure::axial_stress),
               *radial = given(Measure::radial_stress);
    if (specimen.kind->holds("radial_strain")) return;
    double most = 0, least = 0;
    bool known = false;
    for (std::size_t i = 0; i < raw.strain.size(); ++i) {
      double eta = 0;
      const double cell = specimen.radial_stress;
      if (ratio)
        eta = (*ratio)[i];
      else if (q && p)
        eta = (*q)[i] / (*p)[i];
      else if (axial && radial)
        eta = 3 * ((*axial)[i] - (*radial)[i]) / ((*axial)[i] + 2 * (*radial)[i]);
      else if (axial && specimen.kind->holds("radial_stress"))
        eta = 3 * ((*axial)[i] - cell) / ((*axial)[i] + 2 * cell);
      else if (q && specimen.kind->holds("radial_stress"))
        eta = (*q)[i] / (cell + (*q)[i] / 3);
      else if (q && specimen.kind->holds("mean_stress"))
        eta = (*q)[i] / specimen.mean_stress();
      else
        return;
      known = true;
      most = std::max(most, eta);
      least = std::min(least, eta);
      if (!std::isfinite(eta)) fail("the mean stress is 0 in a row");
    }
    // At 3 and -1.5 a principal stress is 0. A friction angle of 70 degrees in compression: 2.74.
    if (known && (most > 2.75 || least < -1.45))
      fail(fmt::format("a stress ratio q/p of {:.3g} is beyond any friction angle: check the columns, the "
                       "units of stress and "
                       "the confining stress of {:g} Pa",
                       most > 2.75 ? most : least, specimen.radial_stress));
    if (known && std::max(most, -least) < 0.05)
      fail(fmt::format(
          "the stress ratio q/p does not exceed {:.2g}: check the columns, the units of stress and the "
          "confining stress of {:g} Pa",
          std::max(most, -least), specimen.radial_stress));
  }

  /// Whether stresses begin near the declared ones.
  void declared_stress() const {
    const auto compare = [&](Measure m, double declared, bool held) {
      const auto* values = given(m);
      if (!values) return;
      const double first = values->front();
      const double allowed =
          held ? 0.2 : 2; // relative; the first row of a stiff sand may be far from the start
      if (!(first > declared * (1 - std::min(allowed, 0.8)) && first < declared * (1 + allowed)))
        fail(fmt::format("{} begins at {:.4g} Pa where {:.4g} Pa is declared: check units and stress",
                         info(m).key, first, declared));
    };
    compare(Measure::mean_stress, specimen.mean_stress(), specimen.kind->holds("mean_stress"));
    compare(Measure::radial_stress, specimen.radial_stress, specimen.kind->holds("radial_stress"));
    compare(Measure::axial_stress, specimen.axial_stress, false);
    // In a drained test dq = 3 dp.
    const auto *q = given(Measure::deviatoric_stress), *p = given(Measure::mean_stress);
    if (q && p && specimen.kind->holds("radial_stress"))
      for (std::size_t i = 0; i < q->size(); ++i)
        if (const double cell = (*p)[i] - (*q)[i] / 3; std::abs(cell / specimen.radial_stress - 1) > 0.2)
          fail(fmt::format("p - q/3 is {:.4g} Pa where a confining stress of {:.4g} Pa is declared: check "
                           "units and columns",
                           cell, specimen.radial_stress));
    if (const auto* u = given(Measure::pore_pressure))
      for (double v : *u)
        if (v > specimen.radial_stress * 1.05)
          fail(fmt::format(
              "a pore pressure of {:.4g} Pa exceeds the confining stress of {:.4g} Pa: check units", v,
              specimen.radial_stress));
  }

  void void_ratios() const {
    const auto* e = given(Measure::void_ratio);
    if (!e) return;
    for (double v : *e)
      if (!(v > 0.1 && v < 1.9))
        fail(fmt::format("a void ratio of {:.3g} is impossible for sand: is it a porosity, or in per cent?",
                         v));
    if (std::abs(e->front() - specimen.void_ratio) > 0.02 + 0.5 * std::abs(raw.strain.front()))
      fail(fmt::format("the void ratio begins at {:.4g} where {:.4g} is declared", e->front(),
                       specimen.void_ratio));
    if (const auto* volume = given(Measure::volumetric_strain))
      for (std::size_t i = 0; i < e->size(); ++i)
        if (const double follows = (1 + specimen.void_ratio) * std::exp(-(*volume)[i]) - 1;
            std::abs(follows - (*e)[i]) > 0.03)
          fail(fmt::format(
              "a volumetric strain of {:.3g} means a void ratio of {:.3f}, the curve has {:.3f}: check its "
              "sign and unit",
              (*volume)[i], follows, (*e)[i]));
  }

  void constant(const std::vector<Curve>& compared) const {
    for (const auto& curve : compared) {
      const auto [low, high] = std::minmax_element(curve.values.begin(), curve.values.end());
      const bool held =
          (curve.measure == Measure::radial_stress && specimen.kind->holds("radial_stress")) ||
          (curve.measure == Measure::mean_stress && specimen.kind->holds("mean_stress")) ||
          ((curve.measure == Measure::volumetric_strain || curve.measure == Measure::void_ratio) &&
           specimen.kind->holds("volumetric_strain"));
      if (held)
        fail(fmt::format("{} is held constant in this kind of test: it cannot be compared",
                         info(curve.measure).key));
      if (*high - *low <= 1e-3 * std::max(std::abs(*high), std::abs(*low)) || *high == *low)
        fail(fmt::format("{} is constant, {:.4g}, over the whole test: a dead sensor, or the wrong column",
                         info(curve.measure).key, *low));
    }
  }
};

} // namespace

void check_plausible(const RawCurves& raw, const Specimen& specimen, const std::vector<Curve>& compared,
                     const std::string& where) {
  const Checks checks{raw, specimen, where};
  checks.strains();
  checks.constant(compared);
  checks.stress_ratios();
  checks.declared_stress();
  checks.void_ratios();
}

} // namespace calibration
