// SPDX-License-Identifier: BSD-3-Clause
#include "host/scheme/geometry.hpp"
#include "host/walls/images.hpp"

namespace host {
namespace {

/// True if surface `own` has an image of sand at `x`: sand in front of it, where the surface exists. Behind an edge of a
/// body each of its surfaces has the part of the solid that is nearest to it.
template <int D>
bool has_image(const std::vector<Surface<D>>& surfaces, const Surface<D>& own, const Vector<D>& x) {
  if (distance(own, x) < 0 || !beside(own, x)) return false;
  if (own.extent != Extent::body) return true;
  auto image = x;
  reflect(own, image);
  if (body_distance(own, image) >= 0) return false;
  const double depth = distance(own, image);
  return std::ranges::none_of(surfaces, [&](const Surface<D>& other) {
    return other.wall == own.wall && &other != &own && distance(other, image) > depth;
  });
}

/// True if the solid behind `other`, seen by sand at `root`, reaches deeper around `image` than `depth`. A shell hides
/// from the sand on one side what is on the other.
template <int D>
bool is_deeper_in(const Surface<D>& other, const Vector<D>& root, const Vector<D>& image, double depth) {
  if (other.is_symmetry() || !beside(other, root)) return false;
  if (other.extent == Extent::shell && distance(other, root) < 0) return false;
  return body_distance(other, image) < depth;
}

/// True if the image of a particle at `root` has its place to itself. Where two solids overlap it belongs to the one
/// that it lies deeper in. Images of images fill what single ones leave empty.
template <int D>
bool has_place(const std::vector<Surface<D>>& surfaces, const ImagePath& path, const Vector<D>& root,
               const Vector<D>& image) {
  for (const int s : path.all())
    if (!has_image(surfaces, surfaces[s], root)) return false;
  if (path.length == 1) {
    if (!path.crowded) return true; // the root is near no other surface
    const auto& own = surfaces[path.surface[0]];
    const double depth = distance(own, image);
    return std::ranges::none_of(surfaces, [&](const Surface<D>& other) {
      const bool same_body = own.extent == Extent::body && other.wall == own.wall;
      return &other != &own && !same_body && is_deeper_in(other, root, image, depth);
    });
  }
  const auto behind = [&](int s, const Vector<D>& x) { return distance(surfaces[s], x) < 0; };
  if (std::ranges::none_of(path.all(), [&](int s) { return behind(s, image); })) return false;
  return std::ranges::all_of(path.all(), [&](int s) {
    auto seen = image;
    reflect(surfaces[s], seen);
    return std::ranges::any_of(path.all(), [&](int other) { return other != s && behind(other, seen); });
  });
}

/// Volume of the image over that of the particle at `x`.
template <int D>
double stretch_along(const std::vector<Surface<D>>& surfaces, const ImagePath& path, Vector<D> x) {
  double stretch = 1;
  for (int k = path.length; k-- > 0;) stretch *= reflect(surfaces[path.surface[k]], x);
  return stretch;
}

/// The velocity of the image: reflected for an observer who moves with the surface; without slip reversed for him, so
/// that the velocity at the wall is the wall's.
template <int D> void reflect_velocity(const Surface<D>& s, const Vector<D>& n, double (&v)[D]) {
  if (s.no_slip) {
    for (int a = 0; a < D; ++a) v[a] = 2 * s.velocity[a] - v[a];
    return;
  }
  double twice = 0;
  for (int a = 0; a < D; ++a) twice += 2 * n[a] * (v[a] - s.velocity[a]);
  for (int a = 0; a < D; ++a) v[a] -= twice * n[a];
}

/// s += H s H - s of a symmetric tensor whose component of the axes a and b is s[component(a, b)], shear being `shear`
/// times the tensor's; H = 1 - 2 n n is the reflection in the plane of normal `n`.
template <int D, class Component, class Real, std::size_t S>
void reflect_symmetric(const Vector<D>& n, double shear, const Component& component, Real (&s)[S]) {
  double t[D] = {}, normal = 0; // s n, n s n
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b) t[a] += (a == b ? 1 : 1 / shear) * s[component(a, b)] * n[b];
  for (int a = 0; a < D; ++a) normal += n[a] * t[a];
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b)
      s[component(a, b)] +=
          Real((a == b ? 1 : shear) * (4 * normal * n[a] * n[b] - 2 * (n[a] * t[b] + t[a] * n[b])));
}

