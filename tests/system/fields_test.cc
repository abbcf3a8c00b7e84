// Fields for ParaView and figures by gnuplot, from a run and rebuilt from its results. The fields are read back by VTK
// itself, through the viewer f3d (counts, names, ranges), and by meshio (every value).

#include "comparisons/reports/gnuplot.h"
#include "comparisons/reports/json.h"
#include "system/program_here.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <sstream>

namespace {

using namespace system_tests;
using namespace comparisons;

const std::string scene = "schema = 1\ntitle = \"Fields\"\nbenchmark = \"cantilever\"\n[[method]]\nname = \"strong\"\n"
                          "[[method]]\nname = \"fem\"\nelement = \"Q2\"\n[study]\nlevels = [\"16x4\", \"31x7\"]\n"
                          "repeats = 1\n";

/// What meshio read: counts, and values by name.
struct ReadBack {
  std::string info;
  std::size_t n_points = 0;
  std::map<std::string, std::vector<double>> values;
};

ReadBack read_back(const fs::path &vtu, const Folder &folder) {
  ReadBack read;
  read.info = Process({"info", vtu.string()}, folder.path(), "/usr/bin/meshio").wait().out;
  const auto ended = Process({"convert", "--ascii", vtu.string(), "back.vtk"}, folder.path(), "/usr/bin/meshio").wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.out << ended.err;
  std::istringstream stream(contents(folder / "back.vtk"));
  std::string line;
  while (std::getline(stream, line) && !line.starts_with("FIELD FieldData"))
    if (line.starts_with("POINT_DATA "))
      read.n_points = std::stoul(line.substr(11));
  while (std::getline(stream, line)) {
    std::istringstream head(line);
    std::string name;
    std::size_t n_components = 0, n = 0;
    if (!(head >> name >> n_components >> n))
      break;
    auto &values = read.values[name];
    values.resize(n_components * n);
    for (double &value : values)
      stream >> value;
    std::getline(stream, line);
  }
  return read;
}

/// What VTK read: counts, and by name the range of each component.
struct ReadByVtk {
  std::size_t n_points = 0, n_cells = 0;
  std::map<std::string, std::vector<std::pair<double, double>>> ranges;
};

ReadByVtk read_by_vtk(const fs::path &vtu, const Folder &folder) {
  const auto ended =
      Process({"--dry-run", "--verbose", "--no-render", vtu.string()}, folder.path(), "/usr/bin/f3d").wait();
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_EQ(ended.err.find("error"), std::string::npos) << ended.err;
  ReadByVtk read;
  std::istringstream stream(ended.out);
  std::string line;
  while (std::getline(stream, line)) {
    std::sscanf(line.c_str(), "Number of points: %zu", &read.n_points);
    std::sscanf(line.c_str(), "Number of cells: %zu", &read.n_cells);
    // "  stress : double : [-1, 1] [-2, 2] [-3, 3]"
    const auto colon = line.find(" : double : ");
    if (!line.starts_with("  ") || colon == std::string::npos)
      continue;
    auto &ranges = read.ranges[line.substr(2, colon - 2)];
    double from = 0, to = 0;
    for (auto open = line.find('[', colon); open != std::string::npos; open = line.find('[', open + 1))
      if (std::sscanf(line.c_str() + open, "[%lf, %lf]", &from, &to) == 2)
        ranges.emplace_back(from, to);
  }
  return read;
}

double largest(const std::vector<double> &values) {
  double result = 0;
  for (const double value : values)
    result = std::max(result, std::abs(value));
  return result;
}

const std::string &file_of(const reports::Cell &cell, const std::string &name) {
  for (const auto &series : cell.series)
    if (series.name == name)
      return series.file;
  throw std::runtime_error("no series " + name);
}

class Fields : public testing::Test {
protected:
  static void SetUpTestSuite() {
    folder = std::make_unique<Folder>();
    folder->write("scene.toml", scene);
    run = run_here({"run", "scene.toml", "--quiet", "--format", "json,vtu,figures", "--output", "a"}, folder->path());
  }
  static void TearDownTestSuite() { folder.reset(); }

