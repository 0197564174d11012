// SPDX-License-Identifier: BSD-3-Clause
// Cluster lists against a search of all pairs; the sort keeps every particle together.
#include "tests/unit/host_fixture.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <set>

namespace {

using namespace host;
using namespace host_test;

constexpr double reach = 0.006, side = 0.06; // m

template <class Geometry> GeometryKind kind;
template <> constexpr GeometryKind kind<PlaneStrain> = GeometryKind::plane_strain;
template <> constexpr GeometryKind kind<ThreeDimensional> = GeometryKind::three_dimensional;

/// Particles anywhere in a box at the axis and the floor, behind a gate, and a few strays far away.
template <class Geometry = PlaneStrain>
Simulation<Geometry> scattered(int count, double width, int strays, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(0, width), far(1e3, 1e6);
  Scene scene;
  scene.geometry = kind<Geometry>;
  scene.sector = Sector::quarter;
  scene.gate.radius = side;
  scene.gate.motion = GateMotion::fixed;
  auto s = empty_cloud<Geometry>(count, scene, 2);
  place_walls(s);
  for (int i = 0; i < count; ++i) {
    const bool stray = i % 50 == 7 && strays-- > 0;
    auto& from = stray ? far : place;
    Place<Geometry> at;
    for (auto& x : at) x = from(random);
    put(s.particles, i, at);
  }
  return s;
}

template <class Geometry = PlaneStrain>
Simulation<Geometry> listed(int count, double width, int strays, std::uint64_t seed) {
  auto s = scattered<Geometry>(count, width, strays, seed);
  arrange(s, 0.25 * reach, reach);
  find_lists(s, reach);
  return s;
}

template <class Geometry> double distance(const Simulation<Geometry>& s, int i, int record) {
  double square = 0;
  for (int a = 0; a < Geometry::dimension; ++a)
    square += std::pow(s.particles.position[a][i] - s.records.motion[record].position[a], 2);
  return std::sqrt(square);
}

template <class Geometry> std::vector<int> all_records(const Simulation<Geometry>& s) {
  const int count = s.particles.count;
  std::vector<int> all(count + s.images.list.size());
  std::iota(all.begin(), all.begin() + count, 0);
  std::iota(all.begin() + count, all.end(), s.images.first);
  return all;
}

/// Every cluster lists what a search of all records finds, once, and walls' images last.
template <class Geometry> void expect_complete(const Simulation<Geometry>& s) {
  const auto& p = s.particles;
  const auto all = all_records(s);
  for (int cluster = 0; cluster < p.clusters(); ++cluster) {
    std::set<int> expected[2];
    for (const int j : all)
      for (int i = cluster * lanes; i < std::min((cluster + 1) * lanes, p.count); ++i)
        if (distance(s, i, j) <= reach) expected[j >= s.images.first_wall].insert(j);
    const int* begin = s.lists.begin(cluster);
    const int *middle = begin + s.lists.interior[cluster], *end = begin + s.lists.total[cluster];
    EXPECT_EQ(std::multiset<int>(begin, middle), std::multiset<int>(expected[0].begin(), expected[0].end()));
    EXPECT_EQ(std::multiset<int>(middle, end), std::multiset<int>(expected[1].begin(), expected[1].end()));
  }
}

TEST(Neighbours, ListsHoldEveryPairAndNoOther) {
  for (const int count : {1, 8, 13, 1003}) expect_complete(listed(count, side, 0, count));
  for (const int count : {1, 13, 1003})
    expect_complete(listed<ThreeDimensional>(count, 0.4 * side, 0, count));
}

TEST(Neighbours, StraysFarAwayCostNoPair) {
  const auto s = listed(803, side, 5, 2);
  const auto& p = s.particles;
  ASSERT_GT(*std::max_element(p.position[0].begin(), p.position[0].begin() + p.count), 1e3);
  expect_complete(s);
}

TEST(Neighbours, StraysFarAwayCostNoPairInThreeDimensions) {
  expect_complete(listed<ThreeDimensional>(503, 0.4 * side, 5, 2));
}

TEST(Neighbours, ListsGrowWhereParticlesCrowd) {
  const auto s = listed(805, 3 * reach, 0, 4);
  EXPECT_GT(s.lists.capacity, NeighbourLists{}.capacity);
  expect_complete(s);
}

TEST(Neighbours, ListsHoldWhileParticlesMoveHalfTheSkin) {
  const double skin = 0.001, support = reach - skin;
  auto s = listed(1003, side, 0, 6);
  auto& p = s.particles;
  const auto before = p.position;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(0, 6.3);
  for (int i = 0; i < p.count; ++i) {
    const double turn = angle(random);
    p.position[0][i] = std::clamp(before[0][i] + 0.4999 * skin * std::cos(turn), 0.0, side);
    p.position[1][i] = std::max(before[1][i] + 0.4999 * skin * std::sin(turn), 0.0);
  }
  show(s);
  int pairs = 0;
  for (int i = 0; i < p.count; ++i) {
    const int cluster = i / lanes;
    const std::set<int> listed_here(s.lists.begin(cluster), s.lists.begin(cluster) + s.lists.total[cluster]);
    for (const int j : all_records(s))
      if (distance(s, i, j) < support) {
        ++pairs;
        EXPECT_TRUE(listed_here.contains(j));
      }
  }
  EXPECT_GT(pairs, 10 * p.count);
}

/// Pruned lists are the outer ones less what is far, in the same order, and all sums of pairs are the same to the last bit.
template <class Geometry> void expect_pruned(double width) {
  auto s = scattered<Geometry>(1003, width, 3, 10);
  auto& p = s.particles;
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal(0, 1);
  for (auto& a : p.velocity)
    for (int i = 0; i < p.count; ++i) a[i] = normal(random);
  for (auto& a : p.stress)
    for (int i = 0; i < p.count; ++i) a[i] = 1e3 * normal(random);
  p.wave_speed.assign(p.padded(), 30);
  arrange(s, 0.25 * reach, 1.2 * s.kernel.support);
  find_lists(s, 1.2 * s.kernel.support);
  Stages<Geometry> stages(p);
  write_stress_records(p, s.scene, s.kernel.h, stages, s.records);
  reflect_stress(s.images, s.surfaces, medium_of(s.scene), s.records);
  const auto sums = [&] {
    update_gradient(p, s.kernel, s.lists, s.records, stages);
    update_acceleration(p, s.kernel, s.lists, s.records, s.scene, stages);
    std::vector<double> all;
    stages.each([&](const Array& a) { all.insert(all.end(), a.begin(), a.begin() + p.count); });
    return all;
  };
  const auto by_outer = sums();
  s.outer_lists = s.lists;
  const double near = 1.01 * s.kernel.support;
  prune(p, s.records, near, s.outer_lists, s.lists);
  EXPECT_EQ(sums(), by_outer);
  long kept = 0, all = 0;
  for (int c = 0; c < p.clusters(); ++c) {
    std::vector<int> expected;
    int interior = 0;
    for (int k = 0; k < s.outer_lists.total[c]; ++k) {
      const int j = s.outer_lists.begin(c)[k];
      bool close = false;
      for (int i = c * lanes; i < std::min((c + 1) * lanes, p.count); ++i) close |= distance(s, i, j) <= near;
      if (!close) continue;
      expected.push_back(j);
      interior += k < s.outer_lists.interior[c];
    }
    EXPECT_EQ(std::vector<int>(s.lists.begin(c), s.lists.begin(c) + s.lists.total[c]), expected);
    EXPECT_EQ(s.lists.interior[c], interior);
    kept += s.lists.total[c];
    all += s.outer_lists.total[c];
  }
  EXPECT_LT(kept, 0.95 * double(all));
}

TEST(Neighbours, PruningChangesNoSum) {
  expect_pruned<PlaneStrain>(0.8 * side);
  expect_pruned<ThreeDimensional>(0.4 * side);
}

TEST(Neighbours, SortingKeepsEachParticleTogether) {
  auto s = scattered(1003, side, 3, 8);
  auto& p = s.particles;
  int arrays = 0;
  p.each_persistent([&](Array& a) { // tell each value by particle and array
    if (&a != &p.position[0] && &a != &p.position[1])
      for (int i = 0; i < p.count; ++i) a[i] = i + 1e4 * arrays;
    ++arrays;
  });
  const auto before = p.position;
  sort_particles(p, 0.25 * reach);
  auto ids = std::vector(p.id.begin(), p.id.begin() + p.count);
  int at = 0;
  p.each_persistent([&](Array& a) {
    for (int i = 0; i < p.count; ++i)
      if (&a == &p.position[0] || &a == &p.position[1])
        EXPECT_EQ(a[i], before[&a - p.position.data()][ids[i]]);
      else
        EXPECT_EQ(a[i], ids[i] + 1e4 * at);
    ++at;
  });
  std::sort(ids.begin(), ids.end());
  for (int i = 0; i < p.count; ++i) EXPECT_EQ(ids[i], i);
}

/// Volume of the boxes around clusters over that of the cloud.
template <class Geometry> double overlap(int count) {
  auto s = scattered<Geometry>(count, side, 0, 9);
  auto& p = s.particles;
  sort_particles(p, 0.25 * reach);
  double volume = 0;
  for (int first = 0; first < p.count; first += lanes) {
    double box = 1;
    for (int a = 0; a < Geometry::dimension; ++a) {
      const auto [low, high] = std::minmax_element(&p.position[a][first], &p.position[a][first] + lanes);
      box *= (*high - *low) / side;
    }
    volume += box;
  }
  return volume;
}

TEST(Neighbours, SortingGathersNeighboursInSpace) {
  EXPECT_LT(overlap<PlaneStrain>(4096), 4);
  EXPECT_LT(overlap<ThreeDimensional>(4096), 4);
}

} // namespace
