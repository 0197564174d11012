// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/sight.hpp"
#include "host/scheme/geometry.hpp"

namespace host {
namespace {

template <int D> using Lanes = std::array<Lane, D>;

/// Distance of eight points from a plane or mantle without end, m.
template <int D> Lane distance_of(const Surface<D>& s, const Lanes<D>& x) {
  if (s.mantle) {
    const Lane dx = x[0] - s.center[0], dy = x[1] - s.center[1];
    return s.side * (square_root(dx * dx + dy * dy) - s.radius);
  }
  Lane sum{};
  for (int a = 0; a < D; ++a) sum += (x[a] - s.point[a]) * s.normal[a];
  return sum;
}

/// Reflects those of the points that are behind the surface in its tangent plane.
template <int D> void fold(const Surface<D>& s, Lanes<D>& x) {
  const Lane behind = smaller(distance_of<D>(s, x), Lane{});
  if (!s.mantle) {
    for (int a = 0; a < D; ++a) x[a] -= 2 * s.normal[a] * behind;
    return;
  }
  const Lane r = larger(behind * s.side + s.radius, Lane{} + 1e-9 * s.radius);
  for (int a = 0; a < 2; ++a) x[a] -= (2 * s.side * behind / r) * (x[a] - s.center[a]);
}

/// Where the lines from x, at distance d in front of the shell, to y, behind it, go through it.
template <int D>
Lanes<D> crossing(const Surface<D>& s, const Lanes<D>& x, const Lane& d, const double (&y)[D]) {
  Lane share = d / larger(d - distance(s, y), Lane{} + 1e-300);
  if (s.mantle) { // a x^2 + 2 b x = c with the radius as a function of the share of the way
    Lane a{}, b{}, c = Lane{} + s.radius * s.radius;
    for (int e = 0; e < 2; ++e) {
      const Lane way = y[e] - x[e], from = x[e] - s.center[e];
      a += way * way;
      b += way * from;
      c -= from * from;
    }
    share = (square_root(larger(b * b + a * c, Lane{})) - b) / larger(a, Lane{} + 1e-300);
  }
  Lanes<D> q;
  for (int e = 0; e < D; ++e) q[e] = x[e] + share * (y[e] - x[e]);
  return q;
}

/// Of eight particles at x, 1 for those that see the image at y through all shells of its path, else 0.
template <int D>
Lane sight_of(const std::vector<Surface<D>>& surfaces, const ImagePath& path, const Lanes<D>& x,
              const double (&y)[D]) {
  Lane sight = Lane{} + 1;
  for (const int s : path.all()) {
    const auto& shell = surfaces[s];
    if (shell.extent != Extent::shell) continue;
    const Lane d = distance_of<D>(shell, x);
    auto q = crossing<D>(shell, x, d, y);
    for (const int other : path.all()) // in a corner the line may meet the other surface first
      if (other != s) fold<D>(surfaces[other], q);
    const Lane height = q[D - 1];
    sight = (d < 0.0) | (height < shell.lower[D - 1]) | (height > shell.upper[D - 1]) ? Lane{} : sight;
  }
  return sight;
}

/// True if sand at x may come to the other side of a shell or see past its edge while particles move by up to half of
/// `skin` and the shell by up to half of `reach`.
template <int D> bool may_see_past(const Surface<D>& shell, const Vector<D>& x, double reach, double skin) {
  if (gap(shell, x) > 1.5 * reach) return false;
  const double height = x[D - 1];
  return distance(shell, x) < 0.5 * skin || height < shell.lower[D - 1] + 1.5 * reach ||
         height > shell.upper[D - 1] - 1.5 * reach;
}

} // namespace

template <class Geometry>
std::vector<char> find_screened_clusters(const Particles<Geometry>& p,
                                         const std::vector<Surface<Geometry::dimension>>& surfaces,
                                         const Images& images, double reach, double skin) {
  constexpr int D = Geometry::dimension;
  std::vector<char> screened(p.clusters(), false);
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    if (surfaces[s].extent != Extent::shell || images.clearance[s] > 1.5 * reach) continue;
    for (int i = 0; i < p.count; ++i) {
      Vector<D> x;
      for (int a = 0; a < D; ++a) x[a] = p.position[a][i];
      if (may_see_past(surfaces[s], x, reach, skin)) screened[i / lanes] = true;
    }
  }
  return screened;
}

template <class Geometry>
void find_sight(const Particles<Geometry>& p, const std::vector<Surface<Geometry::dimension>>& surfaces,
                const Images& images, const Records<Geometry>& records, NeighbourLists& lists) {
  constexpr int D = Geometry::dimension;
  if (lists.screened_clusters.empty()) return;
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < lists.screened_clusters.size(); ++k) {
    const int c = lists.screened_clusters[k];
    std::array<Lane, D> x;
    for (int a = 0; a < D; ++a) x[a] = load(&p.position[a][c * lanes]);
    double* sight = &lists.sight[lists.sight_start[c]];
    for (int n = lists.common(c); n < lists.total[c]; ++n, sight += lanes) {
      const int image = lists.begin(c)[n];
      store(sight, sight_of<D>(surfaces, images.path(image), x, records.motion[image].position));
    }
  }
}

template decltype(find_screened_clusters<PlaneStrain>) find_screened_clusters<PlaneStrain>;
template decltype(find_screened_clusters<Axisymmetric>) find_screened_clusters<Axisymmetric>;
template decltype(find_screened_clusters<ThreeDimensional>) find_screened_clusters<ThreeDimensional>;
template decltype(find_sight<PlaneStrain>) find_sight<PlaneStrain>;
template decltype(find_sight<Axisymmetric>) find_sight<Axisymmetric>;
template decltype(find_sight<ThreeDimensional>) find_sight<ThreeDimensional>;

} // namespace host
