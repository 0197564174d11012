// SPDX-License-Identifier: BSD-3-Clause
// Images: sand reflected in the surfaces around it, so that the pair sums find complete neighbourhoods there and know
// no walls. Planes of any direction, mantles seen from inside and outside, bodies with edges, shells without thickness,
// and where all of these meet and move. In a corner the solid is divided among its surfaces, so that no place holds
// two images.
#pragma once
#include "host/engine/records.hpp"
#include "host/scheme/medium.hpp"
#include "host/walls/surface.hpp"
#include <cstdint>
#include <span>
#include <vector>

namespace host {

/// An image: of record `source` (a particle or an earlier image) in surface number `surface`.
struct Image {
  int source, surface;
};

/// The surfaces of walls that an image was reflected in, the last reflection first, and the record it began with: a
/// particle, or its image in planes of symmetry.
struct ImagePath {
  static constexpr int longest = 4;
  int root = 0;
  std::array<std::int16_t, longest> surface{};
  std::int8_t length = 0;
  bool crowded = false;  ///< its root has images in several surfaces
  bool in_shell = false; ///< one of the surfaces is a shell
  std::span<const std::int16_t> all() const { return {surface.data(), std::size_t(length)}; }
};

/// What surfaces a cluster of particles is in reach of.
enum class Nearness : char { none, symmetry, wall };

/// The images of one arrangement of particles. The first three and `clearance` say all; the rest follows from them.
struct Images {
  std::vector<Image> list;
  int first = 0;                 ///< record index of the first image
  int first_wall = 0;            ///< record index of the first image behind a wall
  std::vector<double> clearance; ///< m, of each surface: how far off the nearest particle was

  std::vector<ImagePath> paths;   ///< one for each of `list`
  std::vector<Nearness> nearness; ///< one for each cluster of particles
  std::vector<int> within_reach;  ///< numbers of the surfaces that any particle may be near to

  const ImagePath& path(int record) const { return paths[record - first]; }
};

/// Lists images of all particles within `reach` of a surface, m, those in planes of symmetry first. Images stay listed
/// while particles move by up to half of `skin`, m, and walls along themselves by up to half of `reach`.
template <class Geometry>
void find_images(const Particles<Geometry>& particles,
                 const std::vector<Surface<Geometry::dimension>>& surfaces, double reach, double skin,
                 Images& images);

/// Finds what follows from the list of images and the clearance.
template <int D> void complete_images(const std::vector<Surface<D>>& surfaces, double reach, Images& images);

/// Writes the images' records from those of their sources, which must be up to date: place, velocity and volume. An
/// image whose place another one has, or of sand that the surface does not face, has volume 0 and adds nothing to sums.
template <class Geometry>
void reflect_motion(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                    Records<Geometry>& records);

/// The same of stress and strain rate. The stress behind a surface grows with the sand's weight across it, K0 times
/// that along it, or the gradient of the stress would vanish there.
template <class Geometry>
void reflect_stress(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                    const Medium& medium, Records<Geometry>& records);

} // namespace host
