#include "comparisons/reports/vtu.h"

#include "comparisons/reports/page/svg.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <stdexcept>

namespace comparisons::reports {

namespace {

/// VTK's numbers of cell types by their number of vertices.
int vtk_type(std::size_t n_vertices) { return n_vertices == 1 ? 1 : n_vertices == 3 ? 5 : 9; }

void check(const FieldGrid &grid, const std::vector<PointField> &fields) {
  for (const PointField &field : fields)
    if (field.values.size() != grid.points.size() * field.n_components())
      throw std::invalid_argument(fmt::format("the field {} has {} values for {} points of {} components", field.name,
                                              field.values.size(), grid.points.size(), field.n_components()));
}

std::string array(const std::string &attributes, const std::string &numbers) {
  return fmt::format("        <DataArray {} format=\"ascii\">\n{}        </DataArray>\n", attributes, numbers);
}

std::string field_array(const PointField &field, std::size_t n_points) {
  const std::size_t n = field.n_components();
  const bool is_vector = n == 2;
  std::string numbers;
  for (std::size_t i = 0; i < n_points; ++i) {
    for (std::size_t k = 0; k < n; ++k)
      numbers += fmt::format("{}{}", k > 0 ? " " : "", field.values[i * n + k]);
    numbers += is_vector ? " 0\n" : "\n";
  }
  std::string attributes = fmt::format("type=\"Float64\" Name=\"{}\" NumberOfComponents=\"{}\"",
                                       html_escaped(field.name), is_vector ? 3 : n);
  for (std::size_t k = 0; k < field.components.size(); ++k)
    attributes += fmt::format(" ComponentName{}=\"{}\"", k, html_escaped(field.components[k]));
  return array(attributes, numbers);
}

} // namespace

std::string vtu_text(const FieldGrid &grid, const std::vector<PointField> &fields) {
  check(grid, fields);
  std::string text = fmt::format("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\" "
                                 "byte_order=\"LittleEndian\">\n  <UnstructuredGrid>\n    <Piece NumberOfPoints=\"{}\" "
                                 "NumberOfCells=\"{}\">\n      <PointData>\n",
                                 grid.points.size(), grid.cells.size());
  for (const PointField &field : fields)
    text += field_array(field, grid.points.size());
  std::string points, connectivity, offsets, types;
  for (const auto &point : grid.points)
    points += fmt::format("{} {} 0\n", point[0], point[1]);
  std::size_t offset = 0;
  for (const auto &cell : grid.cells) {
    connectivity += fmt::format("{}\n", fmt::join(cell, " "));
    offsets += fmt::format("{}\n", offset += cell.size());
    types += fmt::format("{}\n", vtk_type(cell.size()));
  }
  text += "      </PointData>\n      <Points>\n" +
          array("type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"", points) +
          "      </Points>\n      <Cells>\n" + array("type=\"Int64\" Name=\"connectivity\"", connectivity) +
          array("type=\"Int64\" Name=\"offsets\"", offsets) + array("type=\"UInt8\" Name=\"types\"", types);
  return text + "      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n</VTKFile>\n";
}

std::string field_table(const FieldGrid &grid, const std::vector<PointField> &fields) {
  check(grid, fields);
  std::string text = "x1,x2";
  for (const PointField &field : fields) {
    if (field.components.empty())
      text += "," + field.name;
    for (const std::string &component : field.components)
      text += "," + field.name + "_" + component;
  }
  text += '\n';
  for (std::size_t i = 0; i < grid.points.size(); ++i) {
    text += fmt::format("{},{}", grid.points[i][0], grid.points[i][1]);
    for (const PointField &field : fields)
      for (std::size_t k = 0; k < field.n_components(); ++k)
        text += fmt::format(",{}", field.values[i * field.n_components() + k]);
    text += '\n';
  }
  return text;
}

std::string pvd_text(const std::vector<CollectionEntry> &entries) {
  std::string text = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n  <Collection>\n";
  for (const CollectionEntry &entry : entries)
    text += fmt::format("    <DataSet timestep=\"{}\" part=\"{}\" name=\"{}\" file=\"{}\"/>\n", entry.time, entry.part,
                        html_escaped(entry.name), html_escaped(entry.file));
  return text + "  </Collection>\n</VTKFile>\n";
}

} // namespace comparisons::reports
