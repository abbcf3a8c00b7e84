#include "comparisons/geometry/mesh_operations.h"
#include "comparisons/problems/boundary_foot.h"
#include "comparisons/problems/cloud_file.h"
#include "comparisons/problems/domain_boundary.h"
#include "comparisons/problems/exact_solutions.h"
#include "comparisons/problems/expression_fields.h"
#include "comparisons/problems/geometry_checks.h"
#include "comparisons/problems/geometry_problem.h"
#include "comparisons/problems/reference_file.h"

#include "meshless/cloud/particles.h"
#include "meshless/domain/boundary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <optional>
#include <set>
#include <stdexcept>

namespace comparisons::problems {

namespace {

constexpr double most_cells = 2e6;

class Resolver {
public:
  Resolver(const scene::Scene &scene, scene::Diagnostics &diagnostics)
      : scene_(scene), tables_(*scene.geometry), keys_(tables_.geometry.keys), diagnostics_(diagnostics) {
    path_ = path_of_scene() / keys_.text("file");
  }

  std::shared_ptr<const ResolvedGeometry> resolve() {
    if (!check_keys())
      return nullptr;
    scene::Diagnostics read;
    const auto file = geometry::read_mesh(path_, options({}), read);
    const bool known = file && check_names(*file);
    std::optional<geometry::PlaneGeometry> base;
    if (known)
      base = geometry::make_geometry(*file, wanted_, read);
    for (const auto &finding : read.all()) {
      diagnostics_.add(finding);
      if (finding.severity == scene::Severity::warning)
        result_.remarks.push_back(finding.message);
    }
    if (!base)
      return nullptr;
    result_.shape = std::move(*base);
    if (!make_levels())
      return nullptr;
    make_exact();
    make_statement();
    if (!failed_) {
      read_cloud();
      read_reference();
    }
    make_quantities();
    check();
    if (failed_)
      return nullptr;
    return std::make_shared<const ResolvedGeometry>(std::move(result_));
  }

private:
  void error(scene::Location location, std::string key, std::string message, std::string suggestion = {}) {
    failed_ = true;
    diagnostics_.error(std::move(location), std::move(key), std::move(message), std::move(suggestion));
  }

  bool is_drawing() const { return path_.extension() == ".geo"; }

  geometry::ReadOptions options(std::optional<double> size) const {
    geometry::ReadOptions options;
    options.size = size;
    if (!size && keys_.has("size"))
      options.size = keys_.real("size");
    options.order = static_cast<int>(keys_.integer("cell_order"));
    options.quadrilaterals = keys_.text("cells") == "quadrilaterals";
    return options;
  }

  bool check_keys() {
    if (!is_drawing())
      for (const auto *key : {"size", "cell_order", "cells"})
        if (keys_.is_given(key))
          error(keys_.location(key), fmt::format("geometry.{}", key),
                "says how a drawing (.geo) is meshed; a mesh (.msh) is taken as it is", "remove the key");
    return !failed_;
  }

  /// Every name of the scene must be a group of the mesh of the right dimension.
  void check_name(const scene::PlacedTable &table, const char *key, int dimension, const geometry::MeshFile &file) {
    const auto &name = table.keys.text(key);
    const auto names = geometry::group_names(file, dimension);
    if (std::ranges::find(names, name) != names.end())
      return;
    const char *const what = dimension == 1 ? "curve" : "surface";
    const auto others = geometry::group_names(file, 3 - dimension);
    const bool other = std::ranges::find(others, name) != others.end();
    error(table.keys.location(key), fmt::format("{}.{}", table.key, key),
          fmt::format("the mesh has no physical {} {}{}; it has {}", what, scene::in_quotes(name),
                      other ? fmt::format(" (but a {} of that name)", dimension == 1 ? "surface" : "curve") : "",
                      names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", "))),
          names.empty() ? fmt::format("add Physical {}(\"{}\") = {{...}}; to the drawing",
                                      dimension == 1 ? "Curve" : "Surface", name)
                        : scene::did_you_mean(name, names));
  }

  bool check_names(const geometry::MeshFile &file) {
    if (file.groups.empty())
      return true; // make_geometry says that there are none
    for (const auto &material : tables_.materials)
      if (material.keys.has("region")) {
        check_name(material, "region", 2, file);
        wanted_.regions.push_back(material.keys.text("region"));
      }
    for (const auto &boundary : tables_.boundaries) {
      check_name(boundary, "group", 1, file);
      wanted_.boundaries.push_back(boundary.keys.text("group"));
    }
    for (const auto &quantity : tables_.quantities)
      if (quantity.keys.has("group"))
        check_name(quantity, "group", 1, file);
    return !failed_;
  }

