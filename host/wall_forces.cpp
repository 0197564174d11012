// SPDX-License-Identifier: BSD-3-Clause
#include "host/wall_forces.hpp"
#include "host/momentum_solid.hpp"
#include "host/wall_images.hpp"

namespace host {
namespace {

template <class Geometry> PairSide<Geometry, double> side_of(const StressRecord<Geometry>& r) {
  PairSide<Geometry, double> side;
  std::ranges::copy(r.position, side.position);
  std::ranges::copy(r.velocity, side.velocity);
  side.weight = r.weight;
  side.density = r.density;
  side.damping_speed = r.damping_speed;
  std::ranges::copy(r.flux, side.flux);
  std::ranges::copy(r.gradient, side.gradient);
  std::ranges::copy(r.reduced_stress, side.reduced_stress);
  return side;
}

/// Acceleration of particle `i` by one record.
template <class Geometry>
Point<2> acceleration(const Kernel<2>& kernel, const StressRecord<Geometry>& i,
                      const StressRecord<Geometry>& j) {
  const auto side = side_of(i);
  const auto pair = make_pair(kernel, side, j);
  double force[2]{};
  add_stress_force(pair, side, j, force);
  add_viscous_force(kernel, pair, side, j, force);
  return {force[0] / (i.density * i.weight), force[1] / (i.density * i.weight)};
}

Point<3> acceleration(const Kernel<3>& kernel, const StressRecord<ThreeDimensional>& i,
                      const StressRecord<ThreeDimensional>& j) {
  SolidSide<double> side;
  std::ranges::copy(i.position, side.position);
  std::ranges::copy(i.velocity, side.velocity);
  side.density = i.density;
  side.damping_speed = i.damping_speed;
  std::ranges::copy(i.strain_rate, side.strain_rate);
  SolidSums<double> sums;
  add_pair<false>(kernel, side, j, sums);
  Point<3> a{};
  for (int c = 0; c < 3; ++c) {
    a[c] = sums.stress_force[c] + sums.viscous[c];
    for (int b = 0; b < 3; ++b) a[c] += i.flux[component<3>(c, b)] * sums.slope[b];
    a[c] /= i.density;
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
    const auto& record = s.records.stress[neighbour[k]];
    if (record.volume == 0) continue;
    const auto chain = chain_of(s.images, s.mirrors.size(), neighbour[k]);
    const auto place = std::ranges::find(near, chain.surface[0]);
    const bool single = chain.length == 1 && place != near.end();
    auto& sum = single ? push.by_surface[std::size_t(place - near.begin())] : push.by_corners;
    const auto a = acceleration(s.kernel, s.records.stress[i], record);
    for (int b = 0; b < Geometry::dimension; ++b) sum[b] += a[b];
  }
}

template void split_push(const Simulation<PlaneStrain>&, int, const std::vector<int>&, SplitPush<2>&);
template void split_push(const Simulation<Axisymmetric>&, int, const std::vector<int>&, SplitPush<2>&);
template void split_push(const Simulation<ThreeDimensional>&, int, const std::vector<int>&, SplitPush<3>&);

} // namespace host
