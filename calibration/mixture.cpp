// SPDX-License-Identifier: BSD-3-Clause
#include "calibration/mixture.hpp"
#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace calibration {
namespace {

constexpr double freedom = 8; ///< of Student's t: heavier tails than most posteriors have
constexpr double wide_weight = 0.1, wide_scale = 1.5; ///< of one more component, which covers all points
constexpr int most_iterations = 60;                   ///< of expectation maximisation
constexpr double least_gain = 1e-3; ///< of the log likelihood per point; a smaller gain ends the iterations

// Products are taken by lazyProduct: the order of sums in Eigen's blocked product may depend on the number of threads.

/// A mixture of normal densities while it is fitted.
struct NormalMixture {
  std::vector<double> weight;
  std::vector<Eigen::VectorXd> centre;
  std::vector<Eigen::MatrixXd> covariance;
  double log_likelihood = 0; ///< of all points

  int size() const { return int(weight.size()); }
  void drop(int k) {
    weight.erase(weight.begin() + k);
    centre.erase(centre.begin() + k);
    covariance.erase(covariance.begin() + k);
  }
};

Eigen::MatrixXd covariance_of(const Eigen::MatrixXd& points) {
  const Eigen::VectorXd mean = points.rowwise().mean();
  const Eigen::MatrixXd centred = points.colwise() - mean;
  return centred.lazyProduct(centred.transpose()) / double(points.cols() - 1);
}

double half_log_determinant(const Eigen::MatrixXd& factor) {
  return factor.diagonal().array().log().sum();
}

/// Start with centres far from each other: each is a point drawn with a probability proportional to its squared distance
/// from the nearest earlier centre (k-means++, Arthur and Vassilvitskii 2007).
NormalMixture distant_centres(const Eigen::MatrixXd& points, const Eigen::MatrixXd& pooled, int components,
                              RandomStream& random) {
  NormalMixture m;
  const Eigen::LLT<Eigen::MatrixXd> factor(pooled);
  Eigen::VectorXd distance;
  for (int k = 0; k < components; ++k) {
    Eigen::Index chosen = 0;
    if (k == 0) {
      chosen = random.below(int(points.cols()));
    } else {
      double left = random.uniform() * distance.sum();
      while (chosen + 1 < points.cols() && (left -= distance(chosen)) > 0) ++chosen;
    }
    m.weight.push_back(1.0 / components);
    m.centre.push_back(points.col(chosen));
    m.covariance.push_back(pooled / std::pow(components, 2.0 / double(points.rows())));
    const Eigen::MatrixXd away = factor.matrixL().solve(points.colwise() - m.centre.back());
    const Eigen::VectorXd squared = away.colwise().squaredNorm().transpose();
    distance = k == 0 ? squared : Eigen::VectorXd(distance.cwiseMin(squared));
  }
  return m;
}

/// Probability of each component at each point, (points, components), and the log likelihood.
Eigen::MatrixXd memberships(NormalMixture& m, const Eigen::MatrixXd& points) {
  Eigen::MatrixXd log_part(points.cols(), m.size());
  for (int k = 0; k < m.size(); ++k) {
    const Eigen::LLT<Eigen::MatrixXd> factor(m.covariance[k]);
    if (factor.info() != Eigen::Success) throw std::runtime_error("points of the sampler lie in a subspace");
    const double constant = std::log(m.weight[k]) - half_log_determinant(factor.matrixL()) -
                            0.5 * double(points.rows()) * std::log(2 * std::numbers::pi);
    const Eigen::MatrixXd away = factor.matrixL().solve(points.colwise() - m.centre[k]);
    log_part.col(k) = constant - 0.5 * away.colwise().squaredNorm().transpose().array();
  }
  const Eigen::VectorXd largest = log_part.rowwise().maxCoeff();
  Eigen::MatrixXd part = (log_part.colwise() - largest).array().exp();
  const Eigen::VectorXd sum = part.rowwise().sum();
  m.log_likelihood = (largest.array() + sum.array().log()).sum();
  return part.array().colwise() / sum.array();
}

/// Weights, centres and covariances from the memberships. The pooled covariance is a prior with the weight of d + 2 points
/// (Fraley and Raftery 2007), which keeps components from collapsing to a point.
void maximise(NormalMixture& m, const Eigen::MatrixXd& points, const Eigen::MatrixXd& pooled,
              const Eigen::MatrixXd& part) {
  const double prior_points = double(points.rows()) + 2;
  const Eigen::MatrixXd prior = pooled / std::pow(m.size(), 2.0 / double(points.rows()));
  for (int k = 0; k < m.size(); ++k) {
    const double count = part.col(k).sum();
    m.weight[k] = count / double(points.cols());
    m.centre[k] = points.lazyProduct(part.col(k)) / count;
    const Eigen::MatrixXd away = points.colwise() - m.centre[k];
    const Eigen::MatrixXd weighted = away * part.col(k).asDiagonal();
    m.covariance[k] =
        (weighted.lazyProduct(away.transpose()) + prior_points * prior) / (count + prior_points);
  }
}

NormalMixture fit_normal(const Eigen::MatrixXd& points, const Eigen::MatrixXd& pooled, int components,
                         RandomStream& random) {
  NormalMixture m = distant_centres(points, pooled, components, random);
  const double fewest = std::max(5.0 * double(points.rows() + 1), 0.02 * double(points.cols()));
  double before = 0;
  for (int i = 0; i < most_iterations; ++i) {
    const Eigen::MatrixXd part = memberships(m, points);
    if (i > 0 && m.log_likelihood - before < least_gain * double(points.cols())) break;
    before = m.log_likelihood;
    maximise(m, points, pooled, part);
    for (int k = m.size() - 1; k >= 0 && m.size() > 1; --k)
      if (m.weight[k] * double(points.cols()) < fewest) m.drop(k);
  }
  return m;
}

double information_criterion(const NormalMixture& m, const Eigen::MatrixXd& points) {
  const double d = double(points.rows());
  const double parameters = m.size() * (1 + d + d * (d + 1) / 2) - 1;
  return parameters * std::log(double(points.cols())) - 2 * m.log_likelihood;
}

StudentMixture student_mixture(const NormalMixture& normal) {
  StudentMixture m;
  double sum = 0;
  for (const double w : normal.weight) sum += w;
  for (int k = 0; k < normal.size(); ++k) {
    const double d = double(normal.centre[k].size());
    StudentMixture::Component c;
    c.weight = normal.weight[k] / sum;
    c.centre = normal.centre[k];
    c.factor = normal.covariance[k].llt().matrixL();
    c.log_norm = std::log(c.weight) + std::lgamma((freedom + d) / 2) - std::lgamma(freedom / 2) -
                 d / 2 * std::log(freedom * std::numbers::pi) - half_log_determinant(c.factor);
    m.components.push_back(std::move(c));
  }
  return m;
}

} // namespace

