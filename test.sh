#!/usr/bin/env bash
# Builds lift_slam and runs all of its tests. Usage: ./test.sh [--preset release|debug|asan|tsan]
# Installs the Debian packages it needs (with sudo when not root), builds in build/PRESET, and ends
# with one line: "N passed, N failed".
set -euo pipefail
cd "$(dirname "$0")"

preset=release
case ${1:-} in
  "") ;;
  --preset) preset=${2:?"--preset needs release, debug, asan or tsan"} ;;
  -h | --help) sed -n '2,4s/^# //p' "$0"; exit 0 ;;
  *) echo "test.sh: unknown option '$1'; expected --preset release|debug|asan|tsan" >&2; exit 1 ;;
esac
case $preset in
  release | debug | asan | tsan) ;;
  *) echo "test.sh: unknown preset '$preset'; expected release, debug, asan or tsan" >&2; exit 1 ;;
esac

echo "== Packages"
tools/install_dependencies
echo "== Build (preset $preset, in build/$preset)"
cmake --preset "$preset" >/dev/null
cmake --build --preset "$preset" -j"$(nproc)"
echo "== Tests"
log=build/$preset/test_output.txt
status=0
# The layer and format checks are tests among the others (cmake/Checks.cmake).
ctest --preset "$preset" -j"$(nproc)" --no-tests=error 2>&1 | tee "$log" || status=$?

totals=$(grep -E '^[0-9]+% tests passed, [0-9]+ tests? failed out of [0-9]+' "$log" || true)
if [[ -z $totals ]]; then
  echo "test.sh: ctest gave no totals; its output is in $log" >&2
  exit 1
fi
read -r failed total < <(sed -E 's/^.* ([0-9]+) tests? failed out of ([0-9]+).*$/\1 \2/' <<<"$totals")
skipped=$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped' "$log" || true)
echo
if ((skipped > 0)); then
  echo "$skipped of the passed tests were skipped: each says why (no real sequences, or a preview nobody asked for)."
fi
echo "$((total - failed)) passed, $failed failed"
exit "$status"
