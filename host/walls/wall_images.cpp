// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/wall_images.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>

namespace host {
namespace {

/// True if surface `s` has an image of sand at `x`: sand in front of it, where the surface exists; behind an edge of a
/// body each of its surfaces has the part of the solid that is nearest to it.
template <int D> bool shows(const std::vector<Surface<D>>& surfaces, int s, const Point<D>& x) {
  const auto& own = surfaces[s];
  if (distance(own, x) < 0 || !beside_shell(own, x)) return false;
  if (!own.obstacle) return true;
  auto image = x;
  reflect(own, image);
  if (body_distance(own, image) >= 0) return false;
  const double depth = distance(own, image);
  return std::ranges::none_of(surfaces, [&](const Surface<D>& other) {
    return other.wall == own.wall && &other != &own && distance(other, image) > depth;
  });
}

/// True if the image, at `x`, of a particle at `root` has its place to itself. Where two solids overlap it belongs to
/// the one it lies deeper in; images of images fill what single ones leave empty.
template <int D>
bool has_place(const std::vector<Surface<D>>& surfaces, const Chain& chain, const Point<D>& root,
               const Point<D>& x) {
  for (const int s : chain.all())
    if (!shows(surfaces, s, root)) return false;
  if (chain.length == 1) {
    const auto& own = surfaces[chain.surface[0]];
    const double depth = distance(own, x);
    return std::ranges::none_of(surfaces, [&](const Surface<D>& other) {
      if (&other == &own || (own.obstacle && other.wall == own.wall)) return false;
      return beside_shell(other, root) && body_distance(other, x) < depth;
    });
  }
  if (std::ranges::none_of(chain.all(), [&](int k) { return distance(surfaces[k], x) < 0; })) return false;
  return std::ranges::all_of(chain.all(), [&](int j) {
    auto seen = x;
    reflect(surfaces[j], seen);
    return std::ranges::any_of(chain.all(), [&](int k) { return k != j && distance(surfaces[k], seen) < 0; });
  });
}

/// Volume of the image over that of the particle at `x`.
template <int D> double stretch_of(const std::vector<Surface<D>>& surfaces, const Chain& chain, Point<D> x) {
  double stretch = 1;
  for (int k = chain.length; k-- > 0;) stretch *= reflect(surfaces[chain.surface[k]], x);
  return stretch;
}

/// The velocity of the image: reflected for an observer who moves with the surface; without slip reversed, so that it
/// passes through the wall's at the wall.
template <int D> void reflect_velocity(const Surface<D>& s, const Point<D>& n, double (&v)[D]) {
  if (s.no_slip) {
    for (int a = 0; a < D; ++a) v[a] = 2 * s.velocity[a] - v[a];
    return;
  }
  double twice = 0;
  for (int a = 0; a < D; ++a) twice += 2 * n[a] * (v[a] - s.velocity[a]);
  for (int a = 0; a < D; ++a) v[a] -= twice * n[a];
}

/// H T H of a full tensor, H the reflection in the plane of normal `n`.
template <int D> void reflect_tensor(const Point<D>& n, double (&t)[D][D]) {
  double left[D] = {}, right[D] = {}, both = 0;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) {
      left[b] += n[a] * t[a][b];
      right[a] += t[a][b] * n[b];
      both += n[a] * t[a][b] * n[b];
    }
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) t[a][b] += 4 * both * n[a] * n[b] - 2 * (n[a] * left[b] + right[a] * n[b]);
}

/// The same of a symmetric one whose component of the axes a and b is s[component(a, b)], shear being `shear` times the
/// tensor's; then `added` is added.
template <int D, class Component, class Real, std::size_t S>
void reflect_symmetric(const Point<D>& n, double shear, const double (&added)[D][D],
                       const Component& component, Real (&s)[S]) {
  double t[D][D];
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) t[a][b] = s[component(a, b)] / (a == b ? 1 : shear);
  reflect_tensor<D>(n, t);
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b) s[component(a, b)] = Real((t[a][b] + added[a][b]) * (a == b ? 1 : shear));
}

/// Stress that the weight adds between a particle and its image, at twice the distance: across the surface in full,
/// along it times K0.
template <int D>
void weight_across(const Point<D>& n, double distance, const Scene& scene, double (&added)[D][D]) {
  const double across = -scene.bulk_density * scene.gravity * n[D - 1] * 2 * distance;
  const double along = scene.earth_pressure_ratio * across;
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) added[a][b] = (across - along) * n[a] * n[b] + (a == b ? along : 0);
}

/// Stress and strain rate behind a surface. Without slip shear goes on across it.
template <class Geometry, int D = Geometry::dimension>
void reflect_fields(const Surface<D>& s, const Point<D>& n, double depth, const Scene& scene,
                    StressRecord<Geometry>& record) {
  double added[D][D];
  constexpr double nothing[D][D] = {};
  weight_across<D>(n, depth, scene, added);
  if (s.no_slip) {
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) record.stress[component<D>(a, b)] += added[a][b];
    return;
  }
  reflect_symmetric<D>(n, 1, added, component<D>, record.stress);
  const auto rate = [](int a, int b) {
    return a == b ? a : component<D>(a, b) - (D == 2 ? 1 : 0);
  }; // no hoop rate
  reflect_symmetric<D>(n, 2, nothing, rate, record.strain_rate);
}

