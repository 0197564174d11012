// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/surfaces.hpp"

namespace host {
namespace {

Wall floor_wall(const Floor& floor) {
  Wall wall;
  wall.name = "floor";
  wall.no_slip = floor.no_slip;
  wall.friction = floor.friction;
  return wall; // its normal is set where the dimension is known
}

/// The gate as a smooth cylinder; while it has not moved it reaches below the floor.
Wall gate_wall(const Scene& scene, int up) {
  Wall wall;
  wall.name = "gate";
  wall.shape = WallShape::cylinder;
  wall.radius = scene.gate.radius;
  wall.lower[up] = scene.gate.motion == GateMotion::lift ? 0 : -unbounded;
  wall.upper[up] = unbounded;
  if (scene.gate.motion == GateMotion::lift) {
    WallVector velocity{};
    velocity[up] = scene.gate.speed;
    wall.motion = {{0, 1e6}, {velocity, velocity}};
  }
  return wall;
}

/// Makes the surfaces of one wall, displaced by `shift`.
template <int D> struct Builder {
  std::vector<Surface<D>>& list;
  Surface<D> common;
  Point<D> shift;

  void plane(int axis, double at, double side) {
    if (std::abs(at) >= 0.5 * unbounded) return;
    Surface<D> s = common;
    s.point[axis] = at + shift[axis];
    s.normal[axis] = side;
    list.push_back(s);
  }

  /// Sides of the box [lower, upper], already in `common`, from axis `first` on.
  void sides(const Point<D>& lower, const Point<D>& upper, int first, double outwards) {
    for (int axis = first; axis < D; ++axis) {
      plane(axis, lower[axis], -outwards);
      plane(axis, upper[axis], outwards);
    }
  }

  void bound(const Point<D>& lower, const Point<D>& upper) {
    for (int a = 0; a < D; ++a) {
      common.lower[a] = lower[a] + shift[a];
      common.upper[a] = upper[a] + shift[a];
    }
  }
};

template <int D> Point<D> of(const WallVector& v) {
  Point<D> p;
  for (int a = 0; a < D; ++a) p[a] = v[a];
  return p;
}

template <int D> void add_box(const Wall& wall, Builder<D>& build) {
  const auto lower = of<D>(wall.lower), upper = of<D>(wall.upper);
  build.bound(lower, upper);
  build.common.obstacle = !wall.inside;
  build.sides(lower, upper, 0, wall.inside ? -1 : 1);
}

/// In the plane a cylinder is one strip about the axis.
void add_cylinder(const Wall& wall, bool axisymmetric, Builder<2>& build) {
  const Point<2> lower{wall.center[0] - wall.radius, wall.lower[1]},
      upper{wall.center[0] + wall.radius, wall.upper[1]};
  build.bound(lower, upper);
  build.common.obstacle = !wall.inside;
  build.common.shell = wall.inside;
  if (!wall.inside) return build.sides(lower, upper, 0, 1);
  if (!axisymmetric) build.plane(0, lower[0], 1);
  build.plane(0, upper[0], -1);
}

void add_cylinder(const Wall& wall, bool, Builder<3>& build) {
  const auto center = of<3>(wall.center);
  build.bound({center[0] - wall.radius, center[1] - wall.radius, wall.lower[2]},
              {center[0] + wall.radius, center[1] + wall.radius, wall.upper[2]});
  build.common.radius = wall.radius;
  build.common.side = wall.inside ? -1 : 1;
  for (int a = 0; a < 2; ++a) build.common.center[a] = center[a] + build.shift[a];
  build.common.obstacle = !wall.inside;
  build.common.shell = wall.inside;
  if (!wall.inside) build.sides(of<3>(wall.lower), of<3>(wall.upper), 2, 1);
  Surface<3> mantle = build.common;
  mantle.mantle = true;
  build.list.push_back(mantle);
}

} // namespace

std::vector<Wall> all_walls(const Scene& scene) {
  const int up = scene.geometry == GeometryKind::three_dimensional ? 2 : 1;
  std::vector<Wall> walls;
  if (scene.floor.present) {
    walls.push_back(floor_wall(scene.floor));
    walls.back().normal[up] = 1;
  }
  if (scene.gate.motion != GateMotion::remove) walls.push_back(gate_wall(scene, up));
  walls.insert(walls.end(), scene.walls.begin(), scene.walls.end());
  return walls;
}

template <int D>
void find_surfaces(const std::vector<Wall>& walls, GeometryKind geometry, double time, double dt,
                   std::vector<Surface<D>>& list) {
  list.clear();
  for (std::size_t w = 0; w < walls.size(); ++w) {
    const Wall& wall = walls[w];
    Builder<D> build{list, {}, {}};
    build.common.wall = int(w);
    build.common.no_slip = walls[w].no_slip;
    const auto now = wall.motion.displacement(time);
    const auto before = dt > 0 ? wall.motion.displacement(time - dt) : now;
    for (int a = 0; a < D; ++a) {
      build.shift[a] = now[a];
      build.common.velocity[a] = dt > 0 ? (now[a] - before[a]) / dt : 0;
    }
    if (wall.shape == WallShape::box)
      add_box(wall, build);
    else if (wall.shape == WallShape::cylinder)
      add_cylinder(wall, geometry == GeometryKind::axisymmetric, build);
    else {
      Surface<D> plane = build.common;
      for (int a = 0; a < D; ++a) {
        plane.point[a] = wall.point[a] + build.shift[a];
        plane.normal[a] = wall.normal[a];
      }
      list.push_back(plane);
    }
  }
}

template void find_surfaces(const std::vector<Wall>&, GeometryKind, double, double, std::vector<Surface<2>>&);
template void find_surfaces(const std::vector<Wall>&, GeometryKind, double, double, std::vector<Surface<3>>&);

} // namespace host
