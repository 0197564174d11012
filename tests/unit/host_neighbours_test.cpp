// SPDX-License-Identifier: BSD-3-Clause
// Cluster lists against a search of all pairs; the sort keeps every particle together.
#include "host/geometry.hpp"
#include "host/gradient.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <set>

namespace {

using namespace host;

constexpr double reach = 0.006, side = 0.06; // m

/// Particles anywhere in a box at the axis and the floor, behind a gate, and a few strays far away.
struct Cloud {
  Particles<PlaneStrain> p;
  std::vector<Mirror> mirrors;
  Images images;
  Records<PlaneStrain> records;
  NeighbourLists lists;

  Cloud(int count, double width, int strays, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> place(0, width), far(1e3, 1e6);
    Scene scene;
    scene.column = {side, side};
    scene.gate.motion = GateMotion::fixed;
    mirrors = scene_mirrors(scene);
    p.resize(count, 2);
    for (int i = 0; i < count; ++i) {
      const bool stray = i % 50 == 7 && strays-- > 0;
      p.id[i] = i;
      for (auto& x : p.position) x[i] = stray ? far(random) : place(random);
      p.density[i] = p.mass[i] = 1;
    }
  }

  void show() {
    show_motion(p, records);
    reflect_motion(images, mirrors, records);
  }

  void list(double distance) {
    sort_particles(p, 0.25 * reach);
    images = find_images(p, mirrors, distance);
    records.motion.resize(p.padded() + images.list.size());
    show();
    find_neighbours(p, images, records, distance, lists);
  }

  double distance(int i, int record) const {
    const auto& x = records.motion[record].position;
    return std::hypot(p.position[0][i] - x[0], p.position[1][i] - x[1]);
  }

  std::vector<int> all_records() const {
    std::vector<int> all(p.count + images.list.size());
    std::iota(all.begin(), all.begin() + p.count, 0);
    std::iota(all.begin() + p.count, all.end(), images.first);
    return all;
  }
};

/// Every cluster lists what a search of all records finds, once, and walls' images last.
void expect_complete(const Cloud& c, double distance) {
  const auto all = c.all_records();
  for (int cluster = 0; cluster < c.p.clusters(); ++cluster) {
    std::set<int> expected[2];
    for (const int j : all)
      for (int i = cluster * lanes; i < std::min((cluster + 1) * lanes, c.p.count); ++i)
        if (c.distance(i, j) <= distance) expected[j >= c.images.first_wall].insert(j);
    const int* begin = c.lists.begin(cluster);
    const int *middle = begin + c.lists.interior[cluster], *end = begin + c.lists.total[cluster];
    EXPECT_EQ(std::multiset<int>(begin, middle), std::multiset<int>(expected[0].begin(), expected[0].end()));
    EXPECT_EQ(std::multiset<int>(middle, end), std::multiset<int>(expected[1].begin(), expected[1].end()));
  }
}

TEST(Neighbours, ListsHoldEveryPairAndNoOther) {
  for (const int count : {1, 8, 13, 1003}) {
    Cloud c(count, side, 0, count);
    c.list(reach);
    expect_complete(c, reach);
  }
}

TEST(Neighbours, StraysFarAwayCostNoPair) {
  Cloud c(803, side, 5, 2);
  c.list(reach);
  ASSERT_GT(*std::max_element(c.p.position[0].begin(), c.p.position[0].begin() + c.p.count), 1e3);
  expect_complete(c, reach);
}

TEST(Neighbours, ListsGrowWhereParticlesCrowd) {
  Cloud c(805, 3 * reach, 0, 4);
  const int before = c.lists.capacity;
  c.list(reach);
  EXPECT_GT(c.lists.capacity, before);
  expect_complete(c, reach);
}

TEST(Neighbours, ListsHoldWhileParticlesMoveHalfTheSkin) {
  const double skin = 0.001, support = reach - skin;
  Cloud c(1003, side, 0, 6);
  c.list(reach);
  const auto listed = c.p.position;
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> angle(0, 6.3);
  for (int i = 0; i < c.p.count; ++i) {
    const double turn = angle(random);
    c.p.position[0][i] = std::clamp(listed[0][i] + 0.4999 * skin * std::cos(turn), 0.0, side);
    c.p.position[1][i] = std::max(listed[1][i] + 0.4999 * skin * std::sin(turn), 0.0);
  }
  EXPECT_NEAR(largest_displacement(c.p, listed), 0.4999 * skin, 1e-12);
  c.show();
  int pairs = 0;
  for (int i = 0; i < c.p.count; ++i) {
    const int cluster = i / lanes;
    const std::set<int> listed_here(c.lists.begin(cluster), c.lists.begin(cluster) + c.lists.total[cluster]);
    for (const int j : c.all_records())
      if (c.distance(i, j) < support) {
        ++pairs;
        EXPECT_TRUE(listed_here.contains(j));
      }
  }
  EXPECT_GT(pairs, 10 * c.p.count);
}

TEST(Neighbours, SortingKeepsEachParticleTogether) {
  Cloud c(1003, side, 3, 8);
  int arrays = 0;
  c.p.each_persistent([&](Array& a) { // tell each value by particle and array
    if (&a != &c.p.position[0] && &a != &c.p.position[1])
      for (int i = 0; i < c.p.count; ++i) a[i] = i + 1e4 * arrays;
    ++arrays;
  });
  const auto before = c.p.position;
  sort_particles(c.p, 0.25 * reach);
  auto ids = std::vector(c.p.id.begin(), c.p.id.begin() + c.p.count);
  int at = 0;
  c.p.each_persistent([&](Array& a) {
    for (int i = 0; i < c.p.count; ++i)
      if (&a == &c.p.position[0] || &a == &c.p.position[1])
        EXPECT_EQ(a[i], before[&a - c.p.position.data()][ids[i]]);
      else
        EXPECT_EQ(a[i], ids[i] + 1e4 * at);
    ++at;
  });
  std::sort(ids.begin(), ids.end());
  for (int i = 0; i < c.p.count; ++i) EXPECT_EQ(ids[i], i);
}

TEST(Neighbours, SortingGathersNeighboursInSpace) {
  Cloud c(4096, side, 0, 9);
  sort_particles(c.p, 0.25 * reach);
  double area = 0;
  for (int first = 0; first < c.p.count; first += lanes) {
    double extent[2];
    for (int a = 0; a < 2; ++a) {
      const auto [low, high] = std::minmax_element(&c.p.position[a][first], &c.p.position[a][first] + lanes);
      extent[a] = *high - *low;
    }
    area += extent[0] * extent[1];
  }
  EXPECT_LT(area, 4 * side * side) << "boxes around clusters overlap much";
}

} // namespace
