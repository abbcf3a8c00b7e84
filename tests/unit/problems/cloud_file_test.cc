// Clouds from CSV: what is read, and what every fault of a file is told with.

#include "comparisons/problems/cloud_file.h"
#include "unit/linear_algebra/refusal.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace {

using namespace comparisons::problems;
using refusal::mentions;

std::string fault_of(const std::string &text) {
  return refusal::message_of<CloudFileError>([&] { parse_cloud_csv(text, "cloud.csv"); });
}

TEST(CloudFile, reads_columns_in_any_order_and_writes_them_to_the_last_bit) {
  const auto cloud = parse_cloud_csv("\xef\xbb\xbf# a comment\r\n\r\n y , x,h,region,volume\r\n"
                                     "2.5,1e-3, .1,0,4\r\n  # another\n+3,-0.1,0.2,1,5",
                                     "cloud.csv");
  ASSERT_EQ(cloud.positions.size(), 2u);
  EXPECT_EQ(cloud.positions[0], (Point2{1e-3, 2.5}));
  EXPECT_EQ(cloud.positions[1], (Point2{-.1, 3}));
  EXPECT_EQ(cloud.spacing, (std::vector<double>{.1, .2}));
  EXPECT_EQ(cloud.volumes, (std::vector<double>{4, 5}));
  EXPECT_EQ(cloud.regions, (std::vector<int>{0, 1}));

  const Cloud written{{{1. / 3, 2e-17}, {-7e300, 0}, {1. / 3, 2e-17}}, {.1, 1. / 7, .1}, {0, 0, 1}};
  const auto again = parse_cloud_csv(cloud_csv(written, "made by a test"), "cloud.csv");
  EXPECT_EQ(again.positions, written.positions);
  EXPECT_EQ(again.spacing, written.spacing);
  EXPECT_EQ(again.regions, written.regions);
  EXPECT_TRUE(parse_cloud_csv(cloud_csv({{{0, 0}}, {1}}, ""), "cloud.csv").regions.empty());
}

