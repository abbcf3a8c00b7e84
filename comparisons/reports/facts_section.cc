#include "comparisons/reports/facts_section.h"

#include "comparisons/reports/numbers.h"

#include <algorithm>
#include <array>

namespace comparisons::reports {

namespace {

struct Fact {
  const char *quantity;
  const char *meaning;
};

/// One row of the paper's table with its words.
struct PaperRow {
  const char *row;
  const char *ssph;
  const char *elements;
  std::vector<Fact> facts;
};

const std::vector<PaperRow> &paper_rows() {
  static const std::vector<PaperRow> rows{
      {"Weak form", "Not required", "Global", {{"fact_integrated_domains", "domains that integrals are taken over"}}},
      {"Information needed about nodes",
       "Locations only",
       "Locations and connectivity",
       {{"fact_reals_per_point", "reals a point"}, {"fact_integers_per_point", "integers a point"}}},
      {"Subdomains",
       "Circular/rectangular (supports), not necessarily disjoint",
       "Polygonal and disjoint",
       {{"fact_subdomains", "supports or cells"}, {"fact_subdomains_per_point", "of them over a place"}}},
      {"Basis functions",
       "Polynomials, require more CPU time to find them",
       "Polynomials, easy to find",
       {{"fact_functions_per_point", "functions at a place"}, {"fact_microseconds_value", "microseconds a function"}}},
      {"Derivatives of trial solution",
       "Easy to evaluate",
       "Require more CPU time to evaluate them",
       {{"fact_microseconds_place_gradient", "microseconds a place, functions and gradients"},
        {"fact_microseconds_gradient", "microseconds a function with its gradient"}}},
      {"Integration rule",
       "Not needed in the collocation method",
       "Depends upon the degree of polynomials in basis functions",
       {{"fact_quadrature_points", "quadrature points of the matrix"}}},
      {"Mass/stiffness matrix",
       "Asymmetric, large bandwidth that can not be determined a priori",
       "Symmetric, banded, mass matrix positive definite",
       {{"fact_rows", "rows"},
        {"fact_nonzeros_per_row", "nonzeros a row"},
        {"fact_half_bandwidth", "half-bandwidth"},
        {"fact_symmetry_defect", "symmetry defect"},
        {"fact_symmetry_defect_inside", "the same, inner particles"}}},
      {"Assembly of equations",
       "Not required",
       "Required",
       {{"fact_assembly_seconds", "s for neighbours, basis and rows"}}},
      {"Stresses/strains",
       "Smooth everywhere",
       "Good at integration points",
       {{"fact_stress_jump", "jump between neighbours over size"}}},
      {"Addition of nodes/particles",
       "Easy",
       "Difficult",
       {{"fact_points_added", "points added where stress is largest"},
        {"fact_insertion_seconds", "s to add them"},
        {"fact_insertion_solve_seconds", "s to solve again"},
        {"fact_insertion_stress_error", "stress L2 relative then"}}},
      {"Determination of time step size",
       "Easy",
       "Easy",
       {{"fact_critical_courant", "critical step: wave speed x step / spacing"},
        {"fact_critical_step_seconds", "s to find it"}}},
      {"Computation of total strain energy",
       "Difficult (requires a background mesh)",
       "Easy",
       {{"fact_energy_background_points", "points of a background mesh"},
        {"fact_energy_seconds", "s for the energy"}, // of elements it comes with the solution
        {"fact_strain_energy", "strain energy, J/m"}}},
      {"Data preparation effort",
       "Little",
       "Extensive",
       {{"fact_input_lines", "lines of input"}, {"fact_preparation_seconds", "s to make points or mesh"}}},
      {"Imposition of essential boundary conditions",
       "Easy",
       "Easy",
       {{"fact_essential_error", "largest error on the boundary over largest u"}}},
  };
  return rows;
}

bool has_facts(const Cell &cell) {
  return cell.status == Status::ok &&
         std::any_of(cell.quantities.begin(), cell.quantities.end(), [](const auto &q) { return is_fact(q.first); });
}

Table facts_table(const std::vector<const Cell *> &cells) {
  std::vector<Column> columns{{"row", Align::left, true},
                              {"SSPH, in words", Align::left, true},
                              {"FE, in words", Align::left, true},
                              {"measured", Align::left, true}};
  for (const Cell *cell : cells)
    columns.push_back({cell->label});
  Table table(std::move(columns));
  for (const PaperRow &paper : paper_rows())
    for (std::size_t k = 0; k < paper.facts.size(); ++k) {
      std::vector<std::string> row{"", "", ""};
      if (k == 0)
        row = {paper.row, paper.ssph, paper.elements};
      row.emplace_back(paper.facts[k].meaning);
      for (const Cell *cell : cells)
        row.push_back(significant(reportable(*cell, paper.facts[k].quantity)));
      table.add_row(std::move(row));
    }
  return table;
}

} // namespace

void append_facts(Document &document, const std::vector<Group> &groups) {
  bool has_heading = false;
  for (const Group &group : groups) {
    std::vector<std::string> levels;
    for (const Cell *cell : group.cells)
      if (has_facts(*cell) && std::find(levels.begin(), levels.end(), cell->level) == levels.end())
        levels.push_back(cell->level);
    for (const std::string &level : levels) {
      if (!has_heading) {
        document.push_back(Heading{2, "SSPH and finite elements, measured (Zhang & Batra 2008, Table 7)"});
        document.push_back(Paragraph{
            "The paper compares in words; the figures beside them are of this run. Half-bandwidths are those of the "
            "Cuthill-McKee order; the symmetry defect is |K - K^T| / |K|. The shape functions of elements are "
            "evaluated as at arbitrary places, without the "
            "table that their assembly has. The stress jumps across the inner edges of the mesh, for all methods at "
            "the "
            "same places. The critical step is that of central differences with lumped mass, spacing the root of the "
            "area a point. The energy of elements is a by-product of their solution. A dash: the method has no such "
            "thing, or it was not measured; collocated boundary conditions have no inertia, so that there is no "
            "critical "
            "step."});
      }
      has_heading = true;
      std::vector<const Cell *> cells;
      for (const Cell *cell : group.cells)
        if (has_facts(*cell) && cell->level == level)
          cells.push_back(cell);
      document.push_back(Heading{3, group.common_level().empty() ? group.title() + ", " + level : group.title()});
      document.push_back(facts_table(cells));
    }
  }
}

} // namespace comparisons::reports
