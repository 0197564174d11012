// SPDX-License-Identifier: BSD-3-Clause
// What tests need that run the stages of a step one by one in the plane.
#pragma once
#include "host/engine/step.hpp"
#include "tests/unit/host_stages.hpp"

namespace stability {

using Place = std::array<double, 2>;
using Sand = host::Particles<host::PlaneStrain>;

using Stages = host_test::Stages<host::PlaneStrain>;

/// Where particles were when this was made.
class Places {
public:
  explicit Places(const Sand& p) : places(p.count) {
    for (int i = 0; i < p.count; ++i) places[p.id[i]] = {p.position[0][i], p.position[1][i]};
  }
  /// Of the particle that is now number `i`.
  const Place& of(const Sand& p, int i) const { return places[p.id[i]]; }

private:
  std::vector<Place> places;
};

} // namespace stability