double StudentMixture::log_density(const Eigen::VectorXd& point) const {
  double largest = -INFINITY, sum = 0;
  for (const auto& c : components) {
    const double squared = c.factor.triangularView<Eigen::Lower>().solve(point - c.centre).squaredNorm();
    const double part = c.log_norm - (freedom + double(point.size())) / 2 * std::log1p(squared / freedom);
    if (part > largest) {
      sum = sum * std::exp(largest - part) + 1;
      largest = part;
    } else {
      sum += std::exp(part - largest);
    }
  }
  return largest + std::log(sum);
}

Eigen::VectorXd StudentMixture::draw(RandomStream& random) const {
  double left = random.uniform();
  std::size_t k = 0;
  while (k + 1 < components.size() && (left -= components[k].weight) > 0) ++k;
  const auto& c = components[k];
  Eigen::VectorXd normal(c.centre.size());
  for (auto& z : normal) z = random.normal();
  const double stretch = std::sqrt(freedom / random.chi_squared(freedom));
  const Eigen::VectorXd away = c.factor.triangularView<Eigen::Lower>() * normal;
  return c.centre + stretch * away;
}

StudentMixture fit_mixture(const Eigen::Ref<const Eigen::MatrixXd>& points, int most, RandomStream& random) {
  const Eigen::MatrixXd pooled = covariance_of(points);
  const Eigen::VectorXd scale = pooled.diagonal().cwiseSqrt();
  const bool in_subspace = !(scale.minCoeff() > 0) ||
                           (scale.cwiseInverse().asDiagonal() * pooled * scale.cwiseInverse().asDiagonal())
                                   .eval()
                                   .selfadjointView<Eigen::Lower>()
                                   .eigenvalues()
                                   .minCoeff() < 1e-13;
  if (in_subspace) throw std::runtime_error("points of the sampler lie in a subspace");
  NormalMixture best = fit_normal(points, pooled, 1, random);
  for (int k = 2, worse = 0; k <= most && worse < 2; ++k) {
    NormalMixture next = fit_normal(points, pooled, k, random);
    if (information_criterion(next, points) < information_criterion(best, points))
      best = std::move(next);
    else
      ++worse;
  }
  best.weight.push_back(wide_weight / (1 - wide_weight));
  best.centre.push_back(points.rowwise().mean());
  best.covariance.push_back(wide_scale * wide_scale * pooled);
  return student_mixture(best);
}

} // namespace calibration
