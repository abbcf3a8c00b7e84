#pragma once

#include "meshless/cloud_generation/generator.h"
#include "meshless/elasticity/plane_problem.h"
#include "unit/cloud/sample_clouds.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

/// Clouds of particles that are valid by construction, of a random domain, grading and jitter, and problems on them.
namespace random_clouds {

using namespace meshless;
using namespace meshless::elasticity;

/// x -> shift + scale R(angle) x.
struct Motion {
  double cosine = 1, sine = 0; ///< given apart, so that a quarter turn is exact
  double scale = 1;
  Point2 shift{0, 0};

  static Motion turn(double angle) { return {std::cos(angle), std::sin(angle), 1, {0, 0}}; }
  Vector2 rotate(const Vector2 &v) const { return {cosine * v[0] - sine * v[1], sine * v[0] + cosine * v[1]}; }
  Vector2 rotate_back(const Vector2 &v) const { return {cosine * v[0] + sine * v[1], cosine * v[1] - sine * v[0]}; }
  Point2 place(const Point2 &x) const {
    const auto r = rotate(x);
    return {shift[0] + scale * r[0], shift[1] + scale * r[1]};
  }
  Point2 place_back(const Point2 &y) const {
    return rotate_back({(y[0] - shift[0]) / scale, (y[1] - shift[1]) / scale});
  }
};

/// A field that no basis contains, with its gradient (u1,1 u1,2 u2,1 u2,2).
struct Waves {
  double a, b;

  Vector2 displacement(const Point2 &x) const {
    return {std::sin(a * x[0] + x[1]), std::cos(x[0] - b * x[1]) + .3 * x[0]};
  }
  std::array<double, 4> gradient(const Point2 &x) const {
    const double c = std::cos(a * x[0] + x[1]);
    const double s = -std::sin(x[0] - b * x[1]);
    return {a * c, c, s + .3, -b * s};
  }
  /// -div sigma.
  Vector2 body_force(const Point2 &x, const Material &d) const {
    const double s = std::sin(a * x[0] + x[1]);
    const double c = std::cos(x[0] - b * x[1]);
    // u1: 11, 12, 22 are -s (a^2, a, 1); u2: -c (1, -b, b^2).
    return {s * (d.axial() * a * a + d.shear()) - c * b * (d.coupling() + d.shear()),
            s * a * (d.coupling() + d.shear()) + c * (d.axial() * b * b + d.shear())};
  }
};

/// A rectangle or a star-shaped polygon, of which every other side has its displacement prescribed (of an odd number
/// two neighbours), so that no corner lies between two loaded sides: the choice that collocation makes there knows the
/// axes.
class RandomCloud {
public:
  explicit RandomCloud(std::uint64_t seed) : random_(seed), material_(make_material()) {
    waves_ = {random_.between(.5, 1.5), random_.between(.5, 1.5)};
    const bool is_rectangle = seed % 3 == 0;
    const int n = is_rectangle ? 4 : whole(5, 8);
    const double height = random_.between(.5, 1);
    for (int i = 0; i < n; ++i) {
      const double angle = 2 * std::numbers::pi * (i + random_.between(-.2, .2)) / n;
      const double radius = random_.between(.75, 1.1);
      corners_.push_back(is_rectangle ? Point2{i == 1 || i == 2 ? 1.5 : 0, i < 2 ? 0 : height}
                                      : Point2{radius * std::cos(angle), radius * std::sin(angle)});
    }
    const double grading = random_.between(0, 1.2);
    const Point2 fine = corners_[static_cast<std::size_t>(whole(0, n - 1))];
    const double jitter = random_() < .25 ? 0 : random_.between(0, .3);
    const auto count = static_cast<std::size_t>(whole(80, 130));
    auto cloud = cloud_generation::generate({{boundary()},
                                             [=](std::span<const Point2> points, std::span<double> spacing) {
                                               for (std::size_t i = 0; i < points.size(); ++i)
                                                 spacing[i] = 1 + grading * std::hypot(points[i][0] - fine[0],
                                                                                       points[i][1] - fine[1]);
                                             },
                                             seed,
                                             count,
                                             {}});
    points_ = std::move(cloud.positions);
    const std::vector<domain::Boundary> boundaries{boundary()};
    cloud_generation::jitter(boundaries, cloud.spacing, {}, jitter, seed, points_);
    lengths_ = cloud_generation::local_spacing(boundaries, points_);
    const double factor = random_.between(1, 1.25);
    for (double &h : lengths_)
      h *= factor;
    text_ = fmt::format("seed {}: {} corners, {} particles, grading {:.2f}, jitter {:.2f}, h = {:.2f} spacings", seed,
                        n, count, grading, jitter, factor);
  }

