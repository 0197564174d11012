// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/push.hpp"
#include "host/scheme/geometry.hpp"

namespace host {
namespace {

template <int D>
void find_near(const WallsOfStep<D>& walls, const Vector<D>& x, double reach,
               std::vector<NearSurface<D>>& near) {
  near.clear();
  for (const int number : walls.within_reach) {
    const auto& s = walls.before[number];
    const double d = distance(s, x);
    if (d < 0 || d >= reach || s.is_symmetry()) continue;
    if (s.extent != Extent::whole && gap(s, x) > reach) continue;
    near.push_back({&s, number, d, normal_of(s, x), {}});
  }
}

/// Acceleration of particle `i` by record `j`: the sum over images for one pair.
template <class Geometry, int D = Geometry::dimension>
Vector<D> acceleration_by(const PairsOfStep<Geometry>& pairs, const PairSide<Geometry, double>& side,
                          const OwnStress<Geometry, double>& own, int j) {
  const auto& motion = pairs.records.motion[j];
  const auto& stress = pairs.records.stress[j];
  PairSums<Geometry, double> sums;
  add_pair<false>(pair_factors(pairs.kernel, side, motion, stress), side, motion, stress, sums);
  sums.scale(pairs.kernel.pair_scale());
  return vector_of<D>(finish_images(own, sums, pairs.kernel.h));
}

/// Adds to non-negative shares along normals what makes up most of `push`: least squares by Gauss and Seidel.
template <int D>
void share_push(const Vector<D>& push, double kick_time, std::vector<NearSurface<D>>& near,
                std::vector<double>& shares) {
  constexpr int sweeps = 8;
  Vector<D> rest{};
  add_scaled(rest, kick_time, push);
  shares.assign(near.size(), 0);
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t k = 0; k < near.size(); ++k) {
      const double more = std::max(dot(rest, near[k].normal), -shares[k]);
      shares[k] += more;
      add_scaled(rest, -more, near[k].normal);
    }
  for (std::size_t k = 0; k < near.size(); ++k) add_scaled(near[k].push, shares[k], near[k].normal);
}

/// Divides `push` among the surfaces near the particle: what the shares leave is the nearest one's.
template <class Geometry, int D = Geometry::dimension>
void divide_push(const PairsOfStep<Geometry>& pairs, int i, double density, const Vector<D>& push,
                 double kick_time, PushBuffer<D>& buffer) {
  auto& near = buffer.near;
  Vector<D> rest = push;
  if (near.size() > 1) {
    const auto by_corners = separate_push(pairs, i, density, near);
    for (auto& n : near)
      for (double& component : n.push) component *= kick_time;
    share_push(by_corners, kick_time, near, buffer.shares);
    for (const auto& n : near) add_scaled(rest, -1, n.push);
  }
  const auto nearest = std::ranges::min_element(near, {}, &NearSurface<D>::distance);
  add_scaled(nearest->push, 1, rest);
  for (auto& n : near) n.normal_push = dot(n.push, n.normal);
}

} // namespace

template <class Geometry, int D>
Vector<D> separate_push(const PairsOfStep<Geometry>& pairs, int i, double density,
                        std::vector<NearSurface<D>>& near) {
  const auto& stress = pairs.records.stress[i];
  const auto side = pair_side<Geometry>(pairs.records.motion[i], stress);
  OwnStress<Geometry, double> own;
  std::ranges::copy(stress.stress, own.stress);
  own.inverse_density = 1 / density;
  own.inverse_weight = 1 / side.weight;
  Vector<D> by_others{};
  const int c = i / lanes, common = pairs.lists.common(c);
  for (int n = pairs.lists.interior[c]; n < pairs.lists.total[c]; ++n) {
    const int j = pairs.lists.begin(c)[n];
    if (pairs.records.motion[j].volume == 0) continue;
    if (n >= common && pairs.lists.sight_of(c, n)[i % lanes] == 0) continue;
    const auto& path = pairs.images.path(j);
    const auto own_surface = std::ranges::find(near, path.surface[0], &NearSurface<D>::number);
    const bool single = path.length == 1 && own_surface != near.end();
    add_scaled(single ? own_surface->push : by_others, 1, acceleration_by(pairs, side, own, j));
  }
  return by_others;
}

template <class Geometry, int D>
void push_by_walls(const PairsOfStep<Geometry>& pairs, const WallsOfStep<D>& walls, int i, double density,
                   const Vector<D>& push, double kick_time, MovingParticle<D>& p, PushBuffer<D>& buffer) {
  auto& near = buffer.near;
  find_near(walls, p.start, pairs.kernel.support, near);
  if (near.empty()) return;
  divide_push(pairs, i, density, push, kick_time, buffer);
  Vector<D> pushed = push, friction{};
  for (auto& n : near) {
    const double pull = std::min(n.normal_push, 0.0);
    for (auto* vector : {&n.push, &pushed}) add_scaled(*vector, -pull, n.normal);
    if (n.surface->no_slip)
      n.driven = n.push;
    else
      add_scaled(n.driven, std::max(n.normal_push, 0.0), n.normal);
  }
  add_scaled(p.velocity, 1, pushed);
  for (auto& n : near) {
    const Wall& wall = walls.walls[n.surface->wall];
    if (wall.no_slip && n.distance >= walls.spacing) continue; // the layer next to the wall stands
    const auto change = apply_friction(wall, *n.surface, n.normal, n.normal_push, p.velocity);
    add_scaled(friction, 1, change);
    add_scaled(n.push, 1, change);
    add_scaled(n.driven, 1, change);
  }
  Vector<D> momentum{}; // mean of the step
  add_scaled(momentum, 0.5 * p.mass, p.before);
  add_scaled(momentum, 0.5 * p.mass, p.velocity);
  p.work.wall += dot(momentum, pushed);
  p.work.friction += dot(momentum, friction);
  for (const auto& n : near) add_load(p, *n.surface, n.normal, n.push, n.driven, dot(momentum, n.push));
}

template decltype(separate_push<PlaneStrain>) separate_push<PlaneStrain>;
template decltype(separate_push<Axisymmetric>) separate_push<Axisymmetric>;
template decltype(separate_push<ThreeDimensional>) separate_push<ThreeDimensional>;
template decltype(push_by_walls<PlaneStrain>) push_by_walls<PlaneStrain>;
template decltype(push_by_walls<Axisymmetric>) push_by_walls<Axisymmetric>;
template decltype(push_by_walls<ThreeDimensional>) push_by_walls<ThreeDimensional>;

} // namespace host
