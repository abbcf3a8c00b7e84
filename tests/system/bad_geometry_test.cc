// Every bad input about a geometry of one's own that the documentation lists: exit code 3 before any computing, what
// was found and where, what is allowed, a suggestion, and nothing written.

#include "system/program_here.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace {

using namespace system_tests;

/// The unit square in two by two quadrilaterals.
const std::string square =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n"
    "$PhysicalNames\n5\n1 1 \"left\"\n1 2 \"right\"\n1 3 \"bottom\"\n1 4 \"top\"\n2 5 \"plate\"\n$EndPhysicalNames\n"
    "$Nodes\n9\n1 0 0 0\n2 .5 0 0\n3 1 0 0\n4 0 .5 0\n5 .5 .5 0\n6 1 .5 0\n7 0 1 0\n8 .5 1 0\n9 1 1 0\n$EndNodes\n"
    "$Elements\n12\n1 1 2 1 1 1 4\n2 1 2 1 1 4 7\n3 1 2 2 2 3 6\n4 1 2 2 2 6 9\n5 1 2 3 3 1 2\n6 1 2 3 3 2 3\n"
    "7 1 2 4 4 7 8\n8 1 2 4 4 8 9\n9 3 2 5 1 1 2 5 4\n10 3 2 5 1 2 3 6 5\n11 3 2 5 1 4 5 8 7\n12 3 2 5 1 5 6 9 8\n"
    "$EndElements\n";

const std::string scene = "schema = 1\n"
                          "[geometry]\n"
                          "file = \"square.msh\"\n"
                          "[material]\n"
                          "E = \"1 GPa\"\n"
                          "nu = 0.3\n"
                          "model = \"plane stress\"\n"
                          "[[boundary]]\n"
                          "group = \"left\"\n"
                          "u1 = 0\n"
                          "u2 = 0\n"
                          "[[boundary]]\n"
                          "group = \"right\"\n"
                          "traction = [\"1 MPa\", \"1e6*y*(1-y)\"]\n"
                          "[[boundary]]\n"
                          "group = \"top\"\n"
                          "[[boundary]]\n"
                          "group = \"bottom\"\n"
                          "pressure = 0\n"
                          "[[quantity]]\n"
                          "name = \"tip\"\n"
                          "kind = \"displacement\"\n"
                          "component = \"2\"\n"
                          "point = [1, 0.5]\n"
                          "[[method]]\n"
                          "name = \"fem\"\n"
                          "[study]\n"
                          "levels = [\"mesh\"]\n";

std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const auto place = text.find(from);
  if (place == std::string::npos)
    throw std::logic_error("'" + from + "' is not in the text");
  return text.replace(place, from.size(), to);
}

Ended run_with(const std::string &mesh, const std::string &text, const std::string &command = "run") {
  const Folder folder;
  folder.write("square.msh", mesh);
  folder.write("scene.toml", text);
  std::vector<std::string> arguments{command, "scene.toml"};
  if (command == "run")
    arguments.insert(arguments.end(), {"--output", "out"});
  auto answer = run_here(arguments, folder.path());
  if (answer.exit_code == 3) {
    EXPECT_EQ(answer.out, "");
    EXPECT_FALSE(fs::exists(folder / "out"));
  }
  return answer;
}

void expect_refused(const std::string &mesh, const std::string &text, const std::vector<std::string> &words) {
  const auto answer = run_with(mesh, text);
  EXPECT_EQ(answer.exit_code, 3) << words.front();
  for (const auto &word : words)
    EXPECT_NE(answer.err.find(word), std::string::npos) << "'" << word << "' is not in\n" << answer.err;
}

TEST(BadGeometry, the_good_scene_runs) {
  const auto answer = run_with(square, scene);
  EXPECT_EQ(answer.exit_code, 0) << answer.err;
  EXPECT_NE(answer.err.find("scene.toml:15:1: warning: boundary[2]: the boundary 'top' has no condition"),
            std::string::npos)
      << answer.err;
  EXPECT_NE(answer.out.find("tip"), std::string::npos) << answer.out;
}

TEST(BadGeometry, files_that_are_no_meshes) {
  const auto file = [](const std::string &name) { return replaced(scene, "square.msh", name); };
  expect_refused(square, file("absent.msh"), {"absent.msh: error: there is no such file"});
  expect_refused("", scene, {"square.msh: error: the file is empty"});
  expect_refused(square.substr(0, square.find("8 1 2 4")), scene, {"square.msh:", "ends after 7 of 12 elements"});
  expect_refused(replaced(square, "$Nodes\n9", "$Nodes\n900000000"), scene,
                 {"square.msh:13:1: error: a count of 900000000 nodes is larger than the file can hold"});
  expect_refused("Once upon a time\n", scene, {"square.msh:1:1: error: no Gmsh mesh", "'Once upon a time'"});
}

