#include "meshless/basis/cspm.h"

#include "meshless/basis/monomials.h"
#include "pointwise_basis.h"

#include <stdexcept>

namespace meshless::basis {

namespace {

template <int dim>
class Cspm final : public PointwiseBasis<dim> {
  using Terms = Monomials<dim, 2>;
  static constexpr std::size_t n_hessian = dim * (dim + 1) / 2;

public:
  using PointwiseBasis<dim>::PointwiseBasis;
  using typename PointwiseBasis<dim>::Place;

  int order() const override { return 2; }
  std::size_t n_terms() const override { return dim + 1; }
  int reproduced_degree(int derivative) const override { return derivative == 0 ? 0 : 1; }

private:
  void check_wanted(const Wanted &wanted) const override {
    if (wanted.differentiated_gradient)
      throw std::invalid_argument("cspm does not differentiate its shape functions; choose direct derivatives");
    if (wanted.hessian && dim > 1 && std::holds_alternative<kernels::Linear>(this->kernel()))
      throw std::invalid_argument("cspm projects on the second derivatives of the kernel, which linear has not");
  }

  double evaluate_point(const Place &place) const override {
    if (place.wanted.value)
      write_value(place);
    if (!place.wanted.gradient && !place.wanted.hessian)
      return 1;
    const std::size_t n = place.size();
    auto &numbers = place.workspace.numbers;
    numbers.resize((dim + 1) * n);
    const auto row = [&](int k) { return std::span(numbers).subspan(static_cast<std::size_t>(k) * n, n); };
    const double first_ratio = find_gradient(place, row);
    if (!(first_ratio > 0))
      return 0;
    double ratio = first_ratio;
    if (place.wanted.hessian)
      ratio = std::min(ratio, write_hessian(place, row));
    for (int k = 0; k < dim && place.wanted.gradient; ++k) {
      for (double &shape : row(k))
        shape /= place.scale;
      place.write(1 + k, row(k));
    }
    return ratio;
  }

  /// Normalised estimate, exact for constants.
  static void write_value(const Place &place) {
    double sum = 0;
    for (const auto &neighbour : place.neighbours.all)
      sum += neighbour.weight;
    for (const auto &neighbour : place.neighbours.all)
      place.values.row(0, neighbour.candidate)[place.point] = neighbour.weight / sum;
  }

  /// Terms of degree 1 and 2 less those of the particle next to the point.
  static std::array<double, Terms::size> differences(const Place &place, const PointNeighbour<dim> &neighbour) {
    std::array<double, Terms::size> terms;
    std::array<double, Terms::size> own;
    Terms::evaluate(neighbour.offset, terms);
    Terms::evaluate(place.nearest().offset, own);
    for (std::size_t t = 0; t < Terms::size; ++t)
      terms[t] -= own[t];
    return terms;
  }

  /// First derivatives in units of the scale.
  template <typename Rows>
  static double find_gradient(const Place &place, const Rows &row) {
    auto &projection = place.workspace.projections[0];
    projection.resize(dim, place.size());
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      const auto terms = differences(place, neighbour);
      for (std::size_t k = 0; k < dim; ++k) {
        projection.tests(j)[k] = neighbour.gradient[k];
        projection.terms(j)[k] = terms[1 + k];
      }
    }
    const double ratio = projection.factorise();
    for (int k = 0; k < dim && ratio > 0; ++k) {
      projection.shape_functions(static_cast<std::size_t>(k), 1, row(k));
      subtract_own(place, row(k));
    }
    return ratio;
  }

  /// sum_J shape_J (f_J - f_i) instead of sum_J shape_J f_J.
  static void subtract_own(const Place &place, std::span<double> shape) {
    double sum = 0;
    for (const double number : shape)
      sum += number;
    shape[place.neighbours.nearest] -= sum;
  }

  template <typename Rows>
  static double write_hessian(const Place &place, const Rows &row) {
    auto &projection = place.workspace.projections[1];
    projection.resize(n_hessian, place.size());
    for (std::size_t j = 0; j < place.size(); ++j) {
      const auto &neighbour = place.neighbours.all[j];
      const auto terms = differences(place, neighbour);
      for (std::size_t t = 0; t < n_hessian; ++t) {
        projection.tests(j)[t] = dim == 1 ? neighbour.weight : neighbour.hessian[t];
        projection.terms(j)[t] = terms[1 + dim + t];
      }
    }
    const double ratio = projection.factorise();
    if (!(ratio > 0))
      return 0;
    const double unit = 1 / (place.scale * place.scale);
    int kl = 0;
    for (int k = 0; k < dim; ++k)
      for (int l = k; l < dim; ++l, ++kl) {
        const auto shape = row(dim);
        const double factor = (k == l ? 2 : 1) * unit;
        projection.shape_functions(static_cast<std::size_t>(kl), factor, shape);
        std::array<double, dim> linear{}; // what the test functions make of the first derivatives
        for (std::size_t j = 0; j < place.size(); ++j) {
          const auto terms = differences(place, place.neighbours.all[j]);
          for (int i = 0; i < dim; ++i)
            linear[i] += shape[j] * terms[1 + static_cast<std::size_t>(i)];
        }
        subtract_own(place, shape);
        for (int i = 0; i < dim; ++i)
          for (std::size_t j = 0; j < place.size(); ++j)
            shape[j] -= linear[i] * row(i)[j];
        place.write(1 + dim + kl, shape);
      }
    return ratio;
  }
};

} // namespace

template <int dim>
std::unique_ptr<ShapeFunctions<dim>> make_cspm(const kernels::Kernel &kernel, const BasisOptions &options) {
  return std::make_unique<Cspm<dim>>(kernel, options.edge);
}

template std::unique_ptr<ShapeFunctions<1>> make_cspm<1>(const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<2>> make_cspm<2>(const kernels::Kernel &, const BasisOptions &);
template std::unique_ptr<ShapeFunctions<3>> make_cspm<3>(const kernels::Kernel &, const BasisOptions &);

} // namespace meshless::basis
