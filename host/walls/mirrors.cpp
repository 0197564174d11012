// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/mirrors.hpp"
#include "host/scheme/geometry.hpp"
#include <cmath>

namespace host {
namespace {

/// False for what the mirror does not reach: below the wall's edge, or already past it. The image then
/// has no volume and takes part in nothing.
template <int D> bool acts_on(const Mirror& m, const double (&position)[D]) {
  return depth_behind(m, position) >= 0 && (!ends_below<D>(m) || std::abs(position[D - 1]) >= m.lower_edge);
}

/// Reflects `position`; returns how much longer the circle of the image is, 1 at a plane.
template <class Point> double reflect_position(const Mirror& m, Point& position) {
  if (!m.cylinder()) {
    position[m.axis] = 2 * m.position - position[m.axis];
    return 1;
  }
  const double r = from_axis(position), stretch = (2 * m.position - r) / r;
  position[0] *= stretch;
  position[1] *= stretch;
  return stretch;
}

/// Reflects a vector in the plane of normal `n`.
template <int D> void reflect_vector(const std::array<double, D>& n, double (&v)[D]) {
  double twice_normal = 0;
  for (int a = 0; a < D; ++a) twice_normal += 2 * n[a] * v[a];
  for (int a = 0; a < D; ++a) v[a] -= twice_normal * n[a];
}

template <int D> void reflect_velocity(const Mirror& m, const std::array<double, D>& n, double (&v)[D]) {
  if (m.no_slip)
    for (double& component : v) component = -component;
  else if (m.cylinder())
    reflect_vector<D>(n, v);
  else
    v[m.axis] = -v[m.axis];
}

/// H s H of a symmetric tensor in the order of the VUMAT whose shear components are `shear` times the tensor's,
/// H the reflection in the plane of normal `n`.
template <class Real> void reflect_symmetric(const std::array<double, 3>& n, double shear, Real (&s)[6]) {
  double t[3] = {}, normal = 0; // s n, n s n
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) t[a] += (a == b ? 1 : 1 / shear) * s[component<3>(a, b)] * n[b];
  for (int a = 0; a < 3; ++a) normal += n[a] * t[a];
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b)
      s[component<3>(a, b)] +=
          Real((a == b ? 1 : shear) * (4 * normal * n[a] * n[b] - 2 * (n[a] * t[b] + t[a] * n[b])));
}

/// Where mirrors stand along the axes, shear with their own changes its sign; at a cylinder `n` counts.
template <class Geometry>
void reflect_symmetric(const Mirror&, const std::array<double, 2>&, StressRecord<Geometry>& record) {
  record.stress[3] = -record.stress[3];
  record.strain_rate[2] = -record.strain_rate[2];
}
void reflect_symmetric(const Mirror& mirror, const std::array<double, 3>& n,
                       StressRecord<ThreeDimensional>& record) {
  if (mirror.cylinder()) {
    reflect_symmetric(n, 1, record.stress);
    reflect_symmetric(n, 2, record.strain_rate);
    return;
  }
  for (int b = 0; b < 3; ++b) {
    if (b == mirror.axis) continue;
    const int shear = component<3>(mirror.axis, b);
    record.stress[shear] = -record.stress[shear];
    record.strain_rate[shear] = -record.strain_rate[shear];
  }
}

/// Stress and velocity gradient behind a mirror. Reflection turns the sign of shear on a plane, but where nothing slips;
/// friction is a force of its own. The image in the floor lies deeper by twice the particle's height: the weight is carried on, or the
/// gradient of the vertical stress would vanish there.
template <class Geometry, std::size_t D>
void reflect_tensors(const Mirror& mirror, const std::array<double, D>& n, double depth,
                     StressRecord<Geometry>& record) {
  if (!mirror.no_slip) reflect_symmetric(mirror, n, record);
  for (std::size_t a = 0; a < D; ++a)
    record.stress[a] -= mirror.weight_gradient * 2 * depth * (a == D - 1 ? 1 : mirror.horizontal_ratio);
}

Mirror plane_of_symmetry(int axis) {
  return {.axis = axis, .lower_edge = -std::numeric_limits<double>::infinity()};
}

} // namespace

