#!/bin/bash
# What the fast ways gain, as ratios of the benchmarks of `performance`: they hold from machine to machine better than
# seconds do. One core, each benchmark the median of some repetitions.
#
#   cmake --preset release -DPETROV_BUILD_BENCHMARKS=ON && cmake --build --preset release --target performance
#   tests/performance/ratios.sh [build folder] [repetitions]
set -euo pipefail

folder=${1:-$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")/../../build/release}
repetitions=${2:-5}
program=$folder/bin/performance
if [ ! -x "$program" ]; then
  echo "no $program: configure with -DPETROV_BUILD_BENCHMARKS=ON and build the target performance" >&2
  exit 2
fi

# what | slower | faster; a benchmark's name says what it times (tests/performance/*.cc). Shape functions and lists count
# for the same number of points.
pairs='shape functions 2D, polynomial kernel: lanes against a plain loop|plain_2d/polynomial|all_at_2d/polynomial
shape functions 2D, Gauss kernel|plain_2d/gauss|all_at_2d/gauss
shape functions 3D, polynomial kernel|plain_3d/polynomial|all_at_3d/polynomial
shape functions 3D, Gauss kernel|plain_3d/gauss|all_at_3d/gauss
neighbour lists 2D: cells against a tree|all_neighbours_by_tree<2>/100|all_neighbours<2>/100
neighbour lists 3D|all_neighbours_by_tree<3>/30|all_neighbours<3>/30
candidates: equal smoothing lengths against varying ones|candidates/varying_lengths/100|candidates/equal_lengths/100
candidates, particles graded over a factor of 1000: cells by size against a tree|graded_candidates_by_tree/100|graded_candidates/100
weak1, 91 x 19: rows that repeat copied against all computed|cantilever/weak1/91/19|cantilever/weak1_copied/91/19
weak1, 91 x 19: consistent rule against 10 x 40 points|cantilever/weak1/91/19|cantilever/weak1_consistent/91/19
weak1 against weak2, 91 x 19|cantilever/weak2/91/19|cantilever/weak1/91/19
Q2, 165 k unknowns: multigrid against Cholesky|cantilever/cholesky/2/320|cantilever/multigrid/2/320
Q2, 165 k unknowns: Cholesky against UMFPACK|cantilever/umfpack/2/320|cantilever/cholesky/2/320'

# Nanoseconds of a benchmark, of one item where it counts items. Each in a run of its own: what their counters are differs.
nanoseconds() {
  OPENBLAS_NUM_THREADS=1 "$program" --benchmark_filter="^$1\$" --benchmark_repetitions="$repetitions" \
    --benchmark_report_aggregates_only=true --benchmark_format=csv 2>/dev/null |
    awk -F, '
      BEGIN { unit["ns"] = 1; unit["us"] = 1e3; unit["ms"] = 1e6; unit["s"] = 1e9 }
      $1 ~ /_median"$/ { print ($7 > 0 ? 1e9 / $7 : $4 * unit[$5]); found = 1 }
      END { exit !found }'
}

declare -A time
while IFS='|' read -r what slower faster; do
  for name in "$slower" "$faster"; do
    if [ -z "${time[$name]:-}" ]; then
      time[$name]=$(nanoseconds "$name") || {
        echo "no benchmark '$name'" >&2
        exit 1
      }
    fi
  done
  awk -v what="$what" -v a="${time[$slower]}" -v b="${time[$faster]}" 'BEGIN { printf "%-72s %6.2f times\n", what, a / b }'
done <<<"$pairs"