  std::vector<scene::Level> levels() const {
    std::vector<scene::Level> all;
    const auto add = [&](const std::vector<scene::Level> &some) {
      for (const auto &level : some)
        if (std::ranges::find(all, level) == all.end())
          all.push_back(level);
    };
    add(scene_.levels);
    for (const auto &method : scene_.methods)
      add(method.levels);
    return all;
  }

  bool make_levels() {
    const geometry::PlaneGeometry base = result_.shape;
    std::size_t finest = 0;
    for (const auto &level : levels()) {
      const double wanted = wanted_cells(level, base);
      if (wanted > most_cells) {
        error(tables_.geometry.location, "study.levels",
              fmt::format("the level {} has about {:.2g} cells; at most {:.2g} are allowed", level.text, wanted,
                          most_cells));
        continue;
      }
      Mesh mesh;
      if (is_drawing() && !level.refinements) {
        auto drawn = draw(spacing_of(level, base));
        if (!drawn)
          return false;
        mesh = drawn->mesh;
        if (drawn->mesh.cells.size() > result_.shape.mesh.cells.size())
          result_.shape = std::move(*drawn);
      } else
        mesh = refined(base, level, wanted);
      if (mesh.cells.size() >= finest) {
        finest = mesh.cells.size();
        result_.finest_level = level.text;
      }
      result_.levels[level.text] = std::move(mesh);
    }
    return !failed_;
  }

  /// m; of a count, that of triangles with so many corners.
  static double spacing_of(const scene::Level &level, const geometry::PlaneGeometry &base) {
    return level.spacing ? *level.spacing : std::sqrt(2 * base.area / (std::sqrt(3.0) * level.counts.at(0)));
  }

  static double wanted_cells(const scene::Level &level, const geometry::PlaneGeometry &base) {
    const auto n = static_cast<double>(base.mesh.cells.size());
    return level.refinements ? n * std::pow(4, *level.refinements)
                             : 2 * base.area / std::pow(spacing_of(level, base), 2);
  }

  std::optional<geometry::PlaneGeometry> draw(double size) {
    scene::Diagnostics found;
    const auto file = geometry::read_mesh(path_, options(size), found);
    auto drawn = file ? geometry::make_geometry(*file, wanted_, found) : std::nullopt;
    for (const auto &finding : found.all())
      if (finding.severity == scene::Severity::error)
        error(finding.location, finding.key, fmt::format("meshed with a size of {} m: {}", size, finding.message),
              finding.suggestion);
    return drawn;
  }

  /// The mesh refined as often as "mesh/4" says, or until it is as fine as a spacing or count.
  static Mesh refined(const geometry::PlaneGeometry &base, const scene::Level &level, double wanted) {
    Mesh mesh = base.mesh;
    if (level.refinements) {
      for (int i = 0; i < *level.refinements; ++i)
        mesh = geometry::refine(mesh);
      return mesh;
    }
    const auto squares = [](const Mesh &m) {
      double n = 0;
      for (const auto &cell : m.cells)
        n += cell.n_vertices == 4 ? 2 : 1;
      return n;
    };
    while (squares(mesh) < 0.8 * wanted)
      mesh = geometry::refine(mesh);
    return mesh;
  }

  static Material material_of(const scene::Parameters &keys) {
    return {keys.real("E"), keys.real("nu"), keys.text("model") == "plane strain"};
  }

  void make_statement() {
    auto &statement = result_.statement;
    const auto &shape = result_.shape;
    for (std::size_t r = 0; r < shape.region_names.size(); ++r) {
      statement.regions.push_back({shape.region_names[r], material_of(tables_.materials[r].keys), shape.boundaries[r]});
      try {
        boundaries_.push_back(domain_boundary(shape.boundaries[r]));
      } catch (const std::invalid_argument &reason) {
        error({.file = path_.string()}, {},
              fmt::format("the boundary of the region '{}': {}", shape.region_names[r], reason.what()));
      }
    }
    statement.characteristic_length = std::max(shape.upper[0] - shape.lower[0], shape.upper[1] - shape.lower[1]);
    if (tables_.body_force)
      statement.body_force = vector_field(scene::split_expressions(tables_.body_force->keys.text("force")));
    if (tables_.thermal_expansion)
      statement.thermal_strain = scalar_values(tables_.thermal_expansion->keys.text("temperature"),
                                               tables_.thermal_expansion->keys.real("expansion"));
    if (!is_loaded())
      error(tables_.boundaries.front().location, "boundary",
            "nothing loads the body: every displacement, traction and pressure is 0, so that errors relative to the "
            "solution mean nothing",
            "give a boundary a traction, a pressure or a displacement, or add [effects.body_force] or "
            "[effects.thermal_expansion]");
    std::set<std::string> without;
    for (const auto &edge : shape.mesh.boundary)
      if (!statement.conditions.contains(edge.id)) {
        const auto &name = shape.boundary_names[static_cast<std::size_t>(edge.id)];
        const auto *table = condition_of(name);
        statement.conditions[edge.id] = table != nullptr ? make_condition(table->keys) : BoundaryCondition{};
        if (table == nullptr && name != geometry::free_boundary)
          without.insert(name);
      }
    if (!without.empty())
      diagnostics_.warning(
          tables_.boundaries.front().location, "boundary",
          fmt::format("boundaries without a condition are free of traction: {}", fmt::join(without, ", ")),
          "add [[boundary]] if that is not meant");
  }

