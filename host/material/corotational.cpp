// SPDX-License-Identifier: BSD-3-Clause
#include "host/material/corotational.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>

namespace host {
namespace {

/// F of particle i.
template <class Geometry> Tensor gradient_of(const Particles<Geometry>& p, int i) {
  Tensor f = Tensor::Zero();
  for (std::size_t c = 0; c < p.deformation_gradient.size(); ++c) {
    const auto [row, column] = place(int(c), Geometry::shear_components);
    f(row, column) = p.deformation_gradient[c][i];
  }
  return f;
}

/// Skew part of the velocity gradient of point k.
template <class Geometry> Tensor spin_of(const BlockGradient<Geometry>& gradient, int k) {
  constexpr int D = Geometry::dimension;
  Tensor w = Tensor::Zero();
  for (int a = 0; a < D; ++a)
    for (int b = 0; b < D; ++b)
      w(a, b) = 0.5 * (gradient.component[a * D + b][k] - gradient.component[b * D + a][k]);
  return w;
}

} // namespace

template <class Geometry> void carry_deformation(Particles<Geometry>& p) {
  p.deformation_gradient.resize(3 + 2 * Geometry::shear_components);
  for (std::size_t c = 0; c < p.deformation_gradient.size(); ++c)
    p.deformation_gradient[c].assign(p.padded(), c < 3 ? 1.0 : 0.0);
}

template <class Geometry>
void enter_corotational(const Particles<Geometry>& p, const BlockGradient<Geometry>& gradient, int first,
                        double dt, VumatBlock& b) {
  constexpr int shear = Geometry::shear_components;
  const int n = b.points;
  b.rotation_new.resize(n);
  b.kept_gradient.resize(n);
  for (int k = 0; k < n; ++k) {
    const Tensor strain = symmetric_at(b.strain_increment, k, n, shear);
    const auto motion = motion_by_gradient(gradient_of(p, first + k), strain + dt * spin_of(gradient, k));
    const Tensor& r = motion.rotation_old;
    set_symmetric(r.transpose() * symmetric_at(b.stress_old, k, n, shear) * r, k, n, shear, b.stress_old);
    set_symmetric(motion.strain, k, n, shear, b.strain_increment);
    set_symmetric(motion.stretch_old, k, n, shear, b.stretch_old);
    set_symmetric(motion.stretch_new, k, n, shear, b.stretch_new);
    set_general(motion.gradient_old, k, n, shear, b.gradient_old);
    set_general(motion.gradient_new, k, n, shear, b.gradient_new);
    for (int s = 0; s < shear; ++s) b.spin_increment[s * n + k] = motion.spin[3 - shear + s]; // in plane: 21
    b.rotation_new[k] = motion.rotation_new;
    b.kept_gradient[k] = motion.gradient_new;
  }
}

void leave_corotational(VumatBlock& b) {
  const int n = b.points, shear = b.shear_components;
  for (int k = 0; k < n; ++k) {
    const Tensor& r = b.rotation_new[k];
    set_symmetric(r * symmetric_at(b.stress_new, k, n, shear) * r.transpose(), k, n, shear, b.stress_new);
  }
}

template <class Geometry> void keep_deformation(const VumatBlock& b, int first, Particles<Geometry>& p) {
  for (std::size_t c = 0; c < p.deformation_gradient.size(); ++c) {
    const auto [row, column] = place(int(c), Geometry::shear_components);
    for (int k = 0; k < b.points; ++k) p.deformation_gradient[c][first + k] = b.kept_gradient[k](row, column);
  }
}

template decltype(carry_deformation<PlaneStrain>) carry_deformation<PlaneStrain>;
template decltype(carry_deformation<Axisymmetric>) carry_deformation<Axisymmetric>;
template decltype(carry_deformation<ThreeDimensional>) carry_deformation<ThreeDimensional>;
template decltype(enter_corotational<PlaneStrain>) enter_corotational<PlaneStrain>;
template decltype(enter_corotational<Axisymmetric>) enter_corotational<Axisymmetric>;
template decltype(enter_corotational<ThreeDimensional>) enter_corotational<ThreeDimensional>;
template decltype(keep_deformation<PlaneStrain>) keep_deformation<PlaneStrain>;
template decltype(keep_deformation<Axisymmetric>) keep_deformation<Axisymmetric>;
template decltype(keep_deformation<ThreeDimensional>) keep_deformation<ThreeDimensional>;

} // namespace host
