// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/surfaces.hpp"

namespace host {
namespace {

int vertical_axis(const Scene& scene) {
  return scene.geometry == GeometryKind::three_dimensional ? 2 : 1;
}

Wall floor_wall(const Scene& scene) {
  Wall wall;
  wall.name = "floor";
  wall.no_slip = scene.floor.no_slip;
  wall.friction = scene.floor.friction;
  wall.normal[vertical_axis(scene)] = 1;
  return wall;
}

Wall gate_wall(const Scene& scene) {
  const int up = vertical_axis(scene);
  Wall wall;
  wall.name = "gate";
  wall.shape = WallShape::cylinder;
  wall.radius = scene.gate.radius;
  wall.lower[up] = -unbounded;
  wall.upper[up] = unbounded;
  if (scene.gate.motion != GateMotion::lift) return wall;
  constexpr double for_ever = 1e6; // s
  WallVector velocity{};
  velocity[up] = scene.gate.speed;
  wall.lower[up] = 0;
  wall.motion = {{0, for_ever}, {velocity, velocity}};
  return wall;
}

/// Makes the surfaces of one wall, displaced by `shift`.
template <int D> struct Builder {
  std::vector<Surface<D>>& list;
  Surface<D> common;
  Vector<D> shift;

  /// The plane coordinate `axis` = `at`, with the sand at larger coordinates if `side` is 1, at smaller ones if it is -1.
  void plane(int axis, double at, double side) {
    if (std::abs(at) >= 0.5 * unbounded) return;
    Surface<D> s = common;
    s.axis = axis;
    s.point[axis] = at + shift[axis];
    s.normal[axis] = side;
    list.push_back(s);
  }

  /// Sides of the box [lower, upper], already in `common`, from axis `first` on.
  void sides(const Vector<D>& lower, const Vector<D>& upper, int first, double outwards) {
    for (int axis = first; axis < D; ++axis) {
      plane(axis, lower[axis], -outwards);
      plane(axis, upper[axis], outwards);
    }
  }

  void bound(const Vector<D>& lower, const Vector<D>& upper) {
    for (int a = 0; a < D; ++a) {
      common.lower[a] = lower[a] + shift[a];
      common.upper[a] = upper[a] + shift[a];
    }
  }
};

template <int D> void add_plane(const Wall& wall, Builder<D>& build) {
  Surface<D> s = build.common;
  for (int a = 0; a < D; ++a) {
    s.point[a] = wall.point[a] + build.shift[a];
    s.normal[a] = wall.normal[a];
    if (std::abs(wall.normal[a]) == 1) s.axis = a;
  }
  build.list.push_back(s);
}

template <int D> void add_box(const Wall& wall, Builder<D>& build) {
  const auto lower = vector_of<D>(wall.lower), upper = vector_of<D>(wall.upper);
  build.bound(lower, upper);
  build.common.extent = wall.inside ? Extent::whole : Extent::body;
  build.sides(lower, upper, 0, wall.inside ? -1 : 1);
}

/// In the plane a cylinder is one strip about the axis.
void add_cylinder(const Wall& wall, bool axisymmetric, Builder<2>& build) {
  const Vector<2> lower{wall.center[0] - wall.radius, wall.lower[1]},
      upper{wall.center[0] + wall.radius, wall.upper[1]};
  build.bound(lower, upper);
  build.common.extent = wall.inside ? Extent::shell : Extent::body;
  if (!wall.inside) return build.sides(lower, upper, 0, 1);
  if (!axisymmetric) build.plane(0, lower[0], 1);
  build.plane(0, upper[0], -1);
}

void add_cylinder(const Wall& wall, bool, Builder<3>& build) {
  const auto center = vector_of<3>(wall.center);
  build.bound({center[0] - wall.radius, center[1] - wall.radius, wall.lower[2]},
              {center[0] + wall.radius, center[1] + wall.radius, wall.upper[2]});
  build.common.radius = wall.radius;
  build.common.side = wall.inside ? -1 : 1;
  for (int a = 0; a < 2; ++a) build.common.center[a] = center[a] + build.shift[a];
  build.common.extent = wall.inside ? Extent::shell : Extent::body;
  if (!wall.inside) build.sides(vector_of<3>(wall.lower), vector_of<3>(wall.upper), 2, 1);
  Surface<3> mantle = build.common;
  mantle.mantle = true;
  build.list.push_back(mantle);
}

template <int D>
Builder<D> builder_of(const Wall& wall, int number, double time, double dt, std::vector<Surface<D>>& list) {
  Builder<D> build{list, {}, {}};
  build.common.wall = number;
  build.common.no_slip = wall.no_slip;
  const auto now = wall.motion.displacement(time);
  const auto before = dt > 0 ? wall.motion.displacement(time - dt) : now;
  for (int a = 0; a < D; ++a) {
    build.shift[a] = now[a];
    build.common.velocity[a] = dt > 0 ? (now[a] - before[a]) / dt : 0;
  }
  return build;
}

} // namespace

std::vector<Wall> all_walls(const Scene& scene) {
  std::vector<Wall> walls;
  if (scene.floor.present) walls.push_back(floor_wall(scene));
  if (scene.gate.motion != GateMotion::remove) walls.push_back(gate_wall(scene));
  walls.insert(walls.end(), scene.walls.begin(), scene.walls.end());
  return walls;
}

template <int D>
void find_surfaces(int planes_of_symmetry, const std::vector<Wall>& walls, GeometryKind geometry, double time,
                   double dt, std::vector<Surface<D>>& list) {
  list.clear();
  Builder<D> symmetry{list, {}, {}};
  for (int axis = 0; axis < planes_of_symmetry; ++axis) symmetry.plane(axis, 0, 1);
  for (std::size_t w = 0; w < walls.size(); ++w) {
    auto build = builder_of(walls[w], int(w), time, dt, list);
    if (walls[w].shape == WallShape::plane) add_plane(walls[w], build);
    if (walls[w].shape == WallShape::box) add_box(walls[w], build);
    if (walls[w].shape == WallShape::cylinder)
      add_cylinder(walls[w], geometry == GeometryKind::axisymmetric, build);
  }
}

double part_across(const Wall& wall, int vertical_axis, const WallVector& motion) {
  const auto& n = wall.normal;
  if (wall.shape == WallShape::plane) return std::abs(motion[0] * n[0] + motion[1] * n[1] + motion[2] * n[2]);
  const bool shell = wall.shape == WallShape::cylinder && wall.inside;
  double square = 0;
  for (int a = 0; a < 3; ++a)
    if (!shell || a != vertical_axis) square += motion[a] * motion[a];
  return std::sqrt(square);
}

template decltype(find_surfaces<2>) find_surfaces<2>;
template decltype(find_surfaces<3>) find_surfaces<3>;

} // namespace host