TEST(BadGeometry, meshes_that_are_no_plane_domains) {
  std::string ungrouped = square;
  for (const auto &[from, to] : {std::pair{" 2 1 1 ", " 2 0 1 "},
                                 {" 2 2 2 ", " 2 0 2 "},
                                 {" 2 3 3 ", " 2 0 3 "},
                                 {" 2 4 4 ", " 2 0 4 "},
                                 {" 2 5 1 ", " 2 0 1 "}})
    while (ungrouped.find(from) != std::string::npos)
      ungrouped = replaced(ungrouped, from, to);
  const auto begin = ungrouped.find("$PhysicalNames");
  ungrouped.erase(begin, ungrouped.find("$Nodes") - begin);
  expect_refused(ungrouped, scene, {"square.msh: error: the mesh has no physical groups", "Physical Curve"});
  expect_refused(replaced(square, "1 5 6 9 8", "1 8 9 6 5"), scene, {"inverted cells", "cell 12 at (0.75, 0.75)"});
  expect_refused(replaced(square, "12 3 2 5 1 5 6 9 8", "12 2 2 5 1 4 5 6"), scene,
                 {"degenerate cells without area: cell 12 at (0.5, 0.5)"});
  expect_refused(replaced(replaced(replaced(square, "$Nodes\n9", "$Nodes\n10"), "9 1 1 0\n", "9 1 1 0\n10 .5 .5 0\n"),
                          "1 5 6 9 8", "1 10 6 9 8"),
                 scene, {"duplicate nodes: nodes 5 and 10 at (0.5, 0.5)", "Coherence"});
  expect_refused(replaced(square, "9 1 1 0", "9 1 1 .5"), scene, {"a 3D mesh: z runs from 0 to 0.5 m"});
  expect_refused(replaced(square, "12 3 2 5 1 5 6 9 8", "12 4 2 5 1 5 6 9 8"), scene,
                 {"a 3D mesh: element 12 is a tetrahedron"});
}

TEST(BadGeometry, names_that_the_mesh_lacks) {
  expect_refused(
      square, replaced(scene, "group = \"left\"", "group = \"lefft\""),
      {"scene.toml:9:9: error: boundary[0].group: the mesh has no physical curve 'lefft'; it has left, right, "
       "bottom, top",
       "did you mean 'left'?"});
  expect_refused(square, replaced(scene, "[material]\n", "[material]\nregion = \"plat\"\n"),
                 {"scene.toml:5:10: error: material.region: the mesh has no physical surface 'plat'; it has plate",
                  "did you mean 'plate'?"});
  expect_refused(square, replaced(scene, "group = \"left\"", "group = \"plate\""), {"(but a surface of that name)"});
}

TEST(BadGeometry, rigid_motions_that_remain) {
  const std::string free = replaced(scene, "u1 = 0\nu2 = 0\n", "traction = [0, 0]\n");
  expect_refused(square, free,
                 {"the conditions leave rigid motions of the domain: translation along 1 (x), translation "
                  "along 2 (y), rotation"});
  // A clamp of u1 alone on the left side: the plate may slide along it.
  expect_refused(square, replaced(scene, "u2 = 0\n", ""), {"rigid motions of the domain: translation along 2 (y) ("});
  // On top and bottom u2 alone: it slides along x.
  expect_refused(square, replaced(replaced(scene, "u1 = 0\nu2 = 0\n", ""), "pressure = 0", "u2 = 0"),
                 {"rigid motions of the domain: translation along 1 (x) ("});
  // Two groups each with the component along its normal leave nothing.
  const auto good = run_with(square, replaced(replaced(scene, "u2 = 0\n", ""), "pressure = 0", "u2 = 0"));
  EXPECT_EQ(good.exit_code, 0) << good.err;
}

TEST(BadGeometry, a_body_that_nothing_loads) {
  // Ended as "displacement_l2_relative is not finite" in every cell.
  for (const auto *traction : {"", "traction = [0, 0]\n", "traction = [\"0 Pa\", \"0\"]\n"}) {
    const auto ended = run_with(square, replaced(scene, "traction = [\"1 MPa\", \"1e6*y*(1-y)\"]\n", traction));
    EXPECT_EQ(ended.exit_code, 3) << traction;
    EXPECT_NE(ended.err.find("nothing loads the body"), std::string::npos) << ended.err;
  }
}

