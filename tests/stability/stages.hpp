// SPDX-License-Identifier: BSD-3-Clause
// What tests need that run the stages of a step one by one.
#pragma once
#include "host/engine/simulation.hpp"

namespace stability {

using Place = std::array<double, 2>;
using Sand = host::Particles<host::PlaneStrain>;

/// Room for what one stage leaves to the next; a step of the product keeps none of it.
inline void keep_stages(Sand& p) {
  p.each_of_stages([&](host::Array& a) { a.resize(p.padded(), 0.0); });
}

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
