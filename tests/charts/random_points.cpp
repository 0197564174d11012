// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/increment_record.hpp"
#include "tests/charts/random_states.hpp"
#include <limits>
#include <random>

namespace charts {
namespace {

/// Random numbers of one block.
class Dice {
public:
  Dice(std::uint64_t seed, int shear) : components(3 + shear), generator(seed) {}
  const int components; ///< of all tensors; the others are zero
  double uniform() { return uniform_(generator); }
  bool chance(double share) { return uniform() < share; }
  double power(double from, double to) { return std::pow(10, from + (to - from) * uniform()); }
  /// All directions alike; sqrt(a : a) = 1.
  Tensor direction() {
    Tensor t;
    for (int c = 0; c < components; ++c) t[c] = normal_(generator) * (c < 3 ? 1 : std::sqrt(0.5));
    return simsand::scale(1 / norm(t), t);
  }

private:
  std::mt19937_64 generator;
  std::uniform_real_distribution<double> uniform_;
  std::normal_distribution<double> normal_;
};

Origin origin_of(double share) {
  constexpr std::array<std::pair<double, Origin>, 8> parts{{{0.30, Origin::inside},
                                                            {0.60, Origin::on_surface},
                                                            {0.80, Origin::outside},
                                                            {0.85, Origin::isotropic},
                                                            {0.90, Origin::no_stress},
                                                            {0.96, Origin::parted},
                                                            {0.97, Origin::stress_beside_gap},
                                                            {0.999, Origin::first_call}}};
  for (const auto& [end, origin] : parts)
    if (share < end) return origin;
  return Origin::bad_input;
}

Tensor strain_increment(Dice& dice) {
  const double kind = dice.uniform();
  auto t = dice.direction();
  if (kind < 0.2) t = simsand::deviator(t);
  if (kind > 0.95) t = simsand::add_mean(Tensor{}, simsand::trace(t));
  return simsand::scale(dice.power(-8, -1) / norm(t), t);
}

/// Deviator of this kind of state: q over p M_p is `ratio`.
Tensor stress_of(const Material& m, double p, double e, double ratio, Dice& dice) {
  const auto n = unit_deviator(dice.direction());
  const auto M = simsand::slopes(m, e, simsand::pressure_of_mean_stress(m, p), simsand::sin_3theta(n, 1.));
  return simsand::add_mean(simsand::scale(p * M.peak * ratio, n), p);
}

double stress_ratio(Origin origin, double mobilised, Dice& dice) {
  switch (origin) {
  case Origin::inside:
    return mobilised * dice.uniform();
  case Origin::on_surface:
    return mobilised;
  case Origin::isotropic:
    return 0;
  default:
    return mobilised + (3 - mobilised) * dice.uniform();
  }
}

/// Makes one number of a good state, or of a first call, one that must be refused.
void spoil(RandomPoint& r, Dice& dice) {
  const double nan = std::numeric_limits<double>::quiet_NaN(),
               infinite = std::numeric_limits<double>::infinity();
  const double bad = dice.chance(0.5) ? nan : infinite;
  const bool first_call = dice.chance(0.3);
  if (first_call) r.point.void_ratio = r.point.plastic_strain = 0;
  const int where = int((first_call ? 2 : 6) * dice.uniform());
  if (where == 0) r.point.stress[int(dice.components * dice.uniform())] = bad;
  if (where == 1) r.strain[int(dice.components * dice.uniform())] = -bad;
  if (where == 2) r.point.void_ratio = bad;
  if (where == 3) r.point.void_ratio = -r.point.void_ratio;
  if (where == 4) r.point.plastic_strain = -1e-6 - r.point.plastic_strain;
  if (where == 5) r.point.separation_strain = bad;
}

RandomPoint random_point(const Material& m, Dice& dice) {
  RandomPoint r{origin_of(dice.uniform()), {}, strain_increment(dice)};
  const double p = dice.chance(0.4) ? 1e6 * dice.uniform() : dice.power(-3, 6);
  Point& point = r.point;
  point.void_ratio = 0.2 + 1.8 * dice.uniform();
  point.plastic_strain = dice.chance(0.08) ? 0 : dice.power(-6, 0);
  const bool stressed = r.origin != Origin::no_stress && r.origin != Origin::parted;
  const double share = simsand::mobilised(m, point.plastic_strain);
  if (stressed) point.stress = stress_of(m, p, point.void_ratio, stress_ratio(r.origin, share, dice), dice);
  if (r.origin == Origin::parted || r.origin == Origin::stress_beside_gap)
    point.separation_strain = dice.power(-8, -1);
  if (r.origin == Origin::first_call) point.void_ratio = point.plastic_strain = 0;
  if (r.origin == Origin::bad_input) spoil(r, dice);
  return r;
}

} // namespace

RandomBlock random_points(std::uint64_t seed, std::int64_t index) {
  const int shear = index % 8 == 7 ? 1 : 3;
  Dice dice(hash_of(seed, double(index)), shear);
  RandomBlock block{int(index % 3), shear, {}};
  const auto m = material_of(properties(sands[block.sand]));
  for (int k = 0; k < random_block; ++k) block.points.push_back(random_point(m, dice));
  return block;
}

} // namespace charts