  const std::string &text() const { return text_; }
  const Material &material() const { return material_; }
  const Waves &waves() const { return waves_; }
  std::size_t size() const { return points_.size(); }

  domain::Boundary boundary(const Motion &motion = {}) const {
    std::vector<domain::BoundaryPiece> pieces;
    for (std::size_t i = 0; i < corners_.size(); ++i)
      pieces.push_back(
          {motion.place(corners_[i]), motion.place(corners_[(i + 1) % corners_.size()]), static_cast<int>(i % 2)});
    return domain::Boundary(std::move(pieces));
  }

  /// In the order of `numbers`; empty: as they are.
  cloud::Particles<2> particles(const Motion &motion = {}, std::vector<std::size_t> numbers = {}) const {
    if (numbers.empty())
      numbers = in_order();
    std::vector<Point2> points;
    std::vector<double> lengths, volumes;
    for (const auto i : numbers) {
      points.push_back(motion.place(points_[i]));
      lengths.push_back(motion.scale * lengths_[i]);
      volumes.push_back(lengths.back() * lengths.back());
    }
    return {std::move(points), std::move(lengths), std::move(volumes)};
  }

  std::vector<std::size_t> shuffled() {
    auto numbers = in_order();
    for (std::size_t i = numbers.size() - 1; i > 0; --i)
      std::swap(numbers[i], numbers[static_cast<std::size_t>(random_() * static_cast<double>(i + 1))]);
    return numbers;
  }

  /// Random points inside.
  std::vector<Point2> probes(std::size_t n) {
    const auto inside = boundary();
    std::vector<Point2> result;
    while (result.size() < n) {
      const Point2 x{random_.between(inside.lower()[0], inside.upper()[0]),
                     random_.between(inside.lower()[1], inside.upper()[1])};
      if (inside.contains(x))
        result.push_back(x);
    }
    return result;
  }

  /// The waves' displacement, tractions and body force, moved: u -> scale R u, with the same strain.
  PlaneProblem problem(const Motion &motion = {}) const {
    PlaneProblem result{{{boundary(motion), material_}}, {}, {}};
    const auto fixed = ConditionKind::displacement;
    result.conditions[0].kind = {fixed, fixed};
    result.conditions[0].displacement = [=, waves = waves_](std::span<const Point2> x, std::span<Vector2> u) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        u[i] = motion.rotate(waves.displacement(motion.place_back(x[i])));
        u[i] = {motion.scale * u[i][0], motion.scale * u[i][1]};
      }
    };
    result.conditions[1].traction = [=, waves = waves_, d = material_](std::span<const Point2> x,
                                                                       std::span<const Vector2> normals,
                                                                       std::span<Vector2> t) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        const auto g = waves.gradient(motion.place_back(x[i]));
        const auto n = motion.rotate_back(normals[i]);
        const double shear = d.shear() * (g[1] + g[2]);
        t[i] = motion.rotate({(d.axial() * g[0] + d.coupling() * g[3]) * n[0] + shear * n[1],
                              shear * n[0] + (d.coupling() * g[0] + d.axial() * g[3]) * n[1]});
      }
    };
    result.body_force = [=, waves = waves_, d = material_](std::span<const Point2> x, std::span<Vector2> b) {
      for (std::size_t i = 0; i < x.size(); ++i) {
        b[i] = motion.rotate(waves.body_force(motion.place_back(x[i]), d));
        b[i] = {b[i][0] / motion.scale, b[i][1] / motion.scale};
      }
    };
    return result;
  }

  int whole(int least, int most) { return least + static_cast<int>(random_() * (most - least + 1)); }
  sample_clouds::Uniform &random() { return random_; }

private:
  Material make_material() {
    return {std::pow(10, random_.between(-3, 12)), random_.between(0, .4),
            random_() < .5 ? PlaneModel::plane_stress : PlaneModel::plane_strain};
  }

  std::vector<std::size_t> in_order() const {
    std::vector<std::size_t> numbers(points_.size());
    for (std::size_t i = 0; i < numbers.size(); ++i)
      numbers[i] = i;
    return numbers;
  }

  sample_clouds::Uniform random_;
  Material material_;
  Waves waves_{};
  std::vector<Point2> corners_, points_;
  std::vector<double> lengths_;
  std::string text_;
};

} // namespace random_clouds
