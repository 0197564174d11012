// SPDX-License-Identifier: BSD-3-Clause
#include "host/mirrors.hpp"
#include "host/geometry.hpp"
#include <cmath>

namespace host {
namespace {

/// False for what the mirror does not reach: below the wall's edge, or already past it. The image then
/// has no volume and takes part in nothing.
template <int D> bool acts_on(const Mirror& m, const double (&position)[D]) {
  const double depth = m.positive_side ? position[m.axis] - m.position : m.position - position[m.axis];
  return depth >= 0 && (m.axis == D - 1 || std::abs(position[D - 1]) >= m.lower_edge);
}

template <int D> void reflect_position(const Mirror& m, double (&position)[D]) {
  position[m.axis] = 2 * m.position - position[m.axis];
}

template <int D> void reflect_velocity(const Mirror& m, double (&velocity)[D]) {
  velocity[m.axis] = -velocity[m.axis];
}

} // namespace

std::vector<Mirror> scene_mirrors(const Scene& scene) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const Mirror axis{.axis = 0, .position = 0, .positive_side = true, .wall = false, .lower_edge = -far};
  const Mirror floor{.axis = 1,
                     .position = 0,
                     .positive_side = true,
                     .wall = true,
                     .weight_gradient = scene.bulk_density * scene.gravity,
                     .horizontal_ratio = scene.earth_pressure_ratio,
                     .lower_edge = -far};
  const Mirror gate{.axis = 0,
                    .position = scene.column.radius,
                    .positive_side = false,
                    .wall = true,
                    .lower_edge = scene.gate.lower_edge(0)};
  if (scene.gate.motion == GateMotion::remove) return {axis, floor};
  return {axis, floor, gate};
}

void move_gate(std::vector<Mirror>& mirrors, const Scene& scene, double time) {
  if (mirrors.size() > 2) mirrors[2].lower_edge = scene.gate.lower_edge(time);
}

template <class Geometry>
Images find_images(const Particles<Geometry>& p, const std::vector<Mirror>& mirrors, double reach) {
  constexpr int D = Geometry::dimension;
  Images images;
  images.first = images.first_wall = p.padded();
  std::vector<std::array<double, D>> position; // of the images so far
  const auto consider = [&](int source, std::array<double, D> x, int m) {
    const Mirror& mirror = mirrors[m];
    const double depth = (mirror.positive_side ? 1 : -1) * (x[mirror.axis] - mirror.position);
    if (depth < -reach / 2 || depth > reach ||
        (mirror.axis != D - 1 && std::abs(x[D - 1]) < mirror.lower_edge))
      return;
    x[mirror.axis] = 2 * mirror.position - x[mirror.axis];
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
  int at = images.first;
  for (const Image& image : images.list) {
    const Mirror& mirror = mirrors[image.mirror];
    auto& record = records.motion[at++];
    record = records.motion[image.source];
    if (!acts_on(mirror, record.position)) record.volume = 0;
    reflect_position(mirror, record.position);
    reflect_velocity(mirror, record.velocity);
  }
}

template <class Geometry>
void reflect_stress(const Images& images, const std::vector<Mirror>& mirrors, Records<Geometry>& records) {
  constexpr int D = Geometry::dimension;
  int at = images.first;
  for (const Image& image : images.list) {
    const Mirror& mirror = mirrors[image.mirror];
    auto& record = records.stress[at++];
    record = records.stress[image.source];
    if (!acts_on(mirror, record.position)) record.volume = 0;
    const double depth = record.position[mirror.axis] - mirror.position;
    reflect_position(mirror, record.position);
    reflect_velocity(mirror, record.velocity);
    const double weight = Geometry::weight(record.position[0]);
    const double ratio = weight / record.weight;
    record.weight = weight;
    for (int a = 0; a < D; ++a)
      for (int b = 0; b < D; ++b) {
        // Reflection turns the sign of shear on the plane; friction is a force of its own.
        const bool turns = (a == mirror.axis) != (b == mirror.axis);
        if (turns) record.gradient[a * D + b] *= -1;
        if (a > b) continue;
        const int c = component<D>(a, b);
        record.flux[c] *= turns ? -ratio : ratio;
        if (turns) record.reduced_stress[c] *= -1;
      }
    // The image lies deeper by twice the particle's height: carry the weight on, or the gradient of
    // the vertical stress would vanish at the floor.
    for (int a = 0; a < D; ++a)
      record.flux[a] -=
          weight * mirror.weight_gradient * 2 * depth * (a == D - 1 ? 1 : mirror.horizontal_ratio);
  }
}

template Images find_images(const Particles<PlaneStrain>&, const std::vector<Mirror>&, double);
template Images find_images(const Particles<Axisymmetric>&, const std::vector<Mirror>&, double);
template void reflect_motion(const Images&, const std::vector<Mirror>&, Records<PlaneStrain>&);
template void reflect_motion(const Images&, const std::vector<Mirror>&, Records<Axisymmetric>&);
template void reflect_stress(const Images&, const std::vector<Mirror>&, Records<PlaneStrain>&);
template void reflect_stress(const Images&, const std::vector<Mirror>&, Records<Axisymmetric>&);

} // namespace host
