#include "ritz.h"

#include <algorithm>
#include <array>
#include <utility>

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/lapack_full_matrix.h>
#include <deal.II/lac/vector.h>

namespace fem_test {
namespace {
/// Legendre polynomials and their slopes at t in [-1, 1].
std::pair<std::vector<double>, std::vector<double>> legendre(int n, double t) {
  std::vector<double> p{1, t}, d{0, 1};
  for (int k = 1; k + 1 < n; ++k) {
    p.push_back(((2 * k + 1) * t * p[k] - k * p[k - 1]) / (k + 1));
    d.push_back(d[k - 1] + (2 * k + 1) * p[k]);
  }
  return {p, d};
}
} // namespace

std::vector<double> ritz_squares(int n, bool clamped, double lambda, double mu, double density) {
  const int n_functions = n * n;
  dealii::LAPACKFullMatrix<double> k(2 * n_functions, 2 * n_functions), m(2 * n_functions, 2 * n_functions);
  const dealii::QGauss<1> rule(static_cast<unsigned>(n + 4));
  const double half[] = {1, .5};
  std::vector<std::array<double, 3>> f(n_functions); // value and slopes
  for (unsigned qs = 0; qs < rule.size(); ++qs)
    for (unsigned qt = 0; qt < rule.size(); ++qt) {
      const double s = 2 * rule.point(qs)[0] - 1;
      const double t = 2 * rule.point(qt)[0] - 1;
      const double jxw = 4 * half[0] * half[1] * rule.weight(qs) * rule.weight(qt);
      const auto one = [&](double x) {
        auto [p, d] = legendre(n, x);
        for (int i = 0; clamped && i < n; ++i) {
          d[i] = d[i] * (1 - x * x) - 2 * x * p[i];
          p[i] *= 1 - x * x;
        }
        return std::pair(p, d);
      };
      const auto [ps, ds] = one(s);
      const auto [pt, dt] = one(t);
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j)
          f[i * n + j] = {ps[i] * pt[j], ds[i] * pt[j] / half[0], ps[i] * dt[j] / half[1]};
      for (int a = 0; a < n_functions; ++a)
        for (int b = 0; b < n_functions; ++b) {
          const auto &[fa, ax, ay] = f[a];
          const auto &[fb, bx, by] = f[b];
          const double grad = ax * bx + ay * by;
          k(2 * a, 2 * b) += jxw * ((lambda + mu) * ax * bx + mu * grad);
          k(2 * a + 1, 2 * b + 1) += jxw * ((lambda + mu) * ay * by + mu * grad);
          k(2 * a, 2 * b + 1) += jxw * (lambda * ax * by + mu * ay * bx);
          k(2 * a + 1, 2 * b) += jxw * (lambda * ay * bx + mu * ax * by);
          m(2 * a, 2 * b) += jxw * density * fa * fb;
          m(2 * a + 1, 2 * b + 1) += jxw * density * fa * fb;
        }
    }
  k.set_property(dealii::LAPACKSupport::symmetric);
  m.set_property(dealii::LAPACKSupport::symmetric);
  std::vector<dealii::Vector<double>> none;
  k.compute_generalized_eigenvalues_symmetric(m, none);
  std::vector<double> squares;
  for (int i = 0; i < 2 * n_functions; ++i)
    squares.push_back(k.eigenvalue(static_cast<unsigned>(i)).real());
  std::sort(squares.begin(), squares.end());
  return squares;
}
} // namespace fem_test
