// Cell lists, k-d tree and candidate search against a search through all pairs.

#include "sample_clouds.h"

#include "meshless/cloud/candidate_search.h"
#include "meshless/cloud/cell_list.h"
#include "meshless/cloud/levelled_cells.h"
#include "meshless/cloud/neighbour_collector.h"
#include "meshless/cloud/point_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace meshless::cloud;
using sample_clouds::random_points;

template <typename Dimension>
class NeighbourSearch : public testing::Test {
protected:
  static constexpr int n_dimensions = Dimension::value;
  using Points = std::vector<Point<n_dimensions>>;
  using Found = std::vector<Index>;

  static Point<n_dimensions> filled(double value) {
    Point<n_dimensions> x;
    x.fill(value);
    return x;
  }

  static Found brute_force(const Points &points, const Point<n_dimensions> &centre, double radius) {
    Found found;
    for (std::size_t j = 0; j < points.size(); ++j)
      if (distance_squared<n_dimensions>(points[j], centre) < radius * radius)
        found.push_back(static_cast<Index>(j));
    return found;
  }

  template <typename Search>
  static Found sorted(const Search &search, const Point<n_dimensions> &centre, double radius) {
    Found found;
    search.append_within(centre, radius, found);
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Cell list and tree find what all pairs give, around particles and around points anywhere.
  static void expect_same(const Points &points, double radius, const Points &others) {
    const CellList<n_dimensions> fine(points, radius / 2);
    const CellList<n_dimensions> coarse(points, 3 * radius);
    const PointTree<n_dimensions> tree(points);
    Points centres = others;
    centres.insert(centres.end(), points.begin(), points.end());
    for (const auto &centre : centres) {
      const auto expected = brute_force(points, centre, radius);
      ASSERT_EQ(sorted(fine, centre, radius), expected);
      ASSERT_EQ(sorted(coarse, centre, radius), expected);
      ASSERT_EQ(sorted(tree, centre, radius), expected);
    }
    const auto lists = fine.all_within(radius);
    ASSERT_EQ(lists.n_rows(), points.size());
    std::size_t n_entries = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto row = lists[i];
      ASSERT_EQ(Found(row.begin(), row.end()), brute_force(points, points[i], radius));
      n_entries += row.size();
    }
    ASSERT_EQ(lists.n_entries(), n_entries);
  }

  /// Inside, around and far away from the unit box.
  static Points probes() {
    auto points = random_points<n_dimensions>(50, filled(-.5), filled(1.5), 7);
    for (const double far : {-1e12, -10., 10., 1e12})
      points.push_back(filled(far));
    return points;
  }
};

template <int n>
using Dim = std::integral_constant<int, n>;
using Dimensions = testing::Types<Dim<1>, Dim<2>, Dim<3>>;
TYPED_TEST_SUITE(NeighbourSearch, Dimensions);

TYPED_TEST(NeighbourSearch, equals_all_pairs_on_random_clouds) {
  for (const double radius : {.02, .17, .6, 4.})
    this->expect_same(random_points<TypeParam::value>(250, this->filled(0), this->filled(1), 1), radius,
                      this->probes());
}

TYPED_TEST(NeighbourSearch, equals_all_pairs_with_particles_almost_at_one_place) {
  auto points = random_points<TypeParam::value>(100, this->filled(0), this->filled(1), 2);
  for (std::size_t i = 0; i < 50; ++i) {
    points.push_back(points[i]);
    points.back()[0] = std::nextafter(points.back()[0], 2);
  }
  this->expect_same(points, .2, this->probes());
  this->expect_same(points, 1e-14, this->probes());
}

TYPED_TEST(NeighbourSearch, equals_all_pairs_where_the_box_is_nearly_empty) {
  // Two clusters 1e6 apart: cells of the search radius would number 1e8 a direction.
  auto points = random_points<TypeParam::value>(60, this->filled(0), this->filled(1), 3);
  for (const auto &x : random_points<TypeParam::value>(60, this->filled(0), this->filled(1), 4)) {
    points.push_back(x);
    for (double &component : points.back())
      component += 1e6;
  }
  this->expect_same(points, .02, this->probes());
  this->expect_same(points, .5, this->probes());
}

TYPED_TEST(NeighbourSearch, equals_all_pairs_far_from_the_origin) {
  auto points = random_points<TypeParam::value>(200, this->filled(1e6), this->filled(1e6 + 1), 5);
  this->expect_same(points, .2, random_points<TypeParam::value>(50, this->filled(1e6 - 1), this->filled(1e6 + 2), 6));
}

