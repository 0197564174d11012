// SPDX-License-Identifier: BSD-3-Clause
// A mixture of multivariate Student-t densities fitted to points: the proposal density of the independent move.
#pragma once
#include "calibration/random_stream.hpp"
#include <Eigen/Core>
#include <vector>

namespace calibration {

struct StudentMixture {
  struct Component {
    double weight = 1;
    double log_norm = 0; ///< log of weight times the constant of the density
    Eigen::VectorXd centre;
    Eigen::MatrixXd factor; ///< lower Cholesky factor of the scale matrix
  };
  std::vector<Component> components;

  double log_density(const Eigen::VectorXd& point) const;
  Eigen::VectorXd draw(RandomStream& random) const;
};

/// Fits one to `most` components to the columns of `points` by expectation maximisation; the number of components has
/// the smallest Bayesian information criterion. Throws std::runtime_error if the points lie in a subspace.
StudentMixture fit_mixture(const Eigen::Ref<const Eigen::MatrixXd>& points, int most, RandomStream& random);

} // namespace calibration
