// SPDX-License-Identifier: BSD-3-Clause
// The vocabulary of loading paths: named linear combinations of stress or strain, and conditions on them.
// Compression positive, Pa, tensor shear strain; axis 1 is the axis of the specimen.
#pragma once
#include "host/material/caller.hpp"
#include <string>
#include <string_view>
#include <vector>

namespace drivers {

/// stress . sigma + strain . epsilon, of effective stress and strain, changes by `value` over the stage, or ends at it.
struct Condition {
  Vector6 stress = Vector6::Zero(), strain = Vector6::Zero();
  double value = 0;
  bool is_final = false;
  const char* unit() const { return stress.isZero(0) ? "(strain)" : "Pa"; }
  /// The left-hand side.
  double at(const Vector6& sigma, const Vector6& epsilon) const {
    return stress.dot(sigma) + strain.dot(epsilon);
  }
};

/// A combination of stress components (Pa), or of strain components, that has a name.
struct LinearQuantity {
  std::string name;
  bool is_strain;
  Vector6 weights; ///< of 11, 22, 33, 12, 23, 31; a shear component counts once
  /// A strain that changes by `value`, or a stress that ends at it.
  Condition condition(double value = 0) const;
};

/// Components, axial and radial ones, Roscoe's p, q, eps_v, eps_q, and the orthonormal P, Q, Z, eps_P, eps_Q, eps_Z. Each
/// pair is conjugate: work is p eps_v + q eps_q = P eps_P + Q eps_Q + Z eps_Z.
const std::vector<LinearQuantity>& linear_quantities();
/// The one of this name; null if there is none.
const LinearQuantity* find_linear_quantity(std::string_view name);
std::vector<std::string> linear_quantity_names();

/// Weights in the order 11, 22, 33, 12, 23, 31.
Vector6 weights(double a11, double a22, double a33, double a12 = 0, double a23 = 0, double a31 = 0);

} // namespace drivers