  /// False if the answer is zero by what is written: numbers that are 0; an expression counts as a load.
  bool is_loaded() const {
    const auto is_zero = [](const std::string &text) {
      char *end = nullptr;
      return std::strtod(text.c_str(), &end) == 0 && end != text.c_str() && *end == '\0';
    };
    if (tables_.body_force || tables_.thermal_expansion)
      return true;
    for (const auto &table : tables_.boundaries) {
      for (const char *key : {"u1", "u2", "pressure"})
        if (table.keys.has(key) && !is_zero(table.keys.text(key)))
          return true;
      if (!table.keys.has("traction"))
        continue;
      if (table.keys.text("traction") == "reference")
        return true;
      for (const auto &text : scene::split_expressions(table.keys.text("traction")))
        if (!is_zero(text))
          return true;
    }
    return false;
  }

  const scene::PlacedTable *condition_of(const std::string &group) const {
    for (const auto &table : tables_.boundaries)
      if (table.keys.text("group") == group)
        return &table;
    return nullptr;
  }

  BoundaryCondition make_condition(const scene::Parameters &keys) const {
    BoundaryCondition condition;
    const std::array<const char *, 2> names{"u1", "u2"};
    std::array<std::string, 2> texts{"0", "0"};
    bool from_reference = false;
    for (std::size_t k = 0; k < 2; ++k)
      if (keys.has(names[k])) {
        condition.displacement_prescribed[k] = true;
        if (keys.text(names[k]) == "reference")
          from_reference = true;
        else
          texts[k] = keys.text(names[k]);
      }
    if (condition.displacement_prescribed[0] || condition.displacement_prescribed[1])
      condition.displacement = vector_field(texts);
    if (from_reference)
      condition.displacement = mixed(condition.displacement, keys);
    if (keys.has("pressure"))
      condition.traction = pressure_field(keys.text("pressure"));
    else if (keys.has("traction") && keys.text("traction") == "reference")
      condition.traction = traction_of(result_.exact.stress);
    else if (keys.has("traction"))
      condition.traction = traction_field(scene::split_expressions(keys.text("traction")));
    return condition;
  }