std::vector<Mirror> scene_mirrors(const Scene& scene) {
  const bool solid = scene.geometry == GeometryKind::three_dimensional;
  std::vector<Mirror> mirrors;
  for (int axis = 0; axis < planes_of_symmetry(scene); ++axis) mirrors.push_back(plane_of_symmetry(axis));
  if (!scene.walls.empty()) return mirrors; // then all walls are surfaces (host/walls/wall_images.hpp)
  Mirror floor = plane_of_symmetry(solid ? 2 : 1);
  floor.wall = true;
  floor.no_slip = scene.floor.no_slip;
  floor.weight_gradient = scene.bulk_density * scene.gravity;
  floor.horizontal_ratio = scene.earth_pressure_ratio;
  mirrors.push_back(floor);
  if (scene.gate.motion != GateMotion::remove)
    mirrors.push_back({.axis = solid ? Mirror::radial : 0,
                       .position = scene.gate.radius,
                       .positive_side = false,
                       .wall = true,
                       .gate = true,
                       .lower_edge = scene.gate.lower_edge(0)});
  return mirrors;
}

void move_gate(std::vector<Mirror>& mirrors, const Scene& scene, double time) {
  for (Mirror& mirror : mirrors)
    if (mirror.gate) mirror.lower_edge = scene.gate.lower_edge(time);
}

template <class Geometry>
Images find_images(const Particles<Geometry>& p, const std::vector<Mirror>& mirrors, double reach) {
  constexpr int D = Geometry::dimension;
  Images images;
  images.first = images.first_wall = p.padded();
  std::vector<std::array<double, D>> position; // of the images so far
  const auto consider = [&](int source, std::array<double, D> x, int m) {
    const Mirror& mirror = mirrors[m];
    const double depth = depth_behind(mirror, x);
    if (depth < -reach / 2 || depth > reach ||
        (ends_below<D>(mirror) && std::abs(x[D - 1]) < mirror.lower_edge))
      return;
    reflect_position(mirror, x);
    images.list.push_back({source, m});
    position.push_back(x);
  };
  bool walls_begun = false;
  for (int m = 0; m < int(mirrors.size()); ++m) {
    if (mirrors[m].wall && !walls_begun) {
      images.first_wall = images.first + int(images.list.size());
      walls_begun = true;
    }
    const int earlier = int(images.list.size());
    for (int i = 0; i < p.count; ++i) {
      std::array<double, D> x;
      for (int a = 0; a < D; ++a) x[a] = p.position[a][i];
      consider(i, x, m);
    }
    for (int g = 0; g < earlier; ++g) consider(images.first + g, position[g], m);
  }
  if (!walls_begun) images.first_wall = images.first + int(images.list.size());
  return images;
}

template <class Geometry>
void reflect_motion(const Images& images, const std::vector<Mirror>& mirrors, Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
  int at = images.first;
  for (const Image& image : images.list) {
    if (image.mirror >= int(mirrors.size())) break; // behind a surface
    const Mirror& mirror = mirrors[image.mirror];
    auto& record = records.motion[at++];
    record = records.motion[image.source];
    if (!acts_on(mirror, record.position)) record.volume = 0;
    const auto n = normal_at<D>(mirror, record.position);
    record.volume *= reflect_position(mirror, record.position);
    reflect_velocity<D>(mirror, n, record.velocity);
  }
}

template <class Geometry>
void reflect_stress(const Images& images, const std::vector<Mirror>& mirrors, Records<Geometry>& records) {
  int at = images.first;
  for (const Image& image : images.list) {
    if (image.mirror >= int(mirrors.size())) break; // behind a surface
    const Mirror& mirror = mirrors[image.mirror];
    const auto& position = records.motion[image.source].position;
    auto& record = records.stress[at++];
    record = records.stress[image.source];
    reflect_tensors(mirror, normal_at<Geometry::dimension>(mirror, position), depth_behind(mirror, position),
                    record);
  }
}

template Images find_images(const Particles<PlaneStrain>&, const std::vector<Mirror>&, double);
template Images find_images(const Particles<Axisymmetric>&, const std::vector<Mirror>&, double);
template Images find_images(const Particles<ThreeDimensional>&, const std::vector<Mirror>&, double);
template void reflect_motion(const Images&, const std::vector<Mirror>&, Records<PlaneStrain>&);
template void reflect_motion(const Images&, const std::vector<Mirror>&, Records<Axisymmetric>&);
template void reflect_motion(const Images&, const std::vector<Mirror>&, Records<ThreeDimensional>&);
template void reflect_stress(const Images&, const std::vector<Mirror>&, Records<PlaneStrain>&);
template void reflect_stress(const Images&, const std::vector<Mirror>&, Records<Axisymmetric>&);
template void reflect_stress(const Images&, const std::vector<Mirror>&, Records<ThreeDimensional>&);

} // namespace host
