// SPDX-License-Identifier: BSD-3-Clause
#include "host/engine/neighbours.hpp"
#include "host/scheme/geometry.hpp"
#include <algorithm>
#include <cstdint>
#include <numeric>

namespace host {
namespace {

/// Interleaves the low 31 bits of two numbers.
std::uint64_t morton(const std::array<std::uint32_t, 2>& cell) {
  const auto spread = [](std::uint64_t v) {
    v = (v | (v << 16)) & 0x0000ffff0000ffffULL;
    v = (v | (v << 8)) & 0x00ff00ff00ff00ffULL;
    v = (v | (v << 4)) & 0x0f0f0f0f0f0f0f0fULL;
    v = (v | (v << 2)) & 0x3333333333333333ULL;
    return (v | (v << 1)) & 0x5555555555555555ULL;
  };
  return spread(cell[0]) | (spread(cell[1]) << 1);
}

/// Square cells over all records, records of a cell contiguous in `sorted`.
template <int D> struct CellGrid {
  std::array<double, D> lower;
  std::array<int, D> cells;
  double size;
  std::vector<int> start, sorted;

  std::array<int, D> cell_of(const double* x) const {
    std::array<int, D> c;
    for (int a = 0; a < D; ++a) c[a] = std::clamp(int((x[a] - lower[a]) / size), 0, cells[a] - 1);
    return c;
  }
  int index(const std::array<int, D>& c) const {
    int i = c[D - 1];
    for (int a = D - 2; a >= 0; --a) i = i * cells[a] + c[a];
    return i;
  }
};

constexpr int largest_grid = 1 << 22;

/// Moves `cell` to the next row of cells in the box `from` to `to`; at the end its last coordinate is beyond `to`.
void next_row(std::array<int, 2>& cell, const std::array<int, 2>&, const std::array<int, 2>&) {
  ++cell[1];
}
void next_row(std::array<int, 3>& cell, const std::array<int, 3>& from, const std::array<int, 3>& to) {
  if (++cell[1] <= to[1]) return;
  cell[1] = from[1];
  ++cell[2];
}

template <class Geometry>
CellGrid<Geometry::dimension> sort_into_cells(const Particles<Geometry>& p, const Images& images,
                                              const Records<Geometry>& records, double size) {
  constexpr int D = Geometry::dimension;
  CellGrid<D> grid;
  std::vector<int> all(p.count + images.list.size());
  std::iota(all.begin(), all.begin() + p.count, 0);
  std::iota(all.begin() + p.count, all.end(), images.first);
  std::array<double, D> upper;
  grid.lower.fill(nowhere);
  upper.fill(-nowhere);
  for (int j : all)
    for (int a = 0; a < D; ++a) {
      grid.lower[a] = std::min(grid.lower[a], records.motion[j].position[a]);
      upper[a] = std::max(upper[a], records.motion[j].position[a]);
    }
  double cells = 0;
  for (grid.size = size;; grid.size *= 2) { // few particles far away would need many empty cells
    cells = 1;
    for (int a = 0; a < D; ++a) cells *= std::floor((upper[a] - grid.lower[a]) / grid.size) + 1;
    if (cells <= largest_grid) break;
  }
  for (int a = 0; a < D; ++a) grid.cells[a] = int((upper[a] - grid.lower[a]) / grid.size) + 1;

  std::vector<int> cell(all.size());
  grid.start.assign(std::size_t(cells) + 1, 0);
  for (std::size_t k = 0; k < all.size(); ++k) {
    cell[k] = grid.index(grid.cell_of(records.motion[all[k]].position));
    ++grid.start[cell[k] + 1];
  }
  std::partial_sum(grid.start.begin(), grid.start.end(), grid.start.begin());
  grid.sorted.resize(all.size());
  std::vector<int> next(grid.start.begin(), grid.start.end() - 1);
  for (std::size_t k = 0; k < all.size(); ++k) grid.sorted[next[cell[k]]++] = all[k];
  return grid;
}

/// Particles in the order of a Morton curve of square cells; in one cell in the order of their creation, so that the
/// result depends on the positions alone.
std::vector<int> spatial_order(const std::array<Array, 2>& position, const std::vector<int>& id, int count,
                               double cell) {
  constexpr double most = double((1u << 31) - 1);
  std::array<double, 2> lower;
  for (int a = 0; a < 2; ++a) lower[a] = *std::min_element(position[a].begin(), position[a].begin() + count);
  std::vector<std::pair<std::uint64_t, int>> order(count);
  for (int i = 0; i < count; ++i) {
    std::array<std::uint32_t, 2> c;
    for (int a = 0; a < 2; ++a) c[a] = std::uint32_t(std::min((position[a][i] - lower[a]) / cell, most));
    order[i] = {morton(c), i};
  }
  std::sort(order.begin(), order.end(), [&](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : id[a.second] < id[b.second];
  });
  std::vector<int> sorted(count);
  for (int i = 0; i < count; ++i) sorted[i] = order[i].second;
  return sorted;
}

/// Halves the particles again and again across the longest side of their box, down to clusters of eight. The boxes
/// around clusters are smaller by a tenth than with a Morton curve, and so are the lists. Particles at the same place
/// are in the order of their creation.
void bisect(const std::array<Array, 3>& position, const std::vector<int>& id, int* begin, int* end) {
  if (end - begin <= lanes) return std::sort(begin, end, [&](int i, int j) { return id[i] < id[j]; });
  int along = 0;
  double longest = -1;
  for (int a = 0; a < 3; ++a) {
    const auto [low, high] =
        std::minmax_element(begin, end, [&](int i, int j) { return position[a][i] < position[a][j]; });
    const double side = position[a][*high] - position[a][*low];
    if (side > longest) {
      longest = side;
      along = a;
    }
  }
  const auto& x = position[along];
  int* middle = begin + ((end - begin) / 2 + lanes - 1) / lanes * lanes;
  std::nth_element(begin, middle, end,
                   [&](int i, int j) { return x[i] != x[j] ? x[i] < x[j] : id[i] < id[j]; });
  bisect(position, id, begin, middle);
  bisect(position, id, middle, end);
}

std::vector<int> spatial_order(const std::array<Array, 3>& position, const std::vector<int>& id, int count,
                               double) {
  std::vector<int> order(count);
  std::iota(order.begin(), order.end(), 0);
  bisect(position, id, order.data(), order.data() + count);
  return order;
}

} // namespace

template <class Geometry> void sort_particles(Particles<Geometry>& p, double cell) {
  const auto order = spatial_order(p.position, p.id, p.count, cell);
  const auto permute = [&](auto& array) {
    auto old = array;
    for (int i = 0; i < p.count; ++i) array[i] = old[order[i]];
  };
  permute(p.id);
  p.each_persistent(permute);
}

/// Squares of the distances of a record from the eight particles of a cluster, m2.
template <std::size_t D> static Lane distance_square(const std::array<Lane, D>& x, const double (&y)[D]) {
  Lane square{};
  for (std::size_t a = 0; a < D; ++a) square += (x[a] - y[a]) * (x[a] - y[a]);
  return square;
}

/// What a neighbour is to a cluster.
enum class Neighbour { interior, wall, screened };

template <class Geometry>
void find_neighbours(const Particles<Geometry>& p, const Images& images, const Records<Geometry>& records,
                     double reach, NeighbourLists& lists, const std::vector<char>& may_be_screened) {
  constexpr int D = Geometry::dimension;
  const auto grid = sort_into_cells(p, images, records, reach);
  lists.interior.resize(p.clusters());
  lists.total.resize(p.clusters());
  lists.screened.resize(p.clusters());
  for (bool fits = false; !fits;) {
    lists.entries.resize(std::size_t(p.clusters()) * lists.capacity);
    int longest = 0;
#pragma omp parallel for schedule(static) reduction(max : longest)
    for (int c = 0; c < p.clusters(); ++c) {
      const int first = c * lanes, used = std::min(lanes, p.count - first);
      std::array<Lane, D> x;
      std::array<int, D> from, to;
      for (int a = 0; a < D; ++a) x[a] = load(&p.position[a][first]);
      double lower[D], upper[D];
      for (int a = 0; a < D; ++a) {
        lower[a] = *std::min_element(&p.position[a][first], &p.position[a][first] + used) - reach;
        upper[a] = *std::max_element(&p.position[a][first], &p.position[a][first] + used) + reach;
      }
      from = grid.cell_of(lower);
      to = grid.cell_of(upper);
      int* out = lists.entries.data() + std::size_t(c) * lists.capacity;
      const bool screened = !may_be_screened.empty() && may_be_screened[c];
      const auto kind_of = [&](int j) {
        if (j < images.first_wall) return Neighbour::interior;
        return screened && images.path(j).in_shell ? Neighbour::screened : Neighbour::wall;
      };
      int n = 0, common = 0;
      for (const auto kind : {Neighbour::interior, Neighbour::wall, Neighbour::screened}) {
        if (kind == Neighbour::screened && !screened) break;
        for (auto cell = from; cell[D - 1] <= to[D - 1]; next_row(cell, from, to))
          for (cell[0] = from[0]; cell[0] <= to[0]; ++cell[0])
            for (int k = grid.start[grid.index(cell)]; k < grid.start[grid.index(cell) + 1]; ++k) {
              const int j = grid.sorted[k];
              if (kind_of(j) != kind) continue;
              if (n < lists.capacity) out[n] = j;
              n += any_within(distance_square(x, records.motion[j].position), reach * reach);
            }
        if (kind == Neighbour::interior) lists.interior[c] = n;
        if (kind == Neighbour::wall) common = n;
      }
      lists.total[c] = n;
      lists.screened[c] = n - common;
      longest = std::max(longest, n);
    }
    fits = longest <= lists.capacity;
    if (!fits) lists.capacity = longest + longest / 16;
  }
}

/// Finds the clusters with screened images. Reserves what all of `outer` would need, so that only a renewal of the outer
/// lists asks for memory.
static void make_room_for_sight(const NeighbourLists& outer, NeighbourLists& lists) {
  const auto most = std::accumulate(outer.screened.begin(), outer.screened.end(), std::size_t(0));
  lists.sight.reserve(lanes * most);
  lists.screened_clusters.reserve(std::min(most, outer.screened.size()));
  lists.screened_clusters.clear();
  lists.sight_start.resize(lists.screened.size());
  int size = 0;
  for (std::size_t c = 0; c < lists.screened.size(); ++c) {
    lists.sight_start[c] = size;
    size += lanes * lists.screened[c];
    if (lists.screened[c] > 0) lists.screened_clusters.push_back(int(c));
  }
  lists.sight.resize(size);
}

template <class Geometry>
void prune(const Particles<Geometry>& p, const Records<Geometry>& records, double reach,
           const NeighbourLists& outer, NeighbourLists& lists) {
  constexpr int D = Geometry::dimension;
  lists.capacity = outer.capacity;
  lists.entries.resize(outer.entries.size());
  lists.interior.resize(p.clusters());
  lists.total.resize(p.clusters());
  lists.screened.resize(p.clusters());
#pragma omp parallel for schedule(static)
  for (int c = 0; c < p.clusters(); ++c) {
    std::array<Lane, D> x;
    for (int a = 0; a < D; ++a) x[a] = load(&p.position[a][c * lanes]);
    const int *next = outer.begin(c), *middle = next + outer.interior[c], *end = next + outer.total[c],
              *seen_by_all = next + outer.common(c);
    int *const begin = lists.entries.data() + std::size_t(c) * lists.capacity, *out = begin;
    const auto keep_until = [&](const int* stop) {
      for (; next < stop; ++next) {
        *out = *next;
        out += any_within(distance_square(x, records.motion[*next].position), reach * reach);
      }
      return int(out - begin);
    };
    lists.interior[c] = keep_until(middle);
    const int common = keep_until(seen_by_all);
    lists.total[c] = keep_until(end);
    lists.screened[c] = lists.total[c] - common;
  }
  make_room_for_sight(outer, lists);
}

template decltype(sort_particles<PlaneStrain>) sort_particles<PlaneStrain>;
template decltype(sort_particles<Axisymmetric>) sort_particles<Axisymmetric>;
template decltype(sort_particles<ThreeDimensional>) sort_particles<ThreeDimensional>;
template decltype(find_neighbours<PlaneStrain>) find_neighbours<PlaneStrain>;
template decltype(find_neighbours<Axisymmetric>) find_neighbours<Axisymmetric>;
template decltype(find_neighbours<ThreeDimensional>) find_neighbours<ThreeDimensional>;
template decltype(prune<PlaneStrain>) prune<PlaneStrain>;
template decltype(prune<Axisymmetric>) prune<Axisymmetric>;
template decltype(prune<ThreeDimensional>) prune<ThreeDimensional>;

} // namespace host
