// SPDX-License-Identifier: BSD-3-Clause
#include "host/walls/images.hpp"
#include "host/scheme/geometry.hpp"

namespace host {
namespace {

/// The path of image number `record`, from that of its source. Planes of symmetry are no part of it.
template <int D>
ImagePath path_of(const Images& images, const Image& image, const Surface<D>& surface, int record) {
  if (surface.is_symmetry()) return {.root = record};
  ImagePath path{.root = image.source};
  if (image.source >= images.first) path = images.path(image.source);
  for (int k = path.length++; k > 0; --k) path.surface[k] = path.surface[k - 1];
  path.surface[0] = image.surface;
  path.in_shell |= surface.extent == Extent::shell;
  return path;
}

/// How far beyond the reach of lists bodies and shells have images: they move along themselves.
constexpr double along = 1.5;

/// Marks single images whose root has several.
void mark_crowded(Images& images) {
  std::vector<int> count(images.first + images.list.size(), 0);
  for (const auto& path : images.paths) count[path.root] += path.length == 1;
  for (auto& path : images.paths) path.crowded = count[path.root] > 1;
}

/// A cluster is near those surfaces in which its particles have images.
template <int D> void find_nearness(const std::vector<Surface<D>>& surfaces, double reach, Images& images) {
  images.nearness.assign(images.first / lanes, Nearness::none);
  for (const Image& image : images.list) {
    if (image.source >= images.first) continue;
    auto& nearness = images.nearness[image.source / lanes];
    if (!surfaces[image.surface].is_symmetry())
      nearness = Nearness::wall;
    else if (nearness == Nearness::none)
      nearness = Nearness::symmetry;
  }
  images.within_reach.clear();
  for (std::size_t s = 0; s < surfaces.size(); ++s)
    if (images.clearance[s] <= along * reach) images.within_reach.push_back(int(s));
}

/// True if an image of `source` in surface `s` may be needed.
template <int D>
bool may_reflect(const std::vector<Surface<D>>& surfaces, int s, const Vector<D>& x, double reach,
                 double least_depth) {
  const double depth = distance(surfaces[s], x);
  if (depth < least_depth || depth > reach) return false;
  return surfaces[s].extent == Extent::whole || gap(surfaces[s], x) <= along * reach;
}

/// False if a path that goes on with surface `s` leads nowhere: it is too long, or into a corner inside of a body.
template <int D> bool goes_on(const std::vector<Surface<D>>& surfaces, const ImagePath& path, int s) {
  if (path.length == ImagePath::longest) return false;
  return std::ranges::none_of(path.all(), [&](int e) {
    return surfaces[s].extent == Extent::body && surfaces[e].wall == surfaces[s].wall;
  });
}

} // namespace

template <int D> void complete_images(const std::vector<Surface<D>>& surfaces, double reach, Images& images) {
  images.paths.clear();
  int record = images.first;
  for (const Image& image : images.list)
    images.paths.push_back(path_of(images, image, surfaces[image.surface], record++));
  mark_crowded(images);
  find_nearness(surfaces, reach, images);
}

template <class Geometry>
void find_images(const Particles<Geometry>& p, const std::vector<Surface<Geometry::dimension>>& surfaces,
                 double reach, double skin, Images& images) {
  constexpr int D = Geometry::dimension;
  constexpr double beyond_contact = 0.2; // of the reach: more than the gap that contact keeps
  images.list.clear();
  images.paths.clear();
  images.clearance.assign(surfaces.size(), unbounded);
  images.first = images.first_wall = p.padded();
  std::vector<Vector<D>> position; // of the images so far
  const auto add = [&](int source, Vector<D> x, int s) {
    const Image image{source, s};
    const int record = images.first + int(images.list.size());
    reflect(surfaces[s], x);
    images.paths.push_back(path_of(images, image, surfaces[s], record));
    images.list.push_back(image);
    position.push_back(x);
  };
  for (int s = 0; s < int(surfaces.size()); ++s) {
    const int earlier = int(images.list.size());
    // A shell holds sand on the other side too, by contact alone.
    const double least_depth = -skin - (surfaces[s].extent == Extent::shell ? beyond_contact * reach : 0);
    for (int i = 0; i < p.count; ++i) {
      Vector<D> x;
      for (int a = 0; a < D; ++a) x[a] = p.position[a][i];
      images.clearance[s] = std::min(images.clearance[s], gap(surfaces[s], x));
      if (may_reflect(surfaces, s, x, reach, least_depth)) add(i, x, s);
    }
    for (int g = 0; g < earlier; ++g)
      if (may_reflect(surfaces, s, position[g], reach, least_depth) && goes_on(surfaces, images.paths[g], s))
        add(images.first + g, position[g], s);
    if (surfaces[s].is_symmetry()) images.first_wall = images.first + int(images.list.size());
  }
  images.list.shrink_to_fit();
  images.paths.shrink_to_fit();
  mark_crowded(images);
  find_nearness(surfaces, reach, images);
}

template decltype(find_images<PlaneStrain>) find_images<PlaneStrain>;
template decltype(find_images<Axisymmetric>) find_images<Axisymmetric>;
template decltype(find_images<ThreeDimensional>) find_images<ThreeDimensional>;
template decltype(complete_images<2>) complete_images<2>;
template decltype(complete_images<3>) complete_images<3>;

} // namespace host
