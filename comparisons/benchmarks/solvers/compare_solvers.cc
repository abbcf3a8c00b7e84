#include "comparisons/program/fast_blas.h"
#include "comparisons/program/program.h"

int main(int argc, char **argv) {
  comparisons::program::restart_with_fast_blas(argv);
  return comparisons::program::run_comparison("solvers", argc, argv, comparisons::study::shipped_catalogue());
}
