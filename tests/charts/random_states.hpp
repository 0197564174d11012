// SPDX-License-Identifier: BSD-3-Clause
// `chart random`: any state and any increment through the product's library, and whether the answer may stand.
#pragma once
#include "tests/charts/material_library.hpp"
#include <cstdint>
#include <map>

namespace charts {

struct RandomOptions {
  double count = 1e6; ///< updates, rounded up to blocks of 128
  std::int64_t first_block =
      0; ///< to go on where an earlier run ended: every block has its own random numbers
  std::uint64_t seed = 1;
  double compared = 1e-4; ///< share that is compared with the reference integration
  bool single = false;    ///< the library of single precision
  std::string library;    ///< another build of the material; empty: the one beside the program
  bool quiet = false;
};

/// What a starting state is; each kind is counted.
enum class Origin {
  inside,
  on_surface,
  outside,
  isotropic,
  no_stress,
  parted,
  stress_beside_gap,
  first_call,
  bad_input
};
inline constexpr std::array<const char*, 9> origin_names{"inside of the yield surface",
                                                         "on it",
                                                         "outside, up to three times M_p",
                                                         "isotropic",
                                                         "no stress",
                                                         "parted",
                                                         "stress beside a gap",
                                                         "first call (e = 0)",
                                                         "input that must be refused"};

struct RandomPoint {
  Origin origin;
  Point point;
  Tensor strain;
};

inline constexpr int random_block = 128;

/// Block number `index`: its sand, its components of shear (3, in every eighth block 1), and 128 points. Void ratio
/// 0.2 to 2; mean stress 0 to 1 MPa, evenly and by its logarithm; strain sqrt(d eps : d eps) 1e-8 to 1e-1 in all
/// directions, some of them without change of volume or of shape.
struct RandomBlock {
  int sand, shear;
  std::vector<RandomPoint> points;
};
RandomBlock random_points(std::uint64_t seed, std::int64_t index);

struct RandomReport {
  std::int64_t updates = 0, compared = 0, not_compared = 0;
  std::array<std::int64_t, origin_names.size()> origins{};
  std::array<std::int64_t, 4> answers{};          ///< elastic, plastic, stress free, substepped
  std::map<std::string, std::int64_t> violations; ///< by what was violated
  std::map<std::int64_t, std::string> examples;   ///< the first ones, by number of the point
  double largest_yield = 0;                       ///< f / p after an update
  std::vector<std::array<double, 2>> errors;      ///< decade of the strain, error against the reference
  void add(const RandomReport& other);
};

/// Checks of one block of points.
RandomReport check_block(const RandomOptions& options, std::int64_t index);

/// All blocks, in parallel; the numbers do not depend on the threads. Prints them. Returns whether nothing was violated.
bool chart_random(const RandomOptions& options);

} // namespace charts
