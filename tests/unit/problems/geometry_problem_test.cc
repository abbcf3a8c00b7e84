// The problem of a geometry of one's own: levels, particles, quadrature, conditions and reference.

#include "comparisons/problems/geometry_problem.h"
#include "comparisons/scene/reader.h"
#include "comparisons/study/catalogue.h"
#include "meshless/domain/boundary.h"
#include "unit/geometry/meshes.h"

#include <cmath>
#include <numeric>

namespace {

using namespace geometry_tests;
using problems::GeometryProblem;
using problems::Point2;

const std::string method_and_levels =
    "[[method]]\nname = \"fem\"\n[study]\nlevels = [\"mesh\", \"mesh/2\", \"5 cm\", 200]\n";

const std::string square_scene = "schema = 1\n[geometry]\nfile = \"square.msh\"\n"
                                 "[material]\nE = 1\nnu = 0.25\nmodel = \"plane strain\"\n"
                                 "[[boundary]]\ngroup = \"left\"\nu1 = \"0.5*y\"\nu2 = 0\n"
                                 "[[boundary]]\ngroup = \"right\"\ntraction = [\"2*y\", \"3 Pa\"]\n"
                                 "[[boundary]]\ngroup = \"top\"\npressure = \"x\"\n";

struct Made {
  scene::Scene scene;
  std::unique_ptr<GeometryProblem> problem;
  scene::Level level(const std::string &text) const {
    for (const auto &level : scene.levels)
      if (level.text == text)
        return level;
    throw std::logic_error("no level " + text);
  }
};

/// @param n_solved counts the calls for a finer solution
Made make(const Folder &folder, const std::string &text, int *n_solved = nullptr) {
  const auto file = folder.write("scene.toml", text);
  auto read = scene::read_scene(file, {}, study::vocabulary_of(study::shipped_catalogue()));
  if (!read.scene)
    throw std::runtime_error(to_text(read.diagnostics));
  Made made{std::move(*read.scene), nullptr};
  made.problem = std::make_unique<GeometryProblem>(
      std::static_pointer_cast<const problems::ResolvedGeometry>(made.scene.resolved), *made.scene.geometry, 1,
      [n_solved](const problems::PlaneStatement &, const problems::Mesh &mesh, const std::string &element) {
        if (n_solved != nullptr)
          ++*n_solved;
        EXPECT_EQ(element, "Q3");
        EXPECT_EQ(mesh.cells.size() % 16, 0u);
        problems::ExactSolution solution;
        solution.displacement = [](std::span<const Point2>, std::span<problems::Vector2>) {};
        return solution;
      });
  return made;
}

TEST(GeometryProblem, levels_refine_the_mesh) {
  const Folder folder;
  folder.write("square.msh", square_2());
  const auto made = make(folder, square_scene + method_and_levels);
  EXPECT_EQ(made.problem->mesh(made.level("mesh")).cells.size(), 4u);
  EXPECT_EQ(made.problem->mesh(made.level("mesh/2")).cells.size(), 16u);
  // 4 x 4^k quadrilaterals of 2^-(k + 1): the first that are about as small as 5 cm.
  EXPECT_EQ(made.problem->mesh(made.level("0.05 m")).cells.size(), 1024u);
  EXPECT_EQ(made.problem->mesh(made.level("200")).cells.size(), 256u);
  for (const auto *level : {"mesh", "mesh/2", "0.05 m", "200"}) {
    const auto quadrature = made.problem->quadrature(made.level(level));
    EXPECT_GE(quadrature.points.size(), 400u * 16);
    EXPECT_NEAR(std::accumulate(quadrature.weights.begin(), quadrature.weights.end(), 0.0), 1,
                1e-12); // one-dimensional weights are good to 1e-13
    EXPECT_EQ(made.problem->cloud(made.level(level)).positions.size(),
              made.problem->mesh(made.level(level)).vertices.size());
  }
}

std::string findings(const Folder &folder, const std::string &text) {
  const auto file = folder.write("scene.toml", text);
  return to_text(scene::read_scene(file, {}, study::vocabulary_of(study::shipped_catalogue())).diagnostics);
}

TEST(GeometryProblem, particles_and_reference_come_from_files) {
  const Folder folder;
  folder.write("square.msh", square_2());
  folder.write("cloud.csv", "x,y\n0,0\n1,0\n1,1\n0,1\n.5,.5\n.5,1.001\n");
  folder.write("there.csv", "x,y,u1,u2\n.5,.5,1,2\n.25,.5,3,4\n");
  auto scene = square_scene + "[reference]\nfile = \"there.csv\"\n" + method_and_levels;
  const std::string own = "file = \"square.msh\"\ncloud = \"file\"\ncloud_file = \"cloud.csv\"\n";
  scene.replace(scene.find("file = \"square.msh\"\n"), 20, own);
  const auto made = make(folder, scene);
  const auto cloud = made.problem->cloud(made.level("mesh"));
  ASSERT_EQ(cloud.positions.size(), 6u);
  EXPECT_NEAR(cloud.spacing[0], (2 + std::sqrt(.5) + std::hypot(.5, 1.001)) / 4, 1e-15);
  EXPECT_NEAR(cloud.positions[5][1], 1, 1e-15); // moved onto the edge
  EXPECT_FALSE(cloud.regular);
  const auto &exact = made.problem->exact();
  ASSERT_NE(exact.only_at, nullptr);
  EXPECT_NEAR(exact.only_at->weights[0], .5, 1e-14);
  std::vector<problems::Vector2> u(2);
  exact.displacement(exact.only_at->points, u);
  EXPECT_EQ(u[1], (problems::Vector2{3, 4}));
}

TEST(GeometryProblem, files_must_fit_the_geometry) {
  const Folder folder;
  folder.write("square.msh", square_2());
  folder.write("outside.csv", "x,y,h\n0,0,1\n2,0,1\n");
  folder.write("there.csv", "x,y,u1,u2\n.5,.5,1,2\n.5,-3,3,4\n");
  const auto scene = [&](const std::string &geometry, const std::string &reference) {
    auto text = square_scene + reference + method_and_levels;
    return text.replace(text.find("file = \"square.msh\"\n"), 20, "file = \"square.msh\"\n" + geometry);
  };
  const auto holds = [&](const std::string &text, const std::string &part) {
    EXPECT_NE(findings(folder, text).find(part), std::string::npos) << findings(folder, text);
  };
  holds(scene("cloud = \"file\"\ncloud_file = \"outside.csv\"\n", ""), "(2, 0) is outside of the domain");
  holds(scene("cloud = \"file\"\n", ""), "needs the name of the file");
  holds(scene("cloud_file = \"outside.csv\"\n", ""), "a file of particles is given, but cloud is 'nodes'");
  holds(scene("cloud = \"file\"\ncloud_file = \"none.csv\"\n", ""), "cannot be read");
  holds(scene("", "[reference]\nfile = \"there.csv\"\n"), "there.csv:3:1: the point (0.5, -3) is outside");
  holds(scene("", "[reference]\nsolution = \"file\"\n"), "the solution 'file' needs file");
  holds(scene("", "[reference]\nsolution = \"finer fem\"\nfile = \"there.csv\"\n"), "a file is given, but");
}

TEST(GeometryProblem, conditions_are_expressions_and_quantities) {
  const Folder folder;
  folder.write("square.msh", square_2());
  const auto made = make(folder, square_scene + method_and_levels);
  const auto &statement = made.problem->statement();
  ASSERT_EQ(statement.conditions.size(), 4u);
  const Point2 point{0.25, 0.5};
  const problems::Vector2 normal{0.6, 0.8};
  problems::Vector2 value{};
  const auto &left = statement.conditions.at(0);
  EXPECT_TRUE(left.displacement_prescribed[0] && left.displacement_prescribed[1]);
  left.displacement({&point, 1}, {&value, 1});
  EXPECT_EQ(value, (problems::Vector2{0.25, 0}));
  statement.conditions.at(1).traction({&point, 1}, {&normal, 1}, {&value, 1});
  EXPECT_EQ(value, (problems::Vector2{1, 3}));
  statement.conditions.at(3).traction({&point, 1}, {&normal, 1}, {&value, 1});
  EXPECT_DOUBLE_EQ(value[0], -0.25 * 0.6);
  EXPECT_DOUBLE_EQ(value[1], -0.25 * 0.8);
  EXPECT_FALSE(statement.conditions.at(2).traction); // bottom: free
  EXPECT_TRUE(statement.regions.front().material.plane_strain);
  EXPECT_DOUBLE_EQ(statement.characteristic_length, 1);
}

TEST(GeometryProblem, the_reference_is_computed_once_unless_it_is_given) {
  const Folder folder;
  folder.write("square.msh", square_2());
  int n_solved = 0;
  const auto computed = make(folder, square_scene + method_and_levels, &n_solved);
  EXPECT_TRUE(computed.problem->exact().displacement);
  EXPECT_TRUE(computed.problem->exact().displacement);
  EXPECT_EQ(n_solved, 1);
  EXPECT_EQ(computed.problem->remarks().size(), 1u);
  const auto given = make(folder,
                          square_scene + "[reference]\nu1 = \"x\"\nu2 = \"y*y\"\ns11 = 1\ns22 = \"x+y\"\ns12 = 0\n" +
                              method_and_levels,
                          &n_solved);
  problems::Stress2 stress{};
  const Point2 point{0.25, 0.5};
  given.problem->exact().stress({&point, 1}, {&stress, 1});
  EXPECT_EQ(stress, (problems::Stress2{1, 0.75, 0}));
  EXPECT_EQ(n_solved, 1);
  EXPECT_TRUE(given.problem->remarks().empty());
}

std::string ellipse_scene(const std::string &cloud) {
  return "schema = 1\n[geometry]\nfile = \"ellipse.geo\"\ncloud = \"" + cloud +
         "\"\n[material]\nE = 1\nnu = 0.25\nmodel = \"plane strain\"\n"
         "[[boundary]]\ngroup = \"axes\"\nu1 = 0\nu2 = 0\n"
         "[[boundary]]\ngroup = \"ellipse\"\npressure = 1\n"
         "[[method]]\nname = \"fem\"\n[study]\nlevels = [\"30 cm\", \"mesh/2\", 300]\n";
}

/// Particles on the boundary are on the statement's own pieces at every level, although the drawing is meshed anew.
TEST(GeometryProblem, particles_are_on_the_boundary_to_rounding) {
  const Folder folder;
  folder.write(
      "ellipse.geo",
      "Point(1) = {0, 0, 0, .4}; Point(2) = {2, 0, 0, .4}; Point(3) = {0, 1, 0, .4};\n"
      "Line(1) = {1, 2}; Ellipse(2) = {2, 1, 2, 3}; Line(3) = {3, 1};\n"
      "Curve Loop(1) = {1, 2, 3}; Plane Surface(1) = {1};\n"
      "Physical Curve(\"ellipse\") = {2}; Physical Curve(\"axes\") = {1, 3}; Physical Surface(\"s\") = {1};\n");
  for (const auto *kind : {"nodes", "generated"}) {
    const auto made = make(folder, ellipse_scene(kind));
    std::vector<meshless::domain::BoundaryPiece> pieces;
    for (const auto &piece : made.problem->statement().regions.front().boundary) {
      pieces.push_back({piece.begin, piece.end, piece.id});
      if (piece.arc)
        pieces.back().arc = {piece.arc->centre, piece.arc->counter_clockwise};
    }
    const meshless::domain::Boundary boundary(std::move(pieces));
    for (const auto *level : {"0.3 m", "mesh/2", "300"}) {
      SCOPED_TRACE(std::string(kind) + " " + level);
      const auto cloud = made.problem->cloud(made.level(level));
      const auto mesh = made.problem->mesh(made.level(level));
      EXPECT_EQ(cloud.positions.size(), mesh.vertices.size());
      EXPECT_EQ(cloud.spacing.size(), cloud.positions.size());
      std::size_t n_on_boundary = 0;
      for (std::size_t i = 0; i < cloud.positions.size(); ++i) {
        const auto &p = cloud.positions[i];
        const double distance = boundary.distance(p);
        if (distance < boundary.tolerance())
          ++n_on_boundary;
        else {
          // Inside, and well away from the boundary: none is nearly on it.
          EXPECT_TRUE(boundary.contains(p)) << p[0] << ", " << p[1];
          EXPECT_GT(distance, 0.1 * cloud.spacing[i]) << p[0] << ", " << p[1];
        }
      }
      if (std::string(kind) == "nodes") {
        EXPECT_EQ(n_on_boundary, mesh.boundary.size()); // one loop: as many vertices as edges
      }
    }
  }
}

TEST(GeometryProblem, particles_of_an_interface_stand_once_for_each_region) {
  const Folder folder;
  std::string text = square_2();
  for (const auto &[from, to] : {std::pair{"$PhysicalNames\n5", "$PhysicalNames\n6"},
                                 {"2 5 \"plate\"\n", "2 5 \"lower\"\n2 6 \"upper\"\n"},
                                 {"11 3 2 5 1", "11 3 2 6 2"},
                                 {"12 3 2 5 1", "12 3 2 6 2"}})
    text = replaced(text, from, to);
  folder.write("square.msh", text);
  const auto made = make(folder, replaced(square_scene, "[material]\n",
                                          "[[material]]\nregion = \"upper\"\nE = 5\nnu = 0\n"
                                          "model = \"plane strain\"\n[[material]]\n"
                                          "region = \"lower\"\n") +
                                     method_and_levels);
  const auto cloud = made.problem->cloud(made.level("mesh"));
  EXPECT_EQ(cloud.positions.size(), 12u); // nine, and the three of the interface again
  std::size_t n_upper = 0;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
    if (cloud.regions.at(i) == 0) {
      ++n_upper;
      EXPECT_GE(cloud.positions[i][1], 0.5);
    }
  EXPECT_EQ(n_upper, 6u);
  EXPECT_EQ(made.problem->statement().regions[0].material.youngs_modulus, 5);
  EXPECT_EQ(made.problem->quadrature(made.level("mesh")).regions.size(),
            made.problem->quadrature(made.level("mesh")).points.size());
}

} // namespace
