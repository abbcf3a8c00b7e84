#include "meshless/cloud/point_tree.h"

#include <nanoflann.hpp>

#include <cmath>

namespace meshless::cloud {

namespace {

/// What nanoflann asks of a set of points.
template <int dim>
struct PointSet {
  std::span<const Point<dim>> positions;

  std::size_t kdtree_get_point_count() const { return positions.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t k) const { return positions[i][k]; }
  template <class Box>
  bool kdtree_get_bbox(Box &) const {
    return false;
  }
};

} // namespace

template <int dim>
struct PointTree<dim>::Tree {
  using Adaptor = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, PointSet<dim>>,
                                                      PointSet<dim>, dim, Index>;

  explicit Tree(std::span<const Point<dim>> positions)
      : points{positions}, adaptor(dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(10)) {
    adaptor.buildIndex();
  }

  PointSet<dim> points;
  Adaptor adaptor;
};

template <int dim>
PointTree<dim>::PointTree(std::span<const Point<dim>> positions) : tree_(std::make_unique<Tree>(positions)) {}

template <int dim>
PointTree<dim>::~PointTree() = default;
template <int dim>
PointTree<dim>::PointTree(PointTree &&) noexcept = default;
template <int dim>
PointTree<dim> &PointTree<dim>::operator=(PointTree &&) noexcept = default;

template <int dim>
void PointTree<dim>::append_within(const Point<dim> &centre, double radius, std::vector<Index> &result) const {
  // nanoflann's metric is the squared distance; its comparison is strict, as ours.
  std::vector<std::pair<Index, double>> found;
  tree_->adaptor.radiusSearch(centre.data(), radius * radius, found, nanoflann::SearchParams(32, 0, false));
  for (const auto &[index, squared] : found)
    result.push_back(index);
}

template <int dim>
void PointTree<dim>::nearest(const Point<dim> &centre, int k, std::vector<Index> &indices,
                             std::vector<double> &distances) const {
  indices.resize(static_cast<std::size_t>(k));
  distances.resize(static_cast<std::size_t>(k));
  const auto n = tree_->adaptor.knnSearch(centre.data(), static_cast<std::size_t>(k), indices.data(), distances.data());
  indices.resize(n);
  distances.resize(n);
  for (double &d : distances)
    d = std::sqrt(d);
}

template class PointTree<1>;
template class PointTree<2>;
template class PointTree<3>;

} // namespace meshless::cloud