template <int D> Point<D> place(const double (&position)[D]) {
  Point<D> x;
  std::copy_n(position, D, x.begin());
  return x;
}

std::size_t first_of_walls(const Images& images, std::size_t mirrors) {
  const auto at = std::ranges::find_if(images.list, [&](const Image& i) { return i.mirror >= int(mirrors); });
  return std::size_t(at - images.list.begin());
}

} // namespace

Chain chain_of(const Images& images, std::size_t mirrors, int record) {
  Chain chain;
  chain.root = record;
  while (chain.root >= images.first && chain.length < Chain::longest) {
    const Image& image = images.list[chain.root - images.first];
    if (image.mirror < int(mirrors)) break;
    chain.surface[chain.length++] = image.mirror - int(mirrors);
    chain.root = image.source;
  }
  return chain;
}

template <class Geometry>
void add_wall_images(const Particles<Geometry>& p, const std::vector<Surface<Geometry::dimension>>& surfaces,
                     std::size_t mirrors, double reach, Images& images) {
  constexpr int D = Geometry::dimension;
  std::vector<Point<D>> position; // of the images that are there, by number
  const auto place_of = [&](int record) {
    Point<D> x;
    for (int a = 0; a < D; ++a)
      x[a] = record < images.first ? p.position[a][record] : position[record - images.first][a];
    return x;
  };
  for (const Image& image : images.list) { // in planes of symmetry
    auto x = place_of(image.source);
    x[image.mirror] *= -1;
    position.push_back(x);
  }
  const auto consider = [&](int source, int s) {
    auto x = place_of(source);
    const double depth = distance(surfaces[s], x);
    if (depth < -reach / 2 || depth > reach) return;
    if (surfaces[s].obstacle && body_distance(surfaces[s], x) > 2 * reach) return;
    const auto earlier = chain_of(images, mirrors, source);
    if (earlier.length == Chain::longest) return;
    for (const int e : earlier.all())
      if (surfaces[s].obstacle && surfaces[e].wall == surfaces[s].wall) return; // no corner inside a body
    reflect(surfaces[s], x);
    images.list.push_back({source, int(mirrors) + s});
    position.push_back(x);
  };
  for (int s = 0; s < int(surfaces.size()); ++s) {
    const int earlier = int(images.list.size());
    for (int i = 0; i < p.count; ++i) consider(i, s);
    for (int g = 0; g < earlier; ++g) consider(images.first + g, s);
  }
}

template <class Geometry>
void reflect_wall_motion(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                         std::size_t mirrors, Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
  for (std::size_t k = first_of_walls(images, mirrors); k < images.list.size(); ++k) {
    const auto& surface = surfaces[images.list[k].mirror - mirrors];
    auto& record = records.motion[images.first + k];
    record = records.motion[images.list[k].source];
    const auto n = normal_of(surface, record.position);
    reflect(surface, record.position);
    reflect_velocity<D>(surface, n, record.velocity);
    const auto chain = chain_of(images, mirrors, images.first + int(k));
    const auto& root = records.motion[chain.root];
    const bool there = has_place(surfaces, chain, place(root.position), place(record.position));
    record.volume = there ? root.volume * stretch_of(surfaces, chain, place(root.position)) : 0;
  }
}

template <class Geometry>
void reflect_wall_stress(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                         std::size_t mirrors, const Scene& scene, Records<Geometry>& records) {
  for (std::size_t k = first_of_walls(images, mirrors); k < images.list.size(); ++k) {
    const auto& surface = surfaces[images.list[k].mirror - mirrors];
    const auto& position = records.motion[images.list[k].source].position;
    auto& record = records.stress[images.first + k];
    record = records.stress[images.list[k].source];
    reflect_fields<Geometry>(surface, normal_of(surface, position), distance(surface, position), scene,
                             record);
  }
}

template void add_wall_images(const Particles<PlaneStrain>&, const std::vector<Surface<2>>&, std::size_t,
                              double, Images&);
template void add_wall_images(const Particles<Axisymmetric>&, const std::vector<Surface<2>>&, std::size_t,
                              double, Images&);
template void add_wall_images(const Particles<ThreeDimensional>&, const std::vector<Surface<3>>&, std::size_t,
                              double, Images&);
template void reflect_wall_motion(const Images&, const std::vector<Surface<2>>&, std::size_t,
                                  Records<PlaneStrain>&);
template void reflect_wall_motion(const Images&, const std::vector<Surface<2>>&, std::size_t,
                                  Records<Axisymmetric>&);
template void reflect_wall_motion(const Images&, const std::vector<Surface<3>>&, std::size_t,
                                  Records<ThreeDimensional>&);
template void reflect_wall_stress(const Images&, const std::vector<Surface<2>>&, std::size_t, const Scene&,
                                  Records<PlaneStrain>&);
template void reflect_wall_stress(const Images&, const std::vector<Surface<2>>&, std::size_t, const Scene&,
                                  Records<Axisymmetric>&);
template void reflect_wall_stress(const Images&, const std::vector<Surface<3>>&, std::size_t, const Scene&,
                                  Records<ThreeDimensional>&);

} // namespace host