TYPED_TEST(NeighbourSearch, particles_at_exactly_the_radius_are_outside) {
  // Integer positions: distances and the radius 2 are exact in floating point.
  std::array<int, TypeParam::value> n;
  n.fill(6);
  const auto points = sample_clouds::grid<TypeParam::value>(n, this->filled(0), this->filled(5));
  this->expect_same(points, 2, this->probes());
  const CellList<TypeParam::value> cells(points, 1);
  const auto found = this->sorted(cells, this->filled(2), 1);
  EXPECT_EQ(found.size(), 1u);
}

TYPED_TEST(NeighbourSearch, points_sorted_by_cells_stay_in_place_and_have_the_same_neighbours) {
  constexpr int dim = TypeParam::value;
  const auto points = random_points<dim>(400, this->filled(0), this->filled(1), 11);
  const double radius = .15;
  const CellList<dim> cells(points, radius);
  std::vector<Point<dim>> sorted;
  for (const Index i : cells.order())
    sorted.push_back(points[static_cast<std::size_t>(i)]);
  const CellList<dim> again(sorted, radius);
  for (std::size_t slot = 0; slot < sorted.size(); ++slot)
    ASSERT_EQ(again.order()[slot], static_cast<Index>(slot));
  this->expect_same(sorted, radius, this->probes());
  const auto lists = again.all_within(radius);
  for (std::size_t i = 0; i < sorted.size(); ++i)
    ASSERT_EQ(std::vector<Index>(lists[i].begin(), lists[i].end()), this->brute_force(sorted, sorted[i], radius));
}

TYPED_TEST(NeighbourSearch, one_particle_and_particles_on_a_line) {
  this->expect_same({this->filled(.3)}, .5, this->probes());
  auto points = random_points<TypeParam::value>(80, this->filled(0), this->filled(1), 8);
  for (auto &x : points)
    for (int k = 1; k < TypeParam::value; ++k)
      x[k] = .5;
  this->expect_same(points, .1, this->probes());
}

TYPED_TEST(NeighbourSearch, nearest_are_sorted_and_equal_all_pairs) {
  const auto points = random_points<TypeParam::value>(150, this->filled(0), this->filled(1), 9);
  const PointTree<TypeParam::value> tree(points);
  for (const auto &centre : this->probes()) {
    std::vector<double> all;
    for (const auto &x : points)
      all.push_back(std::sqrt(distance_squared<TypeParam::value>(x, centre)));
    std::sort(all.begin(), all.end());
    std::vector<Index> indices;
    std::vector<double> distances;
    tree.nearest(centre, 7, indices, distances);
    ASSERT_EQ(distances.size(), 7u);
    for (std::size_t k = 0; k < 7; ++k) {
      // One rounding of the squared distance may differ between the two programs.
      EXPECT_NEAR(distances[k], all[k], 4e-16 * all[k]);
      const auto &x = points[static_cast<std::size_t>(indices[k])];
      EXPECT_NEAR(std::sqrt(distance_squared<TypeParam::value>(x, centre)), distances[k], 4e-16 * all[k]);
    }
    tree.nearest(centre, 1000, indices, distances);
    EXPECT_EQ(indices.size(), points.size()) << "all there are, when more are asked for";
  }
}

TYPED_TEST(NeighbourSearch, candidates_are_the_particles_whose_support_reaches_the_ball) {
  constexpr int dim = TypeParam::value;
  const auto points = random_points<dim>(300, this->filled(0), this->filled(1), 10);
  sample_clouds::Uniform random(11);
  std::vector<double> varying(points.size());
  for (double &h : varying)
    h = random.between(.01, .1);
  std::vector<double> graded(points.size()); // on twenty levels
  for (double &h : graded)
    h = std::pow(10., random.between(-7, -1));
  const std::vector<double> uniform(points.size(), .05);
  for (const auto &lengths : {uniform, varying, graded}) {
    const Particles<dim> particles(points, lengths);
    const double support = 3;
    const CandidateSearch<dim> search(particles, support);
    EXPECT_EQ(search.support(), support);
    std::vector<Index> found{42}; // is replaced
    for (const auto &centre : this->probes())
      for (const double radius : {0., .01, .2}) {
        std::vector<Index> expected;
        for (std::size_t j = 0; j < points.size(); ++j) {
          const double reach = support * lengths[j] + radius;
          if (distance_squared<dim>(points[j], centre) < reach * reach)
            expected.push_back(static_cast<Index>(j));
        }
        search.collect(centre, radius, found);
        ASSERT_EQ(found, expected);
      }
  }
}

