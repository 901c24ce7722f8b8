#!/usr/bin/env bash
# Shows lift_slam at work. Usage: ./demo.sh
# Installs the Debian packages it needs (with sudo when not root), builds the program, renders a
# short synthetic sequence, runs the SLAM on it and says where the report is.
set -euo pipefail
cd "$(dirname "$0")"

echo "== Packages"
tools/install_dependencies
echo "== Build (in build/release)"
cmake --preset release >/dev/null
cmake --build --preset release -j"$(nproc)" --target lift_slam

program=build/release/lift_slam
data=runs/demo/kitti
sequence=$data/sequences/00
results=runs/demo/results
echo "== Synthetic sequence ($sequence)"
rm -rf "$data"
"$program" synthesize --output "$data" --path street_drive --layout kitti
echo "== SLAM ($results)"
"$program" run "$sequence" --output "$results"
echo
echo "Done. Open this page in a browser: $results/report.html"
echo "Beside it: trajectory.tum, map.ply, result.json, config.yaml, log.txt"
