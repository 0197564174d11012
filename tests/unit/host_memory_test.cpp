// SPDX-License-Identifier: BSD-3-Clause
// What a particle costs in memory, by the sizes of the arrays and by what the process grows; and that a step asks for
// none.
#include "host/engine/step.hpp"
#include "host/scheme/geometry.hpp"
#include "tests/verification/walls_fixture.hpp"
#include <atomic>
#include <cstdlib>
#include <malloc.h>
#include <new>
#include <omp.h>

namespace {
std::atomic<long> allocations{0};
}

void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
void operator delete(void* p) noexcept {
  std::free(p);
}
void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}

namespace {

using namespace host;

constexpr double most_per_particle = 410; // bytes, without the neighbour lists

/// A number of /proc/self/status, bytes.
double status(const std::string& key) {
  std::ifstream file("/proc/self/status");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(key + ":")) return 1024 * std::stod(line.substr(key.size() + 1));
  ADD_FAILURE() << key;
  return 0;
}

/// Of the whole column in three dimensions, with the images of all walls: there are never more.
void expect_bounded(const Scene& scene) {
  { // the program's own pages come first
    auto small = start_simulation<ThreeDimensional>(tests::column_scene(
        {.geometry = "three_dimensional\"\nsector = \"quarter", .spacing = 0.007}, "memory_small"));
    step(small);
  }
  malloc_trim(0);
  const double before = status("VmRSS");
  auto s = start_simulation<ThreeDimensional>(scene);
  update_lists(s);
  const auto memory = memory_of(s);
  malloc_trim(0); // what the search for neighbours needed for a moment goes back to the system
  const double count = s.particles.count, growth = status("VmRSS") - before;
  EXPECT_GT(count, 45000);
  EXPECT_LE(memory.data / count, most_per_particle);
  EXPECT_LE((growth - double(memory.lists)) / count, most_per_particle) << "as the system sees it";
  std::printf("%.0f bytes of data per particle, %.0f of lists; the process grew by %.0f\n",
              memory.data / count, memory.lists / count, growth / count);
}

/// A column in a tube that is lifted, by a list of walls.
Scene walled_scene(double spacing) {
  return tests::wall_scene(
      {.geometry = "three_dimensional\"\nsector = \"full",
       .column = "radius = 0.05\nheight = 0.05",
       .material = tests::sand("TS", 0.4451),
       .walls = "[[wall]]\nname = \"ground\"\nshape = \"plane\"\npoint = [0, 0, 0]\nnormal = [0, 0, 1]\n"
                "friction = 0.5\n[[wall]]\nname = \"tube\"\nshape = \"cylinder\"\nside = \"inside\"\n"
                "radius = 0.05\nlower = 0\nfriction = 0\nvelocity = [0, 0, 1.6]\n",
       .spacing = spacing},
      "memory_walls");
}

TEST(Memory, OfAParticleOfTheWholeColumnInThreeDimensions) {
  expect_bounded(tests::column_scene({.geometry = "three_dimensional\"\nsector = \"full"}, "memory"));
}

TEST(Memory, OfAParticleAmongWalls) {
  expect_bounded(walled_scene(0.002));
}

template <class Geometry> void expect_no_allocation(const Scene& scene) {
  auto s = start_simulation<Geometry>(scene);
  for (int k = 0; k < 200; ++k) step(s); // all that grows has grown
  int steps = 0;
  for (int k = 0; k < 100; ++k) {
    const long rebuilds = s.rebuilds, before = allocations;
    step(s);
    if (s.rebuilds > rebuilds) continue;
    ++steps;
    EXPECT_EQ(allocations - before, 0) << "step " << s.steps;
  }
  EXPECT_GT(steps, 50);
}

TEST(Memory, AStepAllocatesNothing) {
  const int threads = omp_get_max_threads();
  omp_set_num_threads(1);
  expect_no_allocation<PlaneStrain>(
      tests::column_scene({.geometry = "plane_strain", .spacing = 0.004}, "allocation"));
  expect_no_allocation<Axisymmetric>(tests::column_scene({.spacing = 0.004}, "allocation"));
  expect_no_allocation<ThreeDimensional>(tests::column_scene(
      {.geometry = "three_dimensional\"\nsector = \"quarter", .spacing = 0.007}, "allocation"));
  expect_no_allocation<ThreeDimensional>(walled_scene(0.007));
  omp_set_num_threads(threads);
}

} // namespace
