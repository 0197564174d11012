// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/integrators.hpp"

namespace charts {
namespace {

Answer euler(const Material& m, const Point& old, const Tensor& strain, bool corrected) {
  const double share = elastic_share(m, old, strain);
  const auto start = elastic_answer(m, old, simsand::scale(share, strain)).point;
  if (share >= 1)
    return {elastic_answer(m, old, strain).measure > 0 ? start
                                                       : parted(m, old, simsand::trace(strain), 0, 0)};
  const auto rest = simsand::scale(1 - share, strain);
  // At zero pressure there is no yield surface to start from: the elastic answer instead, corrected or not.
  const bool from_nothing = !(mean(start.stress) > 0);
  const Rate rate = from_nothing ? Rate{} : plastic_rate(local(m, start, strain), rest);
  Point end = from_nothing ? elastic_answer(m, old, strain).point : moved(start, 1, rate);
  end.void_ratio = simsand::void_ratio_after(old.void_ratio, simsand::trace(strain));
  const bool returned = !corrected || !(mean(end.stress) > 0) || correct_drift(m, end, strain);
  if (mean(end.stress) > 0) return {end, returned};
  const double lost = from_nothing ? 0 : local(m, start, strain).dilatancy * rate.eps_d;
  return {parted(m, old, simsand::trace(strain), lost, rate.eps_d)};
}

} // namespace

Answer explicit_euler(const Material& m, const Point& old, const Tensor& strain) {
  return after_gap(old, strain, [&](const Point& p, const Tensor& e) { return euler(m, p, e, false); });
}

Answer corrected_euler(const Material& m, const Point& old, const Tensor& strain) {
  return after_gap(old, strain, [&](const Point& p, const Tensor& e) { return euler(m, p, e, true); });
}

} // namespace charts
