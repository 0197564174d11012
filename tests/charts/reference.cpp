// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/reference.hpp"

namespace charts {
namespace {

/// Distance of f from 0, by p, at which a point is taken to be on the yield surface.
constexpr double on_surface = 1e-9;

/// Coefficients of Dormand and Prince (1980), J. Comput. Appl. Math. 6:19, without the times, as strain is proportional.
constexpr int stages = 7;
constexpr double a[stages][stages - 1] = {
    {},
    {1. / 5},
    {3. / 40, 9. / 40},
    {44. / 45, -56. / 15, 32. / 9},
    {19372. / 6561, -25360. / 2187, 64448. / 6561, -212. / 729},
    {9017. / 3168, -355. / 33, 46732. / 5247, 49. / 176, -5103. / 18656},
    {35. / 384, 0, 500. / 1113, 125. / 192, -2187. / 6784, 11. / 84}};
constexpr double fifth_less_fourth[stages] = {71. / 57600,      0,         -71. / 16695, 71. / 1920,
                                              -17253. / 339200, 22. / 525, -1. / 40};

struct Step {
  Point end;
  double error;
  bool valid; ///< all stages at positive mean stress
};

Step dormand_prince(const Material& m, const Point& from, const Tensor& strain, double h, bool plastic) {
  Rate k[stages];
  Step step{from, 0, true};
  for (int i = 0; i < stages; ++i) {
    Point at = from;
    for (int j = 0; j < i; ++j) at = moved(at, h * a[i][j], k[j]);
    if (!(mean(at.stress) > 0) || at.plastic_strain < 0) return {from, 0, false};
    const auto here = local(m, at, strain);
    k[i] = plastic ? plastic_rate(here, strain) : elastic_rate(here, strain);
    step.end = at; // the last stage is the answer
  }
  Point difference{};
  difference.void_ratio = 1;
  for (int i = 0; i < stages; ++i) difference = moved(difference, h * fifth_less_fourth[i], k[i]);
  step.error = norm(difference.stress) / mean(step.end.stress) +
               std::abs(difference.plastic_strain) / (m.given.k_p + step.end.plastic_strain);
  return step;
}

/// The reference on its way through a strain.
class Integration {
public:
  Integration(const Material& m, const Point& from, const Tensor& strain, double tolerance)
      : m(m), strain(strain), volumetric(simsand::trace(strain)), tolerance(tolerance), point(from) {}

  Reference run() {
    while (done < 1 && found) {
      if (++steps > most_steps)
        found = false;
      else if (mean(point.stress) <= lost_stress * m.given.p_min)
        pass_stress_free();
      else
        advance(loads_plastically());
    }
    return {point, found && std::isfinite(norm(point.stress) + point.plastic_strain), steps};
  }

private:
  /// Strain without stress: closes the gap or opens it; what is left may load from nothing.
  void pass_stress_free() {
    point.stress = {};
    const double left = 1 - done, gap = point.separation_strain;
    if (gap > simsand::tiny<double>) {
      if (gap >= volumetric * left) return finish_stress_free();
      close(gap / volumetric);
    }
    point.separation_strain = 0;
    if (!leave_zero() && !(volumetric > 0 && flow_in_contact())) finish_stress_free();
  }

  void close(double share) {
    point.void_ratio = simsand::void_ratio_after(point.void_ratio, volumetric * share);
    done += share;
  }

  void finish_stress_free() {
    const double left = 1 - done;
    point.separation_strain = std::max(point.separation_strain - volumetric * left, simsand::tiny<double>);
    close(left);
    done = 1;
  }

  /// Rates at p -> 0, where f is p times a function of the direction of the strain.
  struct Vanishing {
    double M, dilatancy, K, G, shear; ///< M_p h; shear: rate of q / 3G
  };
  Vanishing vanishing(const Point& at_zero) const {
    Point seed = at_zero;
    seed.stress = simsand::add_mean(Tensor{}, lost_stress * m.given.p_min);
    const auto at = local(m, seed, strain);
    return {-at.f_p, at.dilatancy, at.K, at.G, std::sqrt(2. / 3) * norm(simsand::deviator(strain))};
  }

