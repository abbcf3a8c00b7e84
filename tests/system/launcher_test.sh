#!/bin/bash
# launcher_test.sh SOURCE_DIR CASE: one test of the launcher, in a made-up project with stand-ins for what it calls:
# no package is installed and nothing is compiled. Every stand-in notes its call in $calls.
set -euo pipefail

source_dir=$1
case=$2
sandbox=$(mktemp -d)
trap 'rm -rf "$sandbox"' EXIT
project=$sandbox/project
stand_ins=$sandbox/bin
calls=$sandbox/calls
export calls project

stand_in() { # NAME, body from stdin
  { printf '#!/bin/bash\necho "%s $*" >>"$calls"\n' "$1"; cat; } >"$stand_ins/$1"
  chmod +x "$stand_ins/$1"
}

set_up() {
  mkdir -p "$project"/{meshless,comparisons,tests,cmake} "$stand_ins"
  : >"$calls"
  cp "$source_dir/petrov" "$source_dir/packages.txt" "$project/"
  touch "$project/CMakeLists.txt" "$project/comparisons/scene.cc"
  stand_in dpkg-query <<<'for p in "$@"; do [[ $p != -* ]] && echo "$p installed"; done; exit 0'
  stand_in apt-get <<<'exit 0'
  stand_in sudo <<<'[[ $1 == -* ]] && exit 1; exec "$@"'
  stand_in id <<<'echo 1000'
  stand_in ctest <<<'exit 8'
  # Configuring leaves the cache and build.ninja; building leaves a program that shows its arguments.
  stand_in cmake <<'BODY'
build=$project/build/release
if [[ $1 == --build ]]; then
  mkdir -p "$build/bin"
  printf '#!/bin/bash\nprintf "<%%s>" "$PWD" "$@"\nexit "${EXIT_CODE:-0}"\n' >"$build/bin/petrov"
  chmod +x "$build/bin/petrov"
else
  echo "CMAKE_HOME_DIRECTORY:INTERNAL=$2" >"$build/CMakeCache.txt"
  touch "$build/build.ninja"
fi
BODY
  export PATH=$stand_ins:$PATH
  unset PETROV_CONFIGURE_ARGS PETROV_PACKAGE_GROUPS PETROV_JOBS
}

fail() {
  printf 'failed: %s\n--- calls\n%s\n--- standard error\n%s\n' "$*" "$(<"$calls")" "$(cat "$sandbox/err")" >&2
  exit 1
}

# launch ARGUMENTS...: standard output, standard error and exit code in $out, $err, $code.
launch() {
  code=0
  "${launcher:-$project/petrov}" "$@" >"$sandbox/out" 2>"$sandbox/err" </dev/null || code=$?
  out=$(<"$sandbox/out")
  err=$(<"$sandbox/err")
}

called() { grep -qE -- "$1" "$calls"; }

test_first_call_configures_builds_and_runs() {
  launch compare cantilever
  ((code == 0)) || fail "exit code $code"
  called '^cmake -S .* --preset release -DPETROV_BUILD_TESTS=OFF$' || fail "not configured as Release without tests"
  called '^cmake --build .* --target petrov_program ' || fail "the program's target is not built"
  ! called '^apt-get' || fail "apt was called although nothing is missing"
  ! called '^dpkg-query .*libgtest-dev' || fail "packages of the tests are asked for"
  [[ $out == "<$PWD><compare><cantilever>" ]] || fail "standard output is '$out'"
}

test_second_call_does_no_set_up() {
  launch compare
  : >"$calls"
  launch compare
  [[ ! -s $calls ]] || fail "called again"
  [[ -z $err ]] || fail "said '$err'"
}

test_builds_again_when_a_source_changes() {
  local change
  for change in "touch comparisons/scene.cc" "touch comparisons/new.h" "rm comparisons/new.h" "touch CMakeLists.txt"; do
    launch compare
    sleep 0.02
    (cd "$project" && $change)
    : >"$calls"
    launch compare
    called '^cmake --build' || fail "no build after '$change'"
  done
}

test_a_changed_scene_needs_no_build() {
  touch "$project/comparisons/scene.toml"
  launch compare
  sleep 0.02
  echo "# changed" >>"$project/comparisons/scene.toml"
  : >"$calls"
  launch compare
  [[ ! -s $calls ]] || fail "built although only data changed"
}

