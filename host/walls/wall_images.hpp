// SPDX-License-Identifier: BSD-3-Clause
// Images of particles behind the surfaces of walls, as those of host/walls/mirrors.hpp behind floor and gate: behind
// planes of any direction, mantles seen from inside and outside, bodies with edges, and where all of these meet and
// move. In a corner the solid is shared out between its surfaces, so that no place holds two images.
#pragma once
#include "host/walls/mirrors.hpp"
#include "host/walls/surfaces.hpp"
#include <span>

namespace host {

/// The surfaces an image was reflected in, one after the other, and the record it began with.
struct Chain {
  static constexpr int longest = 4;
  int root = 0, length = 0;
  std::array<int, longest> surface{}; ///< the last reflection first
  std::span<const int> all() const { return {surface.data(), std::size_t(length)}; }
};

/// That of a record; `mirrors` is the number of mirrors that are no surfaces.
Chain chain_of(const Images& images, std::size_t mirrors, int record);

/// Lists, behind the images that are there, those of all particles and images within `reach` of a surface. Their
/// `mirror` counts on from `mirrors`.
template <class Geometry>
void add_wall_images(const Particles<Geometry>& particles,
                     const std::vector<Surface<Geometry::dimension>>& surfaces, std::size_t mirrors,
                     double reach, Images& images);

/// Writes the images' records from their sources', after host/walls/mirrors.cpp has written those of its own. The stress
/// behind a surface grows with the sand's weight across it.
template <class Geometry>
void reflect_wall_motion(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                         std::size_t mirrors, Records<Geometry>& records);
template <class Geometry>
void reflect_wall_stress(const Images& images, const std::vector<Surface<Geometry::dimension>>& surfaces,
                         std::size_t mirrors, const Scene& scene, Records<Geometry>& records);

} // namespace host