TYPED_TEST(NeighbourSearch, neighbours_are_the_particles_whose_support_holds_the_point) {
  constexpr int dim = TypeParam::value;
  const auto points = random_points<dim>(300, this->filled(0), this->filled(1), 12);
  sample_clouds::Uniform random(13);
  std::vector<double> within_two(points.size());
  for (double &h : within_two)
    h = random.between(.04, .07);
  std::vector<double> varying(points.size());
  for (double &h : varying)
    h = random.between(.01, .1);
  for (const auto &lengths : {std::vector<double>(points.size(), .05), within_two, varying}) {
    const Particles<dim> particles(points, lengths);
    const CandidateSearch<dim> search(particles, 3);
    NeighbourCollector<dim> collector(search);
    for (int pass = 0; pass < 2; ++pass) { // lists of an earlier pass do not stay
      std::vector<Point<dim>> centres;
      collector.clear();
      for (const std::size_t n : {1, 7, 0, 50}) {
        const auto box = n == 50 ? this->probes() : random_points<dim>(n, this->filled(.4), this->filled(.6), 14 + n);
        collector.append(box);
        centres.insert(centres.end(), box.begin(), box.end());
      }
      for (std::size_t i = 0; i < centres.size(); ++i) {
        std::vector<Index> expected;
        for (std::size_t j = 0; j < points.size(); ++j)
          if (distance_squared<dim>(points[j], centres[i]) < 9 * lengths[j] * lengths[j])
            expected.push_back(static_cast<Index>(j));
        ASSERT_EQ(std::vector<Index>(collector[i].begin(), collector[i].end()), expected) << i;
      }
    }
  }
}

TYPED_TEST(NeighbourSearch, levels_hold_sizes_within_a_factor_of_two_and_find_what_all_pairs_give) {
  constexpr int dim = TypeParam::value;
  const auto points = random_points<dim>(300, this->filled(0), this->filled(1), 15);
  sample_clouds::Uniform random(16);
  std::vector<double> sizes(points.size());
  for (double &size : sizes)
    size = std::pow(2., random.between(-8, -1));
  const LevelledCells<dim> cells(points, sizes, 1);
  EXPECT_GE(cells.n_levels(), 7u);
  EXPECT_LE(cells.n_levels(), 8u);
  EXPECT_EQ(LevelledCells<dim>(points, std::vector<double>(points.size(), .1), 1).n_levels(), 1u);
  for (const auto &centre : this->probes())
    for (const double radius : {.01, .1, .5}) {
      std::vector<Index> found{42}; // stays
      cells.append_within(centre, radius, 0, found);
      EXPECT_EQ(found.front(), 42);
      std::sort(found.begin() + 1, found.end());
      ASSERT_EQ(std::vector<Index>(found.begin() + 1, found.end()), this->brute_force(points, centre, radius));
      // With the size of the particle itself, rounded up to that of its level.
      found.clear();
      cells.append_within(centre, radius, 2, found);
      std::sort(found.begin(), found.end());
      for (std::size_t j = 0; j < points.size(); ++j) {
        const double d = std::sqrt(distance_squared<dim>(points[j], centre));
        const bool in = std::binary_search(found.begin(), found.end(), static_cast<Index>(j));
        ASSERT_TRUE(in || d >= radius + 2 * sizes[j]) << j;
        ASSERT_TRUE(!in || d <= radius + 4 * sizes[j]) << j;
      }
    }
}

TEST(LevelledCells, refuse_what_cannot_be_searched) {
  const std::vector<Point<2>> two{{0, 0}, {1, 0}};
  EXPECT_THROW(LevelledCells<2>(two, std::vector<double>{1}, 1), std::invalid_argument);
  EXPECT_THROW(LevelledCells<2>({}, {}, 1), std::invalid_argument);
  for (const double size : {0., -1., std::nan("")})
    EXPECT_THROW(LevelledCells<2>(two, std::vector<double>{size, 1}, 1), std::invalid_argument);
}

TEST(CellList, refuses_what_cannot_be_searched) {
  const std::vector<Point<2>> none;
  const std::vector<Point<2>> one{{0, 0}};
  EXPECT_THROW(CellList<2>(none, 1), std::invalid_argument);
  for (const double size : {0., -1., std::nan("")})
    EXPECT_THROW(CellList<2>(one, size), std::invalid_argument);
}

TEST(NeighbourLists, check_their_invariant) {
  const NeighbourLists lists({0, 2, 2, 3}, {4, 5, 6});
  EXPECT_EQ(lists.n_rows(), 3u);
  EXPECT_EQ(lists[0].size(), 2u);
  EXPECT_TRUE(lists[1].empty());
  EXPECT_EQ(lists[2][0], 6);
  EXPECT_EQ(NeighbourLists().n_rows(), 0u);
  using Offsets = std::vector<std::size_t>;
  for (const auto &offsets : {Offsets{}, Offsets{1, 3}, Offsets{0, 2}, Offsets{0, 2, 1, 3}})
    EXPECT_THROW(NeighbourLists(offsets, {4, 5, 6}), std::invalid_argument);
}

} // namespace
