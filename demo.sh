#!/usr/bin/env bash
# Shows lift_slam at work. Usage: ./demo.sh
# Installs the Debian packages it needs (with sudo when not root), builds the program, runs the SLAM
# on a clip of a drive (demo/), says where the report is and opens it where there is a desktop.
set -euo pipefail
cd "$(dirname "$0")"

echo "== Packages"
tools/install_dependencies
echo "== Build (in build/release)"
cmake --preset release >/dev/null
cmake --build --preset release -j"$(nproc)" --target lift_slam

results=runs/demo
echo "== SLAM on demo/dirt-3.mp4 (one lap of a dirt track, rendered; $results)"
build/release/lift_slam run demo/dirt-3.mp4 --camera demo/dirt-3.yaml \
  --ground-truth demo/dirt-3.tum --output "$results"
echo
echo "Done. Open this page in a browser: $results/report.html"
echo "Beside it: trajectory.tum, map.ply, result.json, config.yaml, log.txt"
if [[ -n ${DISPLAY:-}${WAYLAND_DISPLAY:-} ]] && command -v xdg-open >/dev/null; then
  xdg-open "$results/report.html" >/dev/null 2>&1 || true
fi
