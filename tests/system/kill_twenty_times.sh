#!/bin/bash
# Twenty times kill -9 at random moments of `petrov compare --full --resume`, then a run that must complete; takes as
# long as one such run and a bit, so it stands beside the tests. After every kill results.json, if there is one, must be
# whole.
#   kill_twenty_times.sh PROGRAM FOLDER [ARGUMENT...]     arguments in place of --full
set -euo pipefail
program=$(readlink -f "$1")
folder=$2
shift 2
if (($# == 0)); then set -- --full; fi
mkdir -p "$folder"
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
longest=${LONGEST:-30} # s between two kills

check_files() {
  local file
  while IFS= read -r -d '' file; do
    if [[ ! -s $file ]] || { [[ $file == *.json ]] && ! "$program" report "$file" --quiet --output "$scratch" >/dev/null; }; then
      echo "broken: $file" >&2
      exit 1
    fi
  done < <(find "$folder" -type f ! -name '.*' ! -path '*/checkpoints/*' -print0)
}

for ((kill = 1; kill <= 20; ++kill)); do
  "$program" compare "$@" --resume --output "$folder" >/dev/null 2>&1 &
  process=$!
  sleep "$((RANDOM % longest)).$((RANDOM % 10))"
  kill -KILL "$process" 2>/dev/null || true
  wait "$process" 2>/dev/null || true
  check_files
  echo "kill $kill: $(grep -c identity "$folder/.cells" 2>/dev/null || true) runs of cells are kept"
done
code=0
"$program" compare "$@" --resume --output "$folder" >/dev/null || code=$?
check_files
echo "the last run ended with exit code $code"
exit "$code"