  /// The given displacement, but for the components that come from the exact solution.
  VectorField mixed(VectorField given, const scene::Parameters &keys) const {
    std::array<bool, 2> exact{};
    exact[0] = keys.has("u1") && keys.text("u1") == "reference";
    exact[1] = keys.has("u2") && keys.text("u2") == "reference";
    return [given = std::move(given), exact, reference = result_.exact.displacement](std::span<const Point2> points,
                                                                                     std::span<Vector2> values) {
      std::vector<Vector2> u(points.size());
      given(points, values);
      reference(points, u);
      for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t k = 0; k < 2; ++k)
          if (exact[k])
            values[i][k] = u[i][k];
    };
  }

  void make_exact() {
    const auto &keys = tables_.reference.keys;
    const auto material = material_of(tables_.materials.front().keys);
    const std::string solution = keys.has("solution") ? keys.text("solution") : keys.has("u1") ? "expressions" : "";
    if (solution == "expressions")
      result_.exact = {vector_field({keys.text("u1"), keys.text("u2")}),
                       stress_field({keys.text("s11"), keys.text("s22"), keys.text("s12")})};
    else if (solution == "elliptic hole")
      result_.exact = elliptic_hole(keys.real("semi_axis_1"), keys.real("semi_axis_2"), keys.real("stress"), material);
    else if (solution == "re-entrant corner")
      result_.exact = reentrant_corner(keys.real("stress"), material);
  }

  bool holds(std::size_t region, const Point2 &point) const {
    return boundaries_[region].contains(point) || !boundaries_[region].pieces_at(point).empty();
  }

  /// The first region that holds a point or has it on its boundary, or none.
  std::optional<int> region_of(const Point2 &point) const {
    for (std::size_t r = 0; r < boundaries_.size(); ++r)
      if (holds(r, point))
        return static_cast<int>(r);
    return {};
  }

  void complain(const scene::Parameters &keys, const char *key, const std::string &name, const std::string &message) {
    error(keys.location(key), name, message);
  }

  /// @return regions of the points; empty if one is outside
  std::vector<int> regions_of(std::span<const Point2> points, const std::string &file, const scene::Parameters &keys,
                              const char *key, const std::string &name,
                              const std::function<std::string(std::size_t)> &place) {
    std::vector<int> regions;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto region = region_of(points[i]);
      if (!region) {
        complain(keys, key, name,
                 fmt::format("{}{}: the point ({:.6g}, {:.6g}) is outside of the domain", file, place(i), points[i][0],
                             points[i][1]));
        return {};
      }
      regions.push_back(*region);
    }
    return regions;
  }

  void read_reference() {
    const auto &keys = tables_.reference.keys;
    if (!keys.has("file"))
      return;
    const auto path = (path_of_scene() / keys.text("file")).string();
    try {
      const auto file = parse_reference_csv(csv_text(path), path);
      auto regions = regions_of(file.points, path, keys, "file", "reference.file", [&](std::size_t i) {
        return fmt::format(":{}:{}", file.places[i].first, file.places[i].second);
      });
      if (regions.empty())
        return;
      result_.exact = known_at_points(file, result_.shape.area, std::move(regions));
      result_.reference_file = keys.text("file");
    } catch (const CsvError &fault) {
      complain(keys, "file", "reference.file", fault.what());
    }
  }

  void read_cloud() {
    const bool wanted = keys_.text("cloud") == "file";
    if (wanted != keys_.has("cloud_file")) {
      error(keys_.location(wanted ? "cloud" : "cloud_file"), "geometry.cloud_file",
            wanted ? "cloud = \"file\" needs the name of the file"
                   : fmt::format("a file of particles is given, but cloud is '{}'", keys_.text("cloud")),
            wanted ? "cloud_file = \"particles.csv\"" : "cloud = \"file\"");
      return;
    }
    if (!wanted)
      return;
    const auto path = path_of_scene() / keys_.text("cloud_file");
    try {
      auto file = path.extension() == ".csv" ? read_cloud_csv(path) : read_cloud_vtk(path);
      use_cloud(std::move(file), path.string());
    } catch (const CloudFileError &fault) {
      complain(keys_, "cloud_file", "geometry.cloud_file", fault.what());
    }
  }

  /// A file's digits put particles of round boundaries a little beside them: those closer to a piece than a hundredth
  /// of their distance to neighbours are moved onto it.
  void move_onto_boundary(std::span<Point2> points, std::span<const double> spacing) const {
    for (std::size_t i = 0; i < points.size(); ++i) {
      double least = 0.01 * spacing[i];
      Point2 best = points[i];
      for (const auto &region : result_.statement.regions)
        for (const auto &piece : region.boundary) {
          const Point2 foot = nearest_on(piece, points[i]);
          const double distance = std::hypot(foot[0] - points[i][0], foot[1] - points[i][1]);
          if (distance < least) {
            least = distance;
            best = foot;
          }
        }
      points[i] = best;
    }
  }

  /// Particles without h take the mean distance to their four nearest.
  void use_cloud(CloudFile file, const std::string &path) {
    if (file.spacing.empty() && file.positions.size() < 5) {
      complain(keys_, "cloud_file", "geometry.cloud_file",
               fmt::format("{}: {} particles without h; it cannot be found from so few", path, file.positions.size()));
      return;
    }
    if (file.spacing.empty())
      file.spacing = meshless::cloud::smoothing_lengths_by_mean<2>(file.positions, 4, 1);
    move_onto_boundary(file.positions, file.spacing);
    const auto found = regions_of(file.positions, path, keys_, "cloud_file", "geometry.cloud_file",
                                  [&](std::size_t i) { return fmt::format(", particle {}", i); });
    if (found.empty())
      return;
    const auto n_regions = static_cast<int>(boundaries_.size());
    for (std::size_t i = 0; i < file.regions.size(); ++i)
      if (file.regions[i] >= n_regions || !holds(static_cast<std::size_t>(file.regions[i]), file.positions[i])) {
        complain(keys_, "cloud_file", "geometry.cloud_file",
                 fmt::format("{}, particle {}: ({:.6g}, {:.6g}) is not in region {}; regions are counted from 0 as "
                             "[[material]]",
                             path, i, file.positions[i][0], file.positions[i][1], file.regions[i]));
        return;
      }
    result_.cloud.spacing = std::move(file.spacing);
    result_.cloud.positions = std::move(file.positions);
    if (n_regions > 1)
      result_.cloud.regions = file.regions.empty() ? found : std::move(file.regions);
  }

  std::filesystem::path path_of_scene() const { return std::filesystem::path(scene_.file).parent_path(); }

  void make_quantities() {
    for (const auto &table : tables_.quantities) {
      const auto &keys = table.keys;
      const auto &kind = keys.text("kind");
      if (kind == "line") {
        add_line(table);
        continue;
      }
      RequestedQuantity quantity;
      quantity.name = keys.text("name");
      const std::map<std::string, RequestedQuantity::Kind> kinds{
          {"displacement", RequestedQuantity::Kind::displacement},
          {"stress", RequestedQuantity::Kind::stress},
          {"largest_von_mises", RequestedQuantity::Kind::largest_von_mises},
          {"reaction", RequestedQuantity::Kind::reaction},
          {"strain_energy", RequestedQuantity::Kind::strain_energy}};
      const std::map<std::string, int> components{{"1", 0},  {"2", 1},  {"magnitude", 2}, {"11", 0},
                                                  {"22", 1}, {"12", 2}, {"von_mises", 3}};
      quantity.kind = kinds.at(kind);
      if (keys.has("component"))
        quantity.component = components.at(keys.text("component"));
      if (keys.has("point")) {
        quantity.point = keys.point("point");
        require_inside(table, "point");
      }
      if (keys.has("group")) {
        const auto &names = result_.shape.boundary_names;
        quantity.id = static_cast<int>(std::ranges::find(names, keys.text("group")) - names.begin());
      }
      quantity.scale = keys.real("scale");
      if (keys.has("reference"))
        quantity.reference = keys.real("reference");
      result_.quantities.push_back(std::move(quantity));
    }
  }

  void add_line(const scene::PlacedTable &table) {
    SampleLine line{table.keys.text("name"), {}, 0};
    const auto from = table.keys.point("from");
    const auto to = table.keys.point("to");
    require_inside(table, "from");
    require_inside(table, "to");
    const auto n = static_cast<int>(table.keys.integer("points"));
    for (int i = 0; i < n; ++i) {
      const double t = static_cast<double>(i) / (n - 1);
      line.points.push_back({(1 - t) * from[0] + t * to[0], (1 - t) * from[1] + t * to[1]});
    }
    line.axis = std::abs(to[1] - from[1]) > std::abs(to[0] - from[0]) ? 1 : 0;
    result_.lines.push_back(std::move(line));
  }

  void require_inside(const scene::PlacedTable &table, const char *key) {
    const auto point = table.keys.point(key);
    double nearest = 1e300;
    for (const auto &boundary : boundaries_) {
      if (boundary.contains(point))
        return;
      nearest = std::min(nearest, boundary.distance(point));
    }
    // On a round boundary in straight pieces the true point is outside by the sagitta.
    if (nearest > 1e-3 * result_.shape.extent())
      error(
          table.keys.location(key), fmt::format("{}.{}", table.key, key),
          fmt::format("the point ({:.6g}, {:.6g}) is outside of the domain, by {:.3g} m", point[0], point[1], nearest));
  }

  void check() {
    if (failed_)
      return;
    scene::Diagnostics found;
    check_rigid_motions(result_.shape, result_.statement, tables_, found);
    check_finite(result_.shape, result_.statement, tables_, found);
    if (!found.has_errors())
      check_shared_corners(result_.shape, result_.statement, tables_, found);
    for (const auto &finding : found.all())
      diagnostics_.add(finding);
    failed_ = found.has_errors();
  }

  const scene::Scene &scene_;
  const scene::GeometryTables &tables_;
  const scene::Parameters &keys_;
  scene::Diagnostics &diagnostics_;
  std::filesystem::path path_;
  geometry::WantedGroups wanted_;
  std::vector<meshless::domain::Boundary> boundaries_;
  ResolvedGeometry result_;
  bool failed_ = false;
};

} // namespace

std::shared_ptr<const ResolvedGeometry> resolve_geometry(const scene::Scene &scene, scene::Diagnostics &diagnostics) {
  return Resolver(scene, diagnostics).resolve();
}

} // namespace comparisons::problems