/// Component of the strain rate of the axes a and b, which has no hoop part.
template <int D> constexpr int rate_component(int a, int b) {
  return a == b ? a : component<D>(a, b) - (D == 2 ? 1 : 0);
}

/// Reflection turns the sign of shear across the surface, except where nothing slips: there shear goes on.
template <class Geometry, int D = Geometry::dimension>
void reflect_tensors(const Surface<D>& s, const Vector<D>& n, StressRecord<Geometry>& record) {
  if (s.no_slip) return;
  if (s.axis == Surface<D>::oblique) {
    reflect_symmetric<D>(n, 1, component<D>, record.stress);
    reflect_symmetric<D>(n, 2, rate_component<D>, record.strain_rate);
    return;
  }
  for (int b = 0; b < D; ++b) {
    if (b == s.axis) continue;
    double& shear = record.stress[component<D>(s.axis, b)];
    float& rate = record.strain_rate[rate_component<D>(s.axis, b)];
    shear = -shear;
    rate = -rate;
  }
}

/// Adds the stress by which the weight of the sand between a particle and its image, `depth` behind the surface and in
/// front of it, makes them differ.
template <class Geometry, int D = Geometry::dimension>
void add_weight(const Vector<D>& n, double depth, const Medium& medium, StressRecord<Geometry>& record) {
  if (n[D - 1] == 0) return;
  const double across = -medium.unit_weight() * n[D - 1] * 2 * depth;
  const double along = medium.earth_pressure_ratio * across;
  for (int a = 0; a < D; ++a)
    for (int b = a; b < D; ++b)
      record.stress[component<D>(a, b)] += (across - along) * n[a] * n[b] + (a == b ? along : 0);
}

} // namespace

template <class Geometry>
void reflect_motion(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                    Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
  for (std::size_t k = 0; k < images.list.size(); ++k) {
    const auto& surface = surfaces[images.list[k].surface];
    const auto& path = images.paths[k];
    auto& record = records.motion[images.first + k];
    record = records.motion[images.list[k].source];
    const auto n = normal_of(surface, record.position);
    if (surface.is_symmetry() && distance(surface, record.position) < 0) record.volume = 0;
    reflect(surface, record.position);
    reflect_velocity<D>(surface, n, record.velocity);
    if (surface.is_symmetry()) continue;
    const auto& root = records.motion[path.root];
    const auto from = vector_of<D>(root.position);
    record.volume = has_place(surfaces, path, from, vector_of<D>(record.position))
                        ? root.volume * stretch_along(surfaces, path, from)
                        : 0;
  }
}

template <class Geometry>
void reflect_stress(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                    const Medium& medium, Records<Geometry>& records) {
  for (std::size_t k = 0; k < images.list.size(); ++k) {
    const auto& surface = surfaces[images.list[k].surface];
    const auto& position = records.motion[images.list[k].source].position;
    const auto n = normal_of(surface, position);
    auto& record = records.stress[images.first + k];
    record = records.stress[images.list[k].source];
    reflect_tensors<Geometry>(surface, n, record);
    add_weight<Geometry>(n, distance(surface, position), medium, record);
  }
}

template decltype(reflect_motion<PlaneStrain>) reflect_motion<PlaneStrain>;
template decltype(reflect_motion<Axisymmetric>) reflect_motion<Axisymmetric>;
template decltype(reflect_motion<ThreeDimensional>) reflect_motion<ThreeDimensional>;
template decltype(reflect_stress<PlaneStrain>) reflect_stress<PlaneStrain>;
template decltype(reflect_stress<Axisymmetric>) reflect_stress<Axisymmetric>;
template decltype(reflect_stress<ThreeDimensional>) reflect_stress<ThreeDimensional>;

} // namespace host
