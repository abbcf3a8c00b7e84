#include "stiffness_operator.h"

#include "../elasticity/stiffness.h"
#include "batch_parts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <experimental/simd>
#include <vector>

namespace fem_reference::multigrid {
namespace {
namespace simd = std::experimental;
using elasticity::Discretisation;
using elasticity::LagrangeBasis;
using elasticity::Material;
using parallel::Band;

/// Values and derivatives of the one-dimensional shape functions at the Gauss points: value[q][a].
template <typename Number, int n>
struct LineTable {
  LineTable(const LagrangeBasis &line) {
    const auto gauss = elasticity::gauss_quadrature(n);
    LagrangeBasis::Values values, derivatives;
    for (int q = 0; q < n; ++q) {
      line.evaluate(gauss.points[q], values, derivatives);
      for (int a = 0; a < n; ++a) {
        value[q][a] = static_cast<Number>(values[a]);
        slope[q][a] = static_cast<Number>(derivatives[a]);
      }
      weight[q] = gauss.weights[q];
    }
  }

  std::array<std::array<Number, n>, n> value;
  std::array<std::array<Number, n>, n> slope;
  std::array<double, n> weight;
};

/// `n` = p + 1 nodes and Gauss points a direction.
template <typename Number, int n>
class CellwiseStiffness : public StiffnessOperator<Number> {
public:
  CellwiseStiffness(const Discretisation &space, std::span<const Material> materials, std::span<const char> prescribed,
                    double scale);

  void apply(std::span<const Number> x, std::span<Number> y) const override;
  std::vector<Number> diagonal() const override;
  std::size_t bytes() const override {
    return geometry_.size() * sizeof(Number) + nodes_.size() * sizeof(unsigned) + moduli_.size() * sizeof(Number);
  }

private:
  using Lanes = simd::native_simd<Number>;
  static constexpr std::size_t lanes = Lanes::size();
  static constexpr int n_nodes = n * n;
  using Table = std::array<Lanes, n_nodes>;

  void set_geometry(const Discretisation &space);
  /// Returns false if the Jacobian is not positive at some point.
  bool set_geometry_of(std::size_t cell, const Discretisation &space);
  /// Calls function(part) for every part, several at once.
  template <typename Function>
  void for_each_part(const Function &function) const {
    parallel::for_each_band(parts_.size(), static_cast<int>(parts_.size()),
                            [&](const Band &, int k) { function(parts_[static_cast<std::size_t>(k)]); });
  }
  void add_batch(const BatchPart &part, const BatchPart::Batch &batch, const Number *x, Number *y) const;
  void add_diagonal(const BatchPart &part, const BatchPart::Batch &batch, Number *y) const;
  void add_to_node(const BatchPart &part, const BatchPart::Batch &batch, int a, const Lanes &v1, const Lanes &v2,
                   Number *y) const;
  /// Derivatives along both axes of the reference cell at the Gauss points.
  void differentiate(const Table &values, Table &along_1, Table &along_2) const;
  /// The transpose: values = sum of the shape functions' derivatives times the given.
  void integrate(const Table &along_1, const Table &along_2, Table &values) const;

