// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/wall_forces.hpp"
#include "host/walls/wall_images.hpp"

namespace host {
namespace {

template <class Geometry> PairSide<Geometry, double> side_of(const Records<Geometry>& records, int i) {
  PairSide<Geometry, double> side;
  const auto& motion = records.motion[i];
  const auto& stress = records.stress[i];
  std::ranges::copy(motion.position, side.position);
  std::ranges::copy(motion.velocity, side.velocity);
  side.weight = Geometry::weight(motion.position[0]);
  side.density = stress.density;
  side.damping_speed = stress.damping_speed;
  side.radius = float(motion.position[0]);
  std::ranges::copy(stress.strain_rate, side.strain_rate);
  return side;
}

/// Acceleration of particle `i` by record `j`: the sum of forces_on for one pair.
template <class Geometry, int D = Geometry::dimension>
Point<D> acceleration(const Kernel<D>& kernel, const Records<Geometry>& records, int i, int j) {
  const auto side = side_of(records, i);
  PairSums<Geometry, double> sums;
  const auto& motion = records.motion[j];
  add_pair<false>(pair_factors(kernel, side, motion, records.stress[j]), side, motion, records.stress[j],
                  sums);
  sums.scale(kernel.pair_scale());
  const double inverse_weight = Geometry::hoop ? 1 / side.weight : 1;
  const double damping = (Geometry::hoop ? 0.125 : 0.25) * kernel.h;
  Point<D> a{};
  for (int c = 0; c < D; ++c) {
    a[c] = inverse_weight * (sums.stress_force[c] + damping * sums.viscous[c]);
    for (int b = 0; b < D; ++b) a[c] += records.stress[i].stress[component<D>(c, b)] * sums.slope[b];
    a[c] /= side.density;
  }
  return a;
}

} // namespace

template <class Geometry>
void split_push(const Simulation<Geometry>& s, int i, const std::vector<int>& near,
                SplitPush<Geometry::dimension>& push) {
  push.by_surface.assign(near.size(), {});
  push.by_corners = {};
  const int c = i / lanes;
  const int* neighbour = s.lists.begin(c);
  for (int k = s.lists.interior[c]; k < s.lists.total[c]; ++k) {
    if (s.records.motion[neighbour[k]].volume == 0) continue;
    const auto chain = chain_of(s.images, s.mirrors.size(), neighbour[k]);
    const auto place = std::ranges::find(near, chain.surface[0]);
    const bool single = chain.length == 1 && place != near.end();
    auto& sum = single ? push.by_surface[std::size_t(place - near.begin())] : push.by_corners;
    const auto a = acceleration(s.kernel, s.records, i, neighbour[k]);
    for (int b = 0; b < Geometry::dimension; ++b) sum[b] += a[b];
  }
}

template void split_push(const Simulation<PlaneStrain>&, int, const std::vector<int>&, SplitPush<2>&);
template void split_push(const Simulation<Axisymmetric>&, int, const std::vector<int>&, SplitPush<2>&);
template void split_push(const Simulation<ThreeDimensional>&, int, const std::vector<int>&, SplitPush<3>&);

} // namespace host