TEST(CloudFile, names_the_place_of_every_fault) {
  EXPECT_TRUE(mentions(fault_of(""), {"cloud.csv:1:1:", "holds nothing"}));
  EXPECT_TRUE(mentions(fault_of("# only this\n"), {"holds nothing"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n"), {"no particles"}));
  EXPECT_TRUE(mentions(fault_of("x,z\n1,2\n"), {"cloud.csv:1:3:", "'z'", "x, y, h, volume, region"}));
  EXPECT_TRUE(mentions(fault_of("0.5,1\n1,2\n"), {"cloud.csv:1:1:", "0.5", "first line x,y"}));
  EXPECT_TRUE(mentions(fault_of("x,y,x\n"), {"cloud.csv:1:5:", "twice"}));
  EXPECT_TRUE(mentions(fault_of("x,h\n"), {"y is missing"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1\n"), {"cloud.csv:2:2:", "1 entries", "2"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1,2,3\n"), {"cloud.csv:2:5:", "3 entries"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1, two\n"), {"cloud.csv:2:4:", "y is 'two'", "number"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1,2e\n"), {"'2e'"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1,\n"), {"cloud.csv:2:3:", "y is ''"}));
  EXPECT_TRUE(mentions(fault_of("x,y\nnan,2\n"), {"cloud.csv:2:1:", "finite"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1,1e999\n"), {"cloud.csv:2:3:", "1e999"}));
  EXPECT_TRUE(mentions(fault_of("x,y,h\n1,2,0\n"), {"cloud.csv:2:5:", "h is 0", "greater than 0"}));
  EXPECT_TRUE(mentions(fault_of("x,y,volume\n1,2,-1\n"), {"volume is -1"}));
  EXPECT_TRUE(mentions(fault_of("x,y,region\n1,2,0.5\n"), {"region is 0.5", "whole number"}));
  EXPECT_TRUE(mentions(fault_of("x,y\n1,2\n3,4\n 1,2\n"), {"cloud.csv:4:2:", "(1, 2)", "line 2"}));
  EXPECT_TRUE(mentions(fault_of("x,y,region\n1,2,0\n1,2,1\n1,2,1\n"), {"cloud.csv:4:1:", "line 3"}));
  // All faults in one pass, but not without end.
  EXPECT_TRUE(mentions(fault_of("x,y\na,1\n1,b\n"), {"cloud.csv:2:1:", "cloud.csv:3:3:"}));
  std::string many = "x,y\n";
  for (int i = 0; i < 1000; ++i)
    many += "?,?\n";
  const auto faults = fault_of(many);
  EXPECT_EQ(std::count(faults.begin(), faults.end(), '\n'), 19);
  EXPECT_TRUE(mentions(refusal::message_of<CloudFileError>([] { read_cloud_csv("/nowhere/cloud.csv"); }),
                       {"/nowhere/cloud.csv", "cannot be read"}));
}

std::string vtk_fault_of(const std::string &text) {
  return refusal::message_of<CloudFileError>([&] { parse_cloud_vtk(text, "cloud.vtk"); });
}

const std::string legacy =
    "# vtk DataFile Version 3.0\ntitle\nASCII\nDATASET POLYDATA\nPOINTS 2 double\n0 1 0\n2.5 -3 0\n"
    "VERTICES 1 3\n2 0 1\nPOINT_DATA 2\nSCALARS pressure double 1\nLOOKUP_TABLE default\n7 8\n"
    "SCALARS h double\nLOOKUP_TABLE default\n.1 .2\nFIELD FieldData 2\nvelocity 3 2 double\n"
    "1 2 3 4 5 6\nregion 1 2 int\n0 1\n";
const std::string xml =
    "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\">\n<UnstructuredGrid>\n"
    "<Piece NumberOfPoints=\"2\" NumberOfCells=\"0\">\n<PointData>\n"
    "<DataArray type=\"Float64\" Name=\"h\" format=\"ascii\">.1 .2</DataArray>\n"
    "<DataArray type=\"Float64\" Name=\"other\" format=\"ascii\">? ?</DataArray>\n</PointData>\n"
    "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">\n0 1 0\n2.5 -3 0\n"
    "</DataArray></Points>\n</Piece></UnstructuredGrid></VTKFile>\n";

std::string changed(std::string text, const std::string &from, const std::string &to) {
  text.replace(text.find(from), from.size(), to);
  return text;
}

TEST(CloudFile, reads_points_of_vtk_files) {
  for (const auto &text : {legacy, xml}) {
    const auto cloud = parse_cloud_vtk(text, "cloud.vtk");
    EXPECT_EQ(cloud.positions, (std::vector<Point2>{{0, 1}, {2.5, -3}}));
    EXPECT_EQ(cloud.spacing, (std::vector<double>{.1, .2}));
    EXPECT_TRUE(cloud.volumes.empty());
  }
  EXPECT_EQ(parse_cloud_vtk(legacy, "cloud.vtk").regions, (std::vector<int>{0, 1}));
}

TEST(CloudFile, names_the_fault_of_a_vtk_file) {
  EXPECT_TRUE(mentions(vtk_fault_of("x,y\n1,2\n"), {"cloud.vtk:1:1:", "vtk DataFile", "VTKFile"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, "ASCII", "BINARY")), {"cloud.vtk:3:1:", "BINARY", "only ASCII"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, "-3 0", "-3 .5")), {"cloud.vtk:7:8:", "z = 0.5"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, "2.5", "2,5")), {"cloud.vtk:7:1:", "x of point 1", "2,5"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, "POINTS 2", "POINTS 999999999")), {"cloud.vtk:5:8:", "can hold"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, "POINTS 2", "POINTS -2")), {"whole number"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(changed(legacy, "2.5 -3", "0 1"), "region", "other")), {"points 0 and 1"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, ".1 .2", ".1 0")), {"h of point 1", "greater than 0"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(legacy, "POINTS", "POINT")), {"no POINTS"}));
  EXPECT_TRUE(mentions(vtk_fault_of(legacy + "SCALARS h double\nLOOKUP_TABLE default\n.1 .2\n"), {"h stands twice"}));
  EXPECT_TRUE(mentions(vtk_fault_of(xml.substr(0, 200)), {"cloud.vtk:"}));
  EXPECT_TRUE(
      mentions(vtk_fault_of(changed(xml, "NumberOfPoints=\"2\"", "NumberOfPoints=\"1000000000000\"")), {"no count"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(xml, "NumberOfComponents=\"3\" format=\"ascii\"", "format=\"appended\"")),
                       {"appended", "ascii"}));
  EXPECT_TRUE(mentions(vtk_fault_of(changed(xml, "-3 0", "-3 x")), {"z of point 1", "x"}));
  // Cut anywhere, a file is either refused with its name or complete.
  for (const auto &text : {legacy, xml})
    for (std::size_t n = 0; n < text.size(); ++n) {
      try {
        parse_cloud_vtk(text.substr(0, n), "cloud.vtk");
      } catch (const CloudFileError &error) {
        EXPECT_TRUE(std::string(error.what()).starts_with("cloud.vtk:"));
      }
    }
}

} // namespace