  LineTable<Number, n> line_;
  LineTable<double, n> exact_line_;
  std::size_t n_batches_;
  std::vector<unsigned> nodes_;      ///< [batch][node][lane]; what is left of the last batch repeats cell 0
  std::vector<Number> moduli_;       ///< [batch][lambda, mu][lane]
  std::vector<Number> geometry_;     ///< [batch][point][S11, S12, S21, S22][lane], see set_geometry
  std::vector<BatchPart> parts_;     ///< as many as there were threads
  std::vector<unsigned> prescribed_; ///< unknowns
  std::size_t n_unknowns_;
};

template <typename Number, int n>
CellwiseStiffness<Number, n>::CellwiseStiffness(const Discretisation &space, std::span<const Material> materials,
                                                std::span<const char> prescribed, double scale)
    : line_(space.elements[1].line()), exact_line_(space.elements[1].line()),
      n_batches_((space.n_cells + lanes - 1) / lanes), nodes_(n_batches_ * n_nodes * lanes),
      moduli_(n_batches_ * 2 * lanes), geometry_(n_batches_ * n_nodes * 4 * lanes), n_unknowns_(2 * space.n_nodes()) {
  for (std::size_t c = 0; c < n_batches_ * lanes; ++c) {
    const bool filled = c < space.n_cells;
    const auto cell_nodes = space.nodes_of(filled ? c : 0);
    for (int a = 0; a < n_nodes; ++a)
      nodes_[(c / lanes * n_nodes + a) * lanes + c % lanes] = cell_nodes[a];
    const auto &material = materials[static_cast<std::size_t>(space.regions[filled ? c : 0])];
    moduli_[c / lanes * 2 * lanes + c % lanes] = static_cast<Number>(material.lambda() / scale);
    moduli_[(c / lanes * 2 + 1) * lanes + c % lanes] = static_cast<Number>(material.mu() / scale);
  }
  set_geometry(space);
  parts_ = share_out(nodes_, n_nodes * lanes, space.n_nodes());
  for (std::size_t i = 0; i < prescribed.size(); ++i)
    if (prescribed[i] != 0)
      prescribed_.push_back(static_cast<unsigned>(i));
}

/// S_ki = sqrt(w det J) d xi_k / d x_i: with it grad u = sum_k S_ki du / d xi_k has the weight of the quadrature in
/// itself, once in the strain and once in the test function. In the plane S does not depend on the cell's size.
template <typename Number, int n>
bool CellwiseStiffness<Number, n>::set_geometry_of(std::size_t c, const Discretisation &space) {
  const auto &t = exact_line_;
  const auto nodes = space.nodes_of(c);
  for (int q2 = 0; q2 < n; ++q2)
    for (int q1 = 0; q1 < n; ++q1) {
      double j11 = 0, j12 = 0, j21 = 0, j22 = 0; // j_ik = d x_i / d xi_k
      for (int a2 = 0; a2 < n; ++a2)
        for (int a1 = 0; a1 < n; ++a1) {
          const auto &x = space.positions[nodes[a2 * n + a1]];
          const double along_1 = t.slope[q1][a1] * t.value[q2][a2];
          const double along_2 = t.value[q1][a1] * t.slope[q2][a2];
          j11 += x[0] * along_1;
          j12 += x[0] * along_2;
          j21 += x[1] * along_1;
          j22 += x[1] * along_2;
        }
      const double determinant = j11 * j22 - j12 * j21;
      if (!(determinant > 0))
        return false;
      const double factor = std::sqrt(t.weight[q1] * t.weight[q2] / determinant);
      const std::array<double, 4> s{j22 * factor, -j12 * factor, -j21 * factor, j11 * factor};
      for (std::size_t k = 0; k < 4; ++k)
        geometry_[((c / lanes * n_nodes + q2 * n + q1) * 4 + k) * lanes + c % lanes] = static_cast<Number>(s[k]);
    }
  return true;
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::set_geometry(const Discretisation &space) {
  const int n_bands = parallel::n_short_bands(space.n_nodes());
  std::vector<std::size_t> faulty(static_cast<std::size_t>(n_bands), space.n_cells);
  parallel::for_each_band(space.n_cells, n_bands, [&](const Band &cells, int k) {
    for (std::size_t c = cells.begin; c < cells.end; ++c)
      if (!set_geometry_of(c, space)) {
        faulty[static_cast<std::size_t>(k)] = c;
        return;
      }
  });
  if (const auto first = *std::min_element(faulty.begin(), faulty.end()); first < space.n_cells)
    elasticity::refuse_jacobian(space, first);
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::differentiate(const Table &values, Table &along_1, Table &along_2) const {
  Table value_1;
  Table slope_1;
  for (int a2 = 0; a2 < n; ++a2)
    for (int q1 = 0; q1 < n; ++q1) {
      Lanes value = line_.value[q1][0] * values[a2 * n];
      Lanes slope = line_.slope[q1][0] * values[a2 * n];
      for (int a1 = 1; a1 < n; ++a1) {
        value += line_.value[q1][a1] * values[a2 * n + a1];
        slope += line_.slope[q1][a1] * values[a2 * n + a1];
      }
      value_1[a2 * n + q1] = value;
      slope_1[a2 * n + q1] = slope;
    }
  for (int q2 = 0; q2 < n; ++q2)
    for (int q1 = 0; q1 < n; ++q1) {
      Lanes first = line_.value[q2][0] * slope_1[q1];
      Lanes second = line_.slope[q2][0] * value_1[q1];
      for (int a2 = 1; a2 < n; ++a2) {
        first += line_.value[q2][a2] * slope_1[a2 * n + q1];
        second += line_.slope[q2][a2] * value_1[a2 * n + q1];
      }
      along_1[q2 * n + q1] = first;
      along_2[q2 * n + q1] = second;
    }
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::integrate(const Table &along_1, const Table &along_2, Table &values) const {
  Table slope_1;
  Table value_1;
  for (int a2 = 0; a2 < n; ++a2)
    for (int q1 = 0; q1 < n; ++q1) {
      Lanes first = line_.value[0][a2] * along_1[q1];
      Lanes second = line_.slope[0][a2] * along_2[q1];
      for (int q2 = 1; q2 < n; ++q2) {
        first += line_.value[q2][a2] * along_1[q2 * n + q1];
        second += line_.slope[q2][a2] * along_2[q2 * n + q1];
      }
      slope_1[a2 * n + q1] = first;
      value_1[a2 * n + q1] = second;
    }
  for (int a2 = 0; a2 < n; ++a2)
    for (int a1 = 0; a1 < n; ++a1) {
      Lanes sum = line_.slope[0][a1] * slope_1[a2 * n] + line_.value[0][a1] * value_1[a2 * n];
      for (int q1 = 1; q1 < n; ++q1)
        sum += line_.slope[q1][a1] * slope_1[a2 * n + q1] + line_.value[q1][a1] * value_1[a2 * n + q1];
      values[a2 * n + a1] = sum;
    }
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::add_to_node(const BatchPart &part, const BatchPart::Batch &batch, int a,
                                               const Lanes &v1, const Lanes &v2, Number *y) const {
  const unsigned *node = nodes_.data() + (std::size_t{batch.number} * n_nodes + a) * lanes;
  for (std::size_t lane = 0; lane < lanes; ++lane)
    if (batch.inside || part.band.holds(node[lane])) {
      y[2 * std::size_t{node[lane]}] += v1[lane];
      y[2 * std::size_t{node[lane]} + 1] += v2[lane];
    }
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::add_batch(const BatchPart &part, const BatchPart::Batch &batch, const Number *x,
                                             Number *y) const {
  const std::size_t b = batch.number;
  const unsigned *nodes = nodes_.data() + b * n_nodes * lanes;
  Table u1;
  Table u2;
  for (int a = 0; a < n_nodes; ++a) {
    const unsigned *node = nodes + a * lanes;
    u1[a] = Lanes([&](auto lane) { return x[2 * std::size_t{node[lane]}]; });
    u2[a] = Lanes([&](auto lane) { return x[2 * std::size_t{node[lane]} + 1]; });
  }
  Table d11; // d u_1 / d xi_1
  Table d12;
  Table d21;
  Table d22;
  differentiate(u1, d11, d12);
  differentiate(u2, d21, d22);

  const Number *moduli = moduli_.data() + b * 2 * lanes;
  const Lanes lambda(moduli, simd::element_aligned);
  const Lanes mu(moduli + lanes, simd::element_aligned);
  const Number *geometry = geometry_.data() + b * n_nodes * 4 * lanes;
  for (int q = 0; q < n_nodes; ++q, geometry += 4 * lanes) {
    const Lanes s11(geometry, simd::element_aligned);
    const Lanes s12(geometry + lanes, simd::element_aligned);
    const Lanes s21(geometry + 2 * lanes, simd::element_aligned);
    const Lanes s22(geometry + 3 * lanes, simd::element_aligned);
    const Lanes e11 = d11[q] * s11 + d12[q] * s21;
    const Lanes e22 = d21[q] * s12 + d22[q] * s22;
    const Lanes gamma = d11[q] * s12 + d12[q] * s22 + d21[q] * s11 + d22[q] * s21;
    const Lanes pressure = lambda * (e11 + e22);
    const Lanes t11 = pressure + 2 * mu * e11;
    const Lanes t22 = pressure + 2 * mu * e22;
    const Lanes t12 = mu * gamma;
    d11[q] = t11 * s11 + t12 * s12;
    d12[q] = t11 * s21 + t12 * s22;
    d21[q] = t12 * s11 + t22 * s12;
    d22[q] = t12 * s21 + t22 * s22;
  }

  integrate(d11, d12, u1);
  integrate(d21, d22, u2);
  for (int a = 0; a < n_nodes; ++a)
    add_to_node(part, batch, a, u1[a], u2[a], y);
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::apply(std::span<const Number> x, std::span<Number> y) const {
  for_each_part([&](const BatchPart &part) {
    std::fill(y.begin() + 2 * std::ptrdiff_t{part.band.begin}, y.begin() + 2 * std::ptrdiff_t{part.band.end},
              Number{0});
    for (const auto &batch : part.batches)
      add_batch(part, batch, x.data(), y.data());
  });
  for (const unsigned i : prescribed_)
    y[i] = 0;
}

template <typename Number, int n>
void CellwiseStiffness<Number, n>::add_diagonal(const BatchPart &part, const BatchPart::Batch &batch, Number *y) const {
  const std::size_t b = batch.number;
  const Number *moduli = moduli_.data() + b * 2 * lanes;
  const Lanes lambda(moduli, simd::element_aligned);
  const Lanes mu(moduli + lanes, simd::element_aligned);
  for (int a = 0; a < n_nodes; ++a) {
    Lanes sum_1 = 0;
    Lanes sum_2 = 0;
    for (int q = 0; q < n_nodes; ++q) {
      const Number *s = geometry_.data() + (b * n_nodes + q) * 4 * lanes;
      const Number along_1 = line_.slope[q % n][a % n] * line_.value[q / n][a / n];
      const Number along_2 = line_.value[q % n][a % n] * line_.slope[q / n][a / n];
      const Lanes g1 =
          along_1 * Lanes(s, simd::element_aligned) + along_2 * Lanes(s + 2 * lanes, simd::element_aligned);
      const Lanes g2 =
          along_1 * Lanes(s + lanes, simd::element_aligned) + along_2 * Lanes(s + 3 * lanes, simd::element_aligned);
      sum_1 += (lambda + 2 * mu) * g1 * g1 + mu * g2 * g2;
      sum_2 += (lambda + 2 * mu) * g2 * g2 + mu * g1 * g1;
    }
    add_to_node(part, batch, a, sum_1, sum_2, y);
  }
}

template <typename Number, int n>
std::vector<Number> CellwiseStiffness<Number, n>::diagonal() const {
  std::vector<Number> result(n_unknowns_);
  for_each_part([&](const BatchPart &part) {
    for (const auto &batch : part.batches)
      add_diagonal(part, batch, result.data());
  });
  for (const unsigned i : prescribed_)
    result[i] = 1;
  return result;
}
} // namespace

template <typename Number>
std::unique_ptr<StiffnessOperator<Number>> make_stiffness_operator(const Discretisation &space,
                                                                   std::span<const Material> materials,
                                                                   std::span<const char> prescribed, double scale) {
  switch (space.degree()) {
  case 1:
    return std::make_unique<CellwiseStiffness<Number, 2>>(space, materials, prescribed, scale);
  case 2:
    return std::make_unique<CellwiseStiffness<Number, 3>>(space, materials, prescribed, scale);
  case 3:
    return std::make_unique<CellwiseStiffness<Number, 4>>(space, materials, prescribed, scale);
  default:
    return std::make_unique<CellwiseStiffness<Number, 5>>(space, materials, prescribed, scale);
  }
}

template std::unique_ptr<StiffnessOperator<float>> make_stiffness_operator(const Discretisation &,
                                                                           std::span<const Material>,
                                                                           std::span<const char>, double);
template std::unique_ptr<StiffnessOperator<double>> make_stiffness_operator(const Discretisation &,
                                                                            std::span<const Material>,
                                                                            std::span<const char>, double);
} // namespace fem_reference::multigrid