TEST(BadGeometry, conditions_that_disagree) {
  const std::string bottom = replaced(scene, "pressure = 0", "u1 = \"0.001 + 0.002*x\"");
  expect_refused(square, bottom, {"error: boundary[3].u1: 'left' and 'bottom' meet at (0, 0)", "u1 = 0 and 0.001 m"});
  const auto good = run_with(square, replaced(scene, "pressure = 0", "u1 = \"0.002*x\""));
  EXPECT_EQ(good.exit_code, 0) << good.err;
  expect_refused(square, replaced(scene, "pressure = 0", "pressure = 0\ntraction = [0, 0]"),
                 {"both a traction and a pressure are given"});
  expect_refused(square, replaced(scene, "u2 = 0\n", "u2 = 0\npressure = 1\n"), {"both displacements are given"});
  expect_refused(square, replaced(scene, "group = \"top\"", "group = \"left\"\nu1 = 0"),
                 {"the group 'left' has two conditions"});
}

TEST(BadGeometry, expressions_with_errors) {
  expect_refused(square, replaced(scene, "1e6*y*(1-y)", "1e6*z"),
                 {"scene.toml:14:22: error: boundary[1].traction", "z"});
  expect_refused(square, replaced(scene, "1e6*y*(1-y)", "1/(1-x)"),
                 {"error: boundary[1]: '1/(1-x)' is not finite at (1"});
  expect_refused(square, replaced(scene, "\"1 MPa\"", "\"1 mm\""),
                 {"'1 mm' is a length [m]; expected a pressure [Pa]"});
  expect_refused(square, replaced(scene, "\"1 MPa\"", "\"1 MPaa\""), {"boundary[1].traction", "MPaa"});
}

TEST(BadGeometry, tables_and_levels) {
  expect_refused(square, replaced(scene, "[\"mesh\"]", "[\"mesh/3\"]"), {"'mesh/3' is no level", "\"mesh/2\""});
  expect_refused(square, replaced(scene, "[\"mesh\"]", "[\"1 um\"]"), {"study.levels: the level 1e-06 m has about"});
  expect_refused(square, replaced(scene, "[\"mesh\"]", "[\"16x4\"]"), {"a level of 2 counts"});
  expect_refused(square, replaced(scene, "schema = 1\n", "schema = 1\nbenchmark = \"cantilever\"\n"),
                 {"a scene has a benchmark or a [geometry], not both"});
  expect_refused(square, replaced(scene, "file = ", "fil = "),
                 {"unknown key 'fil' in [geometry]", "did you mean 'file'?", "the required key 'file' is missing"});
  expect_refused(square, replaced(scene, "point = [1, 0.5]", "point = [1, 1.5]"),
                 {"quantity[0].point: the point (1, 1.5) is outside of the domain, by 0.5 m"});
  expect_refused(square, replaced(scene, "component = \"2\"", "component = \"22\""),
                 {"displacement has no component '22'; allowed: 1, 2, magnitude"});
  expect_refused(square, replaced(scene, "file = \"square.msh\"", "file = \"square.msh\"\nsize = \"1 m\""),
                 {"scene.toml:4:8: error: geometry.size", "a mesh (.msh) is taken as it is"});
}

/// The errors of a scene and those of its mesh are told in one pass.
TEST(BadGeometry, one_pass) {
  const std::string text = replaced(replaced(scene, "name = \"fem\"", "name = \"fem\"\nelment = \"Q2\""),
                                    "group = \"left\"", "group = \"lft\"");
  expect_refused(square, text, {"did you mean 'element'?", "the mesh has no physical curve 'lft'"});
}

TEST(BadGeometry, explain_and_check_validate_too) {
  for (const auto *command : {"check", "explain"}) {
    const auto bad = run_with(square, replaced(scene, "group = \"left\"", "group = \"lefft\""), command);
    EXPECT_EQ(bad.exit_code, 3);
    const auto good = run_with(square, scene, command);
    EXPECT_EQ(good.exit_code, 0) << good.err;
  }
  const auto explained = run_with(square, scene, "explain");
  for (const auto *word : {"Geometry square.msh: 4 cells of first order, 1 m^2", "left", "u1 = 0, u2 = 0",
                           "traction = 1000000; 1e6*y*(1-y)", "the whole domain", "E = 1 GPa", "effects called for",
                           "unknowns", "Estimated time"})
    EXPECT_NE(explained.out.find(word), std::string::npos) << "'" << word << "' is not in\n" << explained.out;
}

} // namespace