test_works_through_a_symlink_from_another_folder() {
  mkdir "$sandbox/elsewhere"
  ln -s "$project/petrov" "$sandbox/elsewhere/link"
  cd "$sandbox/elsewhere"
  launcher=./link launch run 'my scene.toml' --set 'study.levels=[188]' ''
  [[ $out == "<$sandbox/elsewhere><run><my scene.toml><--set><study.levels=[188]><>" ]] || fail "the program saw '$out'"
}

test_passes_the_exit_code_on() {
  EXIT_CODE=5 launch compare
  ((code == 5)) || fail "exit code $code instead of 5"
}

test_without_the_right_to_install_it_prints_the_line() {
  stand_in dpkg-query <<<'echo "cmake installed"; echo "g++ deinstall"; exit 1'
  launch compare
  ((code != 0)) || fail "exit code 0"
  [[ $err == *"  apt-get install --yes --no-install-recommends ninja-build g++ libdeal.ii-dev "* ]] || fail "no apt line"
  [[ $err != *" cmake "* ]] || fail "an installed package is in the line"
  [[ -z $out ]] || fail "standard output is '$out'"
  ! called '^(apt-get|cmake)' || fail "went on"
}

test_root_installs_only_what_is_missing() {
  stand_in id <<<'echo 0'
  stand_in dpkg-query <<<'for p in "$@"; do [[ $p != -* && $p != libcli11-dev ]] && echo "$p installed"; done; exit 1'
  launch compare
  ((code == 0)) || fail "exit code $code"
  called '^apt-get .*update$' || fail "package lists were not fetched"
  called '^apt-get .*install --yes --no-install-recommends libcli11-dev$' || fail "not installed as expected"
}

test_a_command_that_is_there_needs_no_package() {
  printf '[build]\nhere | exists_here\nmissing | exists_nowhere\n' >"$project/packages.txt"
  stand_in dpkg-query <<<'exit 0'
  stand_in id <<<'echo 0'
  stand_in exists_here <<<'exit 0'
  launch --version
  called '^env .*install.* missing$|^apt-get .*install.* missing$' || fail "the package is not installed"
  if called ' here'; then fail "a package was installed although its command is there"; fi
}

test_a_failed_installation_stops() {
  stand_in id <<<'echo 0'
  stand_in dpkg-query <<<'exit 1'
  stand_in apt-get <<<'echo "E: no network"; exit 100'
  launch compare
  ((code == 1)) || fail "exit code $code"
  [[ $err == *"E: no network"* ]] || fail "the reason is not shown"
  ! called '^cmake' || fail "went on"
}

test_a_failed_build_is_tried_again() {
  cp "$stand_ins/cmake" "$sandbox/good"
  stand_in cmake <<<'[[ $1 == --build ]] && { echo "scene.cc:7: error: no"; exit 2; }; touch "$project/build/release/build.ninja"'
  launch compare
  ((code == 1)) || fail "exit code $code"
  [[ $err == *"scene.cc:7: error: no"* ]] || fail "the compiler's message is not shown"
  cp "$sandbox/good" "$stand_ins/cmake"
  launch compare
  ((code == 0)) || fail "exit code $code after mending"
}

test_the_tests_are_built_and_ctest_gets_the_arguments() {
  launch compare
  launch test -L unit
  ((code == 8)) || fail "ctest's exit code 8 became $code"
  called '^dpkg-query .*libgtest-dev' || fail "packages of the tests are not asked for"
  called '^cmake .*-DPETROV_BUILD_TESTS=ON' || fail "not configured with tests"
  called '^cmake --build .* --target all ' || fail "tests are not built"
  called '^ctest --test-dir .*/build/release --output-on-failure --parallel 2 -L unit$' || fail "ctest was called otherwise"
  : >"$calls"
  launch test
  [[ $(<"$calls") == ctest* ]] || fail "the second call set up again"
}

test_a_moved_folder_is_configured_anew() {
  launch compare
  mv "$project" "$sandbox/moved"
  project=$sandbox/moved
  touch "$project/comparisons/scene.cc"
  : >"$calls"
  launch compare
  called "^cmake -S $project --preset release" || fail "not configured again"
}

touch "$sandbox/err"
set_up
"test_$case"