  /// The state close to p = 0 where the rates at p -> 0 lead to pressure.
  bool leave_zero() {
    const auto at = vanishing(point);
    double eta = 3 * at.G * at.shear / (at.K * volumetric), p_rate = at.K * volumetric;
    if (!(volumetric > 0) || eta > at.M) { // plastic from the start: q = M_p h p
      const double x = (3 * at.G * at.shear - at.M * p_rate) / (3 * at.G - at.M * at.K * at.dilatancy);
      p_rate -= at.K * x * at.dilatancy;
      eta = at.M;
    }
    const double p0 = 2 * lost_stress * m.given.p_min;
    if (!(p_rate > 0) || p0 / p_rate > 1 - done) return false;
    point.stress = simsand::add_mean(simsand::scale(eta * p0, unit_deviator(strain)), p0);
    point.separation_strain = 0;
    close(p0 / p_rate);
    return true;
  }

  /// Grains that touch without pressure: contraction by shear takes up all compression, x D = d eps_v, until shear
  /// no longer contracts enough. False: it does so to the end of the strain.
  bool flow_in_contact() {
    while (done < 1) {
      const double D = vanishing(point).dilatancy, before = point.plastic_strain;
      const double size = std::min(1 - done, 1e-3 * (m.given.k_p + before) * D / volumetric);
      if (!(D > 0) || !(size > 0)) return false;
      point.plastic_strain += volumetric * size / D;
      const double D_end = vanishing(point).dilatancy;
      point.plastic_strain = before + volumetric * size * 2 / (D + D_end);
      close(size);
      if (1 - done < 1e-12) break;
      if (leave_zero()) return true;
    }
    return false;
  }

  bool loads_plastically() const {
    const auto here = local(m, point, strain);
    return here.f >= -on_surface * here.p && elastic_growth(here, strain) > 0;
  }

  void advance(bool plastic) {
    const double h = std::min(size, 1 - done);
    auto step = dormand_prince(m, point, strain, h, plastic);
    if (!step.valid || step.error > tolerance) {
      const double cut = step.valid ? 0.9 * std::pow(tolerance / step.error, 0.2) : 0.5;
      size = h * std::clamp(cut, 0.1, 0.5 + 0.4 * step.valid);
      if (size < 1e-15) lose_stress(); // p -> 0 within this step
      return;
    }
    double taken = h;
    if (!plastic && outside(step.end)) {
      taken = h * crossing(h);
      step = dormand_prince(m, point, strain, taken, false);
    }
    const double gap = point.separation_strain;
    point = step.end;
    point.separation_strain = gap;
    if (plastic) return_to_surface();
    done = taken == h && h == 1 - done ? 1 : done + taken;
    if (taken == h)
      size = h * std::clamp(0.9 * std::pow(tolerance / std::max(step.error, 1e-300), 0.2), 0.5, 4.);
  }

  void lose_stress() {
    point.stress = {};
    point.separation_strain = 0;
  }

  bool outside(const Point& at) const { return yield_of(m, at) > on_surface * mean(at.stress); }

  /// Share of an elastic step at which it meets the yield surface, by bisection.
  double crossing(double h) const {
    double inside = 0, beyond = 1;
    for (int i = 0; i < 60 && beyond - inside > 1e-14; ++i) {
      const double middle = (inside + beyond) / 2;
      (outside(dormand_prince(m, point, strain, h * middle, false).end) ? beyond : inside) = middle;
    }
    return beyond; // on the outer side, within the width of the surface
  }

  /// Removes what rounding and truncation left of f, by plastic flow.
  void return_to_surface() {
    for (int i = 0; i < 3; ++i) {
      const auto at = local(m, point, strain);
      if (std::abs(at.f) < 1e-13 * at.p) return;
      const double x = at.f / consistency(at);
      const double gap = point.separation_strain;
      point = moved(point, x,
                    {simsand::add_mean(simsand::scale(-3 * at.G, at.direction), -at.K * at.dilatancy), 0, 1});
      point.separation_strain = gap;
    }
  }

  const Material& m;
  const Tensor& strain;
  const double volumetric, tolerance;
  Point point;
  double done = 0, size = 1;
  bool found = true;
  long steps = 0;
};

} // namespace

Reference integrate_rates(const Material& m, const Point& from, const Tensor& strain, double tolerance) {
  return Integration(m, from, strain, tolerance).run();
}

} // namespace charts
