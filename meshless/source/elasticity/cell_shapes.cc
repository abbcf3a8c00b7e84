#include "meshless/elasticity/cell_shapes.h"

#include "meshless/cloud/point_tree.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace meshless::elasticity {

namespace {

using Vector = Eigen::Vector2d;
using Matrix = Eigen::Matrix2d;

/// Particles of one region, by which moments are averaged, in spacings.
constexpr double averaged_within = 2;

Vector vector_of(const Point2 &x) { return {x[0], x[1]}; }

/// A convex cell about the origin, counter-clockwise.
class Cell {
public:
  explicit Cell(double half_side)
      : corners_{{-half_side, -half_side}, {half_side, -half_side}, {half_side, half_side}, {-half_side, half_side}} {}

  /// Keeps what has n . x <= c, c >= 0.
  void cut(const Vector &n, double c) {
    kept_.clear();
    for (std::size_t k = 0; k < corners_.size(); ++k) {
      const Vector &a = corners_[k];
      const Vector &b = corners_[(k + 1) % corners_.size()];
      const double beyond_a = n.dot(a) - c;
      const double beyond_b = n.dot(b) - c;
      if (beyond_a <= 0)
        kept_.push_back(a);
      if ((beyond_a <= 0) != (beyond_b <= 0))
        kept_.push_back(a + beyond_a / (beyond_a - beyond_b) * (b - a));
    }
    corners_.swap(kept_);
  }

  double radius() const {
    double squared = 0;
    for (const Vector &a : corners_)
      squared = std::max(squared, a.squaredNorm());
    return std::sqrt(squared);
  }

  Matrix moments() const {
    double area = 0;
    Matrix sum = Matrix::Zero();
    for (std::size_t k = 0; k < corners_.size(); ++k) { // triangles with the origin
      const Vector &a = corners_[k];
      const Vector &b = corners_[(k + 1) % corners_.size()];
      const double triangle = 0.5 * (a[0] * b[1] - a[1] * b[0]);
      const Vector ab = a + b;
      area += triangle;
      sum += triangle * (a * a.transpose() + b * b.transpose() + ab * ab.transpose());
    }
    return sum / area; // 12 / area times the twelfth part
  }

private:
  std::vector<Vector> corners_;
  std::vector<Vector> kept_;
};

/// The particles of one region.
class RegionCells {
public:
  RegionCells(const domain::Boundary &boundary, std::vector<Point2> positions)
      : boundary_(boundary), positions_(std::move(positions)), tree_(positions_) {}

  std::vector<Matrix> moments() {
    std::vector<Matrix> result;
    for (const auto &x : positions_)
      result.push_back(moments_at(x));
    return averaged(result);
  }

private:
  Matrix moments_at(const Point2 &x) {
    Cell cell(boundary_.extent());
    for (std::size_t n = 0, n_next = 16; n < positions_.size(); n_next *= 2) {
      tree_.nearest(x, static_cast<int>(std::min(n_next, positions_.size())), indices_, distances_);
      for (; n < indices_.size(); ++n) { // the first is the particle itself
        if (distances_[n] > 2 * cell.radius())
          break;
        const Vector d = vector_of(positions_[static_cast<std::size_t>(indices_[n])]) - vector_of(x);
        if (d.squaredNorm() > 0)
          cell.cut(d, 0.5 * d.squaredNorm());
      }
      if (n < indices_.size())
        break;
    }
    boundary_.pieces_within(x, cell.radius(), near_);
    for (const std::size_t i : near_) {
      const auto &piece = boundary_.pieces()[i];
      const double t = piece.nearest(x);
      const Vector d = vector_of(piece.point(t)) - vector_of(x);
      if (d.norm() <= boundary_.tolerance())
        cell.cut(vector_of(piece.normal(t)), 0);
      else if (t > 0 && t < 1) // else the boundary goes on there
        cell.cut(d, d.squaredNorm());
    }
    return cell.moments();
  }

  std::vector<Matrix> averaged(const std::vector<Matrix> &own) {
    std::vector<Matrix> result;
    for (std::size_t i = 0; i < own.size(); ++i) {
      const Matrix inverse = own[i].inverse() / (averaged_within * averaged_within);
      const double reach = averaged_within * std::sqrt(own[i].selfadjointView<Eigen::Lower>().eigenvalues().maxCoeff());
      indices_.clear();
      tree_.append_within(positions_[i], reach, indices_);
      std::sort(indices_.begin(), indices_.end());
      Matrix sum = Matrix::Zero();
      double weights = 0;
      for (const auto j : indices_) {
        const Vector d = vector_of(positions_[static_cast<std::size_t>(j)]) - vector_of(positions_[i]);
        const double weight = std::max(0.0, 1 - d.dot(inverse * d));
        sum += weight * own[static_cast<std::size_t>(j)];
        weights += weight;
      }
      result.push_back(sum / weights);
    }
    return result;
  }

  const domain::Boundary &boundary_;
  std::vector<Point2> positions_;
  cloud::PointTree<2> tree_;
  std::vector<cloud::Index> indices_;
  std::vector<double> distances_;
  std::vector<std::size_t> near_;
};

} // namespace

CellShapes cell_shapes(const Surroundings &surroundings, std::span<const Point2> positions,
                       std::span<const int> regions) {
  CellShapes shapes{std::vector<double>(positions.size()), std::vector<cloud::Point<2>>(positions.size())};
  std::vector<double> aspects;
  for (std::size_t r = 0; r < surroundings.n_regions(); ++r) {
    std::vector<Point2> own;
    std::vector<std::size_t> indices;
    for (std::size_t i = 0; i < positions.size(); ++i)
      if ((regions.empty() ? 0 : static_cast<std::size_t>(regions[i])) == r) {
        own.push_back(positions[i]);
        indices.push_back(i);
      }
    if (own.empty())
      continue;
    const auto moments = RegionCells(surroundings.boundary(r), std::move(own)).moments();
    for (std::size_t k = 0; k < indices.size(); ++k) {
      const Eigen::SelfAdjointEigenSolver<Matrix> axes(moments[k]);
      const double aspect = std::sqrt(axes.eigenvalues()[1] / axes.eigenvalues()[0]);
      const Vector flattening = std::sqrt((aspect - 1) * (aspect + 1)) * axes.eigenvectors().col(0);
      shapes.smoothing_lengths[indices[k]] = std::sqrt(axes.eigenvalues()[1]);
      shapes.flattenings[indices[k]] = {flattening[0], flattening[1]};
      aspects.push_back(aspect);
    }
  }
  if (!aspects.empty()) {
    const auto upper = aspects.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(aspects.size() - 1));
    std::nth_element(aspects.begin(), upper, aspects.end());
    shapes.upper_aspect = *upper;
  }
  return shapes;
}

} // namespace meshless::elasticity