  static std::unique_ptr<Folder> folder;
  static Ended run;
};

std::unique_ptr<Folder> Fields::folder;
Ended Fields::run;

TEST_F(Fields, are_read_back_with_points_names_and_values) {
  if (!fs::exists("/usr/bin/meshio"))
    GTEST_SKIP() << "meshio is not installed; ./petrov test installs what packages.txt names";
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto results = reports::read_results(*folder / "a/results.json");
  ASSERT_EQ(results.cells.size(), 4u);
  for (const auto &cell : results.cells) {
    const bool elements = cell.method == "fem";
    const auto read = read_back(*folder / "a" / file_of(cell, "vtu"), *folder);
    // 16x4 and 31x7 vertices: 45 and 180 elements; Q2 shows 3 x 3 points and 4 parts of each.
    const std::size_t n_elements = cell.level == "16x4" ? 45 : 180;
    EXPECT_EQ(read.n_points, elements ? 9 * n_elements : static_cast<std::size_t>(cell.n_points));
    const std::string cells =
        elements ? "quad: " + std::to_string(4 * n_elements) : "vertex: " + std::to_string(cell.n_points);
    EXPECT_NE(read.info.find(cells), std::string::npos) << read.info;
    std::vector<std::string> names{"displacement", "displacement_error", "strain",
                                   "stress",       "stress_error",       "von_mises"};
    if (!elements)
      names.insert(names.end(), {"moment_pivot_ratio", "n_neighbours", "smoothing_length"});
    for (const auto &name : names)
      EXPECT_EQ(read.values.count(name), 1u) << name;

    // The same numbers as in the table beside it, whose names carry the components.
    const auto table = reports::parse_number_table(contents(*folder / "a" / file_of(cell, "field")));
    ASSERT_EQ(table.n_rows(), read.n_points);
    for (const auto &[name, component, n] : {std::tuple("displacement", 1u, 3u), std::tuple("stress", 2u, 3u)}) {
      const std::string column = std::string(name) + (n == 3 && std::string(name) == "stress" ? "_12" : "_2");
      for (std::size_t i = 0; i < read.n_points; ++i)
        ASSERT_EQ(read.values.at(name)[n * i + component], table.columns[table.find(column)][i]) << column;
    }
    // The largest error at particles or nodes is that of the quadrature points, up to what lies between them.
    const double relative = largest(read.values.at("displacement_error")) / largest(read.values.at("displacement"));
    const double reported = cell.errors.at("displacement_max_relative");
    EXPECT_GT(relative, 0.3 * reported) << cell.label;
    EXPECT_LT(relative, 1.5 * reported) << cell.label;
  }
}

TEST_F(Fields, are_read_by_vtk_with_counts_names_and_ranges) {
  if (!fs::exists("/usr/bin/f3d"))
    GTEST_SKIP() << "f3d is not installed; ./petrov test installs what packages.txt names";
  ASSERT_EQ(run.exit_code, 0) << run.err;
  for (const auto &cell : reports::read_results(*folder / "a/results.json").cells) {
    const bool elements = cell.method == "fem";
    const auto read = read_by_vtk(*folder / "a" / file_of(cell, "vtu"), *folder);
    const std::size_t n_elements = cell.level == "16x4" ? 45 : 180;
    EXPECT_EQ(read.n_points, elements ? 9 * n_elements : static_cast<std::size_t>(cell.n_points));
    EXPECT_EQ(read.n_cells, elements ? 4 * n_elements : static_cast<std::size_t>(cell.n_points));
    EXPECT_EQ(read.ranges.size(), elements ? 6u : 9u);

    // The table beside the file has a column for each component, in the same order; a vector of the plane has a third.
    const auto table = reports::parse_number_table(contents(*folder / "a" / file_of(cell, "field")));
    const auto expect_range = [&](const std::string &name, std::size_t component, const std::string &column) {
      SCOPED_TRACE(cell.label + ": " + name);
      ASSERT_TRUE(read.ranges.contains(name));
      ASSERT_GT(read.ranges.at(name).size(), component);
      const auto &values = table.columns[table.find(column)];
      const auto [low, high] = std::minmax_element(values.begin(), values.end());
      const double printed = 1e-5 * std::max(std::abs(*low), std::abs(*high)); // six digits are printed
      EXPECT_NEAR(read.ranges.at(name)[component].first, *low, printed);
      EXPECT_NEAR(read.ranges.at(name)[component].second, *high, printed);
    };
    for (const std::string name : {"strain", "stress"})
      for (const auto &[component, ending] : {std::pair(0u, "_11"), std::pair(1u, "_22"), std::pair(2u, "_12")})
        expect_range(name, component, name + ending);
    expect_range("displacement", 0, "displacement_1");
    expect_range("displacement", 1, "displacement_2");
    for (const std::string name : {"von_mises", "displacement_error", "stress_error"})
      expect_range(name, 0, name);
    if (!elements)
      for (const std::string name : {"moment_pivot_ratio", "n_neighbours", "smoothing_length"})
        expect_range(name, 0, name);
  }
}

/// States of a run in time: one file each with what the tables hold, and their seconds in the collection; rebuilt from
/// the results elsewhere with the same bytes.
TEST(FieldsInTime, are_read_by_vtk) {
  if (!fs::exists("/usr/bin/f3d"))
    GTEST_SKIP() << "f3d is not installed; ./petrov test installs what packages.txt names";
  const Folder folder;
  folder.write("scene.toml", "schema = 1\nbenchmark = \"bar_wave\"\n[[method]]\nname = \"ssph\"\n[[method]]\n"
                             "name = \"fem\"\n[time]\nend = \"10 us\"\nsnapshots = 2\n[study]\n"
                             "levels = [100]\nrepeats = 1\n");
  const auto ended = run_here({"run", "scene.toml", "--quiet", "--format", "json,vtu", "--output", "a"}, folder.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const auto again = run_here({"report", "a/results.json", "--format", "vtu", "--output", "b"}, folder.path());
  ASSERT_EQ(again.exit_code, 0) << again.err;
  const auto results = reports::read_results(folder / "a/results.json");
  ASSERT_EQ(results.cells.size(), 2u);
  const std::string collection = contents(folder / "a/bar_wave-scene.pvd");
  for (const auto &cell : results.cells) {
    ASSERT_EQ(cell.series.size(), 2u) << cell.label;
    for (std::size_t k = 0; k < 2; ++k) {
      const auto &series = cell.series[k];
      ASSERT_TRUE(series.time);
      EXPECT_NEAR(*series.time, 5e-6 * static_cast<double>(k + 1), cell.quantities.at("time_step"));
      const auto vtu = fs::path(series.file).replace_extension(".vtu").string();
      EXPECT_NE(collection.find(fmt::format("timestep=\"{}\"", *series.time)), std::string::npos) << collection;
      EXPECT_NE(collection.find("file=\"" + vtu + "\""), std::string::npos) << collection;
      EXPECT_EQ(contents(folder / "a" / vtu), contents(folder / "b" / vtu));
      const auto table = reports::parse_number_table(contents(folder / "a" / series.file));
      const auto read = read_by_vtk(folder / "a" / vtu, folder);
      EXPECT_EQ(read.n_points, table.n_rows());
      EXPECT_EQ(read.n_points, cell.method == "fem" ? 99u : 100u);
      for (const std::string name : {"stress", "exact_stress"}) {
        ASSERT_TRUE(read.ranges.contains(name)) << series.file;
        const auto &values = table.columns[table.find(name)];
        const auto [low, high] = std::minmax_element(values.begin(), values.end());
        const double printed = 1e-5 * std::max(std::abs(*low), std::abs(*high)); // six digits are printed
        EXPECT_NEAR(read.ranges.at(name)[0].first, *low, printed);
        EXPECT_NEAR(read.ranges.at(name)[0].second, *high, printed);
      }
    }
  }
  EXPECT_EQ(collection, contents(folder / "b/bar_wave-scene.pvd"));
}

/// Uniform strain: every field is known everywhere.
TEST_F(Fields, of_a_uniform_strain_are_uniform) {
  const Folder own;
  own.write("scene.toml", scene + "[problem]\nsolution = \"linear\"\n");
  const auto ended = run_here({"run", "scene.toml", "--quiet", "--format", "json,vtu", "--output", "a"}, own.path());
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  const double E = 226.9e9, nu = 0.33;
  for (const auto &cell : reports::read_results(own / "a/results.json").cells) {
    const auto table = reports::parse_number_table(contents(own / "a" / file_of(cell, "field")));
    const auto at = [&](const char *name, std::size_t i) { return table.columns[table.find(name)][i]; };
    // Plane stress, Hooke's law the other way round; the patch test is exact up to rounding times the condition.
    const double scale = std::abs(at("stress_11", 0)) + std::abs(at("stress_22", 0)) + std::abs(at("stress_12", 0));
    for (std::size_t i = 0; i < table.n_rows(); ++i) {
      const double e11 = at("strain_11", i), e22 = at("strain_22", i), e12 = at("strain_12", i);
      EXPECT_NEAR(at("stress_11", i), E / (1 - nu * nu) * (e11 + nu * e22), 1e-12 * scale);
      EXPECT_NEAR(at("stress_12", i), E / (1 + nu) * e12, 1e-12 * scale);
      const double s = at("stress_11", i), t = at("stress_22", i), r = at("stress_12", i);
      EXPECT_NEAR(at("von_mises", i), std::sqrt(s * s - s * t + t * t + 3 * r * r), 1e-12 * scale);
      EXPECT_LT(at("stress_error", i), 1e-7 * scale) << cell.label;
    }
  }
}

TEST_F(Fields, a_collection_names_every_file) {
  const std::string collection = contents(*folder / "a/cantilever-scene.pvd");
  for (const auto &cell : reports::read_results(*folder / "a/results.json").cells) {
    EXPECT_NE(collection.find("file=\"" + file_of(cell, "vtu") + "\""), std::string::npos) << collection;
    EXPECT_TRUE(fs::exists(*folder / "a" / file_of(cell, "vtu")));
  }
}

TEST_F(Fields, figures_are_drawn_and_rebuilt_byte_for_byte) {
  std::vector<std::string> names;
  for (const auto &entry : fs::directory_iterator(*folder / "a/figures"))
    if (entry.path().extension() == ".gp")
      names.push_back(entry.path().stem().string());
  const std::string stem = "cantilever-scene-";
  for (const char *name : {"displacement_l2_relative-cost", "displacement_l2_relative-convergence", "phases",
                           "bottom-u2", "error_field", "deformed"})
    EXPECT_NE(std::find(names.begin(), names.end(), stem + name), names.end()) << name;
  const auto again = run_here({"report", "a/results.json", "--format", "figures,vtu,json"}, folder->path());
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_EQ(again.err, "") << "gnuplot complains of nothing";
  const auto elsewhere =
      run_here({"report", "a/results.json", "--format", "figures,json", "--output", "b"}, folder->path());
  EXPECT_EQ(elsewhere.exit_code, 0) << elsewhere.err;
  EXPECT_EQ(contents(*folder / "a/results.json"), contents(*folder / "b/results.json"));
  const bool drawn = fs::exists("/usr/bin/gnuplot");
  for (const auto &name : names) {
    for (const char *ending : {".gp", ".dat", ".svg"})
      if (drawn || std::string(ending) != ".svg") {
        EXPECT_EQ(contents(*folder / "a/figures" / (name + ending)), contents(*folder / "b/figures" / (name + ending)))
            << name << ending;
        EXPECT_GT(contents(*folder / "a/figures" / (name + ending)).size(), 100u) << name << ending;
      }
    EXPECT_EQ(fs::exists(*folder / "a/figures" / (name + ".pdf")), drawn) << name;
  }
}

TEST_F(Fields, two_runs_stand_side_by_side) {
  run_here({"run", "scene.toml", "--quiet", "--format", "json", "--output", "c", "--repeats", "3"}, folder->path());
  const auto ended = run_here({"report", "a/results.json", "c/results.json", "--output", "d"}, folder->path());
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_NE(ended.out.find("cells the same within the spread"), std::string::npos) << ended.out;
  EXPECT_EQ(ended.out, contents(*folder / "d/side_by_side.txt"));
  EXPECT_EQ(run_here({"report", "a/results.json", "scene.toml"}, folder->path()).exit_code, 3);
}

} // namespace
