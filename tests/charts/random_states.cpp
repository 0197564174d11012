// SPDX-License-Identifier: BSD-3-Clause
#include "tests/charts/random_states.hpp"
#include "tests/charts/reference.hpp"
#include <algorithm>
#include <chrono>
#include <cstring>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <omp.h>

namespace charts {
namespace {

constexpr std::size_t most_examples = 20;

/// A point as it was given, in full precision, for a test of its own.
std::string written(int sand, const RandomPoint& r, const Point& after, int status) {
  return fmt::format(
      "{} {}: stress {:.17g}, e {:.17g}, eps_d {:.17g}, gap {:.17g}, strain {:.17g} -> status {}, stress "
      "{:.9g}, e {:.9g}, eps_d {:.9g}, gap {:.9g}",
      sands[sand].name, origin_names[int(r.origin)], fmt::join(r.point.stress.component, " "),
      r.point.void_ratio, r.point.plastic_strain, r.point.separation_strain,
      fmt::join(r.strain.component, " "), status, fmt::join(after.stress.component, " "), after.void_ratio,
      after.plastic_strain, after.separation_strain);
}

/// How far rounding moves f / p, e and eps_d: by a few digits in double, by substeps' roundings in single precision.
struct Tolerances {
  double yield, void_ratio;
};
template <class Real>
constexpr Tolerances tolerances = sizeof(Real) == 8 ? Tolerances{1e-6, 1e-11} : Tolerances{1e-5, 1e-4};

/// What is wrong with an answer that claims success; empty: nothing.
std::string fault(const Material& m, const RandomPoint& r, const Point& after, int status, double dissipation,
                  double yield_by_pressure, const Tolerances& tolerance) {
  const double p = mean(after.stress);
  const double q = simsand::deviatoric_stress(simsand::deviator(after.stress));
  if (!std::isfinite(norm(after.stress) + after.void_ratio + after.plastic_strain + after.separation_strain))
    return "not finite";
  if (p < 0) return "p < 0";
  if (p == 0 && q > 0) return "shear stress without mean stress";
  if (yield_by_pressure > tolerance.yield) return "f > tolerance p";
  if (status == 1 && yield_by_pressure < -tolerance.yield) return "plastic and inside of the yield surface";
  const double e_old = r.origin == Origin::first_call ? m.given.e0 : r.point.void_ratio;
  const double e = std::max((1 + e_old) * std::exp(-simsand::trace(r.strain)) - 1, 0.01);
  if (std::abs(after.void_ratio - e) > tolerance.void_ratio)
    return "void ratio is not that of the volumetric strain";
  if (after.plastic_strain < r.point.plastic_strain) return "eps_d falls";
  if (after.separation_strain < 0 || (after.separation_strain > 0) != (p == 0))
    return "gap and stress at once, or neither";
  if ((status == 2) != (p == 0)) return "status 2 and stress do not agree";
  if (status == 0 && r.origin != Origin::first_call && after.plastic_strain != r.point.plastic_strain)
    return "elastic, but eps_d grows";
  if (!(dissipation >= 0)) return "negative dissipation";
  return "";
}

template <class Real> bool same_bits(const LibraryBlock<Real>& one, const LibraryBlock<Real>& block, int k) {
  const auto same = [&](const std::vector<Real>& a, const std::vector<Real>& b) {
    for (std::size_t c = 0; c < a.size(); ++c)
      if (std::memcmp(&a[c], &b[c * block.points + k], sizeof(Real)) != 0) return false;
    return true;
  };
  return same(one.stress_new, block.stress_new) && same(one.state_new, block.state_new) &&
         same(one.internal_new, block.internal_new) && same(one.inelastic_new, block.inelastic_new);
}

/// A point alone, with the very numbers it has in the block.
template <class Real> LibraryBlock<Real> alone(const LibraryBlock<Real>& block, int k) {
  LibraryBlock<Real> one(1, block.shear);
  for (std::size_t c = 0; c < one.strain.size(); ++c) {
    one.strain[c] = block.strain[c * block.points + k];
    one.stress_old[c] = block.stress_old[c * block.points + k];
  }
  for (std::size_t c = 0; c < one.state_old.size(); ++c)
    one.state_old[c] = block.state_old[c * block.points + k];
  return one;
}

/// Bad input is refused: status -2, no stress, and the state as it was.
template <class Real> std::string refusal(const LibraryBlock<Real>& block, int k) {
  if (block.status(k) != -2) return "bad input not refused";
  for (int c = 0; c < block.components(); ++c)
    if (!std::isnan(block.stress_new[c * block.points + k])) return "bad input gave stress";
  for (const int s : {0, 1, 2})
    if (std::memcmp(&block.state_new[s * block.points + k], &block.state_old[s * block.points + k],
                    sizeof(Real)) != 0)
      return "bad input changed the state";
  return "";
}

/// Largest error of the stress that may be reported as success.
constexpr double largest_silent_error = 0.1;

/// Share of the updates to be compared whose reference may be missing.
constexpr double largest_share_without_reference = 0.02;

/// Compares with the reference. Empty, or what is wrong.
std::string compare(const Material& m, const RandomPoint& r, const Point& after, RandomReport& report) {
  const bool comparable = r.origin == Origin::inside || r.origin == Origin::on_surface ||
                          r.origin == Origin::isotropic || r.origin == Origin::parted ||
                          r.origin == Origin::no_stress || r.origin == Origin::first_call;
  if (!comparable) return ""; // no start that the rates of the model could have led to
  const auto start =
      r.origin == Origin::first_call ? simsand::initial_state(m, r.point.stress, m.given.e0) : r.point;
  if (yield_of(m, start) > 1e-6 * std::max(mean(start.stress), 0.0))
    return ""; // a first stress beyond strength
  const auto exact = integrate_rates(m, start, r.strain);
  if (!exact.found) {
    ++report.not_compared;
    return "";
  }
  ++report.compared;
  const double scale = std::max({norm(exact.point.stress), norm(r.point.stress), m.given.p_min});
  const double error = norm(simsand::add(after.stress, -1., exact.point.stress)) / scale;
  report.errors.push_back({std::floor(std::log10(norm(r.strain)) + 1e-12), error});
  if (error <= largest_silent_error) return "";
  return fmt::format("stress off by more than {}", largest_silent_error);
}

template <class Real> RandomReport check(const RandomOptions& options, std::int64_t index) {
  static auto* const library = material_library<Real>(options.library);
  auto input = random_points(options.seed, index);
  const auto props = properties(sands[input.sand]);
  const auto m = material_of(props);
  const std::vector<Real> numbers(props.begin(), props.end());
  LibraryBlock<Real> block(random_block, input.shear);
  for (int k = 0; k < random_block; ++k) {
    auto& r = input.points[k];
    block.put(k, r.point, r.strain);
    block.given(k, r.point, r.strain); // as rounded to the library's precision
  }
  block.call(library, numbers);
  RandomReport report;
  const auto violated = [&](int k, const std::string& what) {
    ++report.violations[what];
    if (report.examples.size() < most_examples)
      report.examples[index * random_block + k] =
          what + ": " + written(input.sand, input.points[k], block.get(k), block.status(k));
  };
  const auto every = std::int64_t(1 / std::max(options.compared, 1e-18));
  for (int k = 0; k < random_block; ++k) {
    const auto& r = input.points[k];
    ++report.updates;
    ++report.origins[int(r.origin)];
    auto one = alone(block, k);
    one.call(library, numbers);
    if (!same_bits(one, block, k)) violated(k, "nblock 1 and 128 differ");
    if (r.origin == Origin::bad_input) {
      if (const auto what = refusal(block, k); !what.empty()) violated(k, what);
      continue;
    }
    const int status = block.status(k);
    if (status < 0) {
      violated(k, "reported failure");
      continue;
    }
    ++report.answers[std::min(status, 3)];
    const auto after = block.get(k);
    const double p = mean(after.stress), f = p > 0 ? yield_of(m, after) / p : 0;
    report.largest_yield = std::max(report.largest_yield, f);
    auto what = fault(m, r, after, status, double(block.inelastic_new[k]), f, tolerances<Real>);
    if (what.empty() && options.compared > 0 && (index * random_block + k) % every == 0)
      what = compare(m, r, after, report);
    if (!what.empty()) violated(k, what);
  }
  return report;
}

/// Errors of the stress against the reference, by decades of the strain.
void print_errors(const RandomReport& report) {
  std::map<double, std::vector<double>> by_decade;
  for (const auto& [decade, error] : report.errors) by_decade[decade].push_back(error);
  if (by_decade.empty()) return;
  fmt::print("  stress against the reference, over the larger of both ends' stress and p_min; without a "
             "reference: {}\n"
             "  {:>16} {:>10} {:>9} {:>9} {:>9} {:>9} {:>10}\n",
             report.not_compared, "strain", "compared", "median", "95 %", "99.9 %", "largest", "above 0.1");
  for (auto& [decade, errors] : by_decade) {
    std::sort(errors.begin(), errors.end());
    const auto share = [&](double s) { return errors[std::size_t(s * double(errors.size() - 1))]; };
    fmt::print("  {:>7.0e} to {:>5.0e} {:>10} {:9.1e} {:9.1e} {:9.1e} {:9.1e} {:>10}\n", std::pow(10, decade),
               std::pow(10, decade + 1), errors.size(), share(0.5), share(0.95), share(0.999), errors.back(),
               errors.end() - std::upper_bound(errors.begin(), errors.end(), 0.1));
  }
}

void print(const RandomReport& report, std::int64_t first, std::int64_t end) {
  fmt::print("{} updates, blocks {} to {}\n", report.updates, first, end - 1);
  for (std::size_t i = 0; i < origin_names.size(); ++i)
    fmt::print("  start: {:<34}{:>12}\n", origin_names[i], report.origins[i]);
  constexpr std::array answers{"elastic", "plastic", "stress free", "substepped"};
  for (int i = 0; i < 4; ++i) fmt::print("  answer: {:<33}{:>12}\n", answers[i], report.answers[i]);
  fmt::print("  largest f / p after an update {:.2e}\n", report.largest_yield);
  print_errors(report);
  for (const auto& [what, count] : report.violations) fmt::print("  VIOLATED, {} times: {}\n", count, what);
  for (const auto& [number, text] : report.examples) fmt::print("  point {}: {}\n", number, text);
  if (report.violations.empty()) fmt::print("  no violation\n");
}

} // namespace

void RandomReport::add(const RandomReport& b) {
  updates += b.updates;
  compared += b.compared;
  not_compared += b.not_compared;
  for (std::size_t i = 0; i < origins.size(); ++i) origins[i] += b.origins[i];
  for (std::size_t i = 0; i < answers.size(); ++i) answers[i] += b.answers[i];
  for (const auto& [what, count] : b.violations) violations[what] += count;
  examples.insert(b.examples.begin(), b.examples.end());
  while (examples.size() > most_examples) examples.erase(std::prev(examples.end()));
  largest_yield = std::max(largest_yield, b.largest_yield);
  errors.insert(errors.end(), b.errors.begin(), b.errors.end());
}

RandomReport check_block(const RandomOptions& options, std::int64_t index) {
  return options.single ? check<float>(options, index) : check<double>(options, index);
}

bool chart_random(const RandomOptions& options) {
  const auto blocks = std::int64_t(std::ceil(options.count / random_block));
  RandomReport report;
  std::int64_t done = 0;
  const auto start = std::chrono::steady_clock::now();
  double next_line = 2;
#pragma omp parallel
  {
    RandomReport mine;
#pragma omp for schedule(dynamic, 64)
    for (std::int64_t b = 0; b < blocks; ++b) {
      mine.add(check_block(options, options.first_block + b));
      std::int64_t so_far;
#pragma omp atomic capture
      so_far = ++done;
      if (options.quiet || omp_get_thread_num() != 0) continue;
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (seconds < next_line) continue;
      next_line = seconds + 2;
      fmt::print(stderr, "{:.3g} of {:.3g} updates, {:.0f} s left\n", double(so_far) * random_block,
                 options.count, seconds * double(blocks - so_far) / double(so_far));
    }
#pragma omp critical
    report.add(mine);
  }
  if (double(report.not_compared) >
      largest_share_without_reference * double(report.compared + report.not_compared))
    ++report.violations["too few references found"];
  print(report, options.first_block, options.first_block + blocks);
  return report.violations.empty();
}

} // namespace charts
