#!/usr/bin/env bash
# Installs the build into a folder of its own, builds examples/ against that copy as a project of
# its own, and runs them:  examples_test.sh SOURCE_DIR BUILD_DIR CXX_COMPILER
set -euo pipefail
source_dir=$1 build_dir=$2 compiler=$3
fail() { echo "examples_test: $*" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cmake --install "$build_dir" --prefix "$work/installed" >/dev/null
cmake -G Ninja -S "$source_dir/examples" -B build -DCMAKE_PREFIX_PATH="$work/installed" \
  -DCMAKE_CXX_COMPILER="$compiler" -DCMAKE_CXX_FLAGS="-Wall -Wextra -Werror" >/dev/null
cmake --build build

# Nothing that was installed may look into the source tree.
if grep -rlF --include='*.hpp' --include='*.cmake' "$source_dir" installed; then
  fail "these point into the source tree"
fi

# One and a half rounds on a circle of 60 m, at 6 m/s.
awk 'BEGIN { r = 60 / 6.283185307; for (i = 0; i <= 150; i++) { a = i * 0.1 * 6 / r;
  printf "%.1f %.4f %.4f 1.7 0 0 %.9f %.9f\n", i / 10, r * sin(a), r * (1 - cos(a)), sin(a / 2), cos(a / 2) } }' > round.tum
installed/bin/lego-loam-sc simulate city --route round.tum --sensor vlp16 -o scans 2>/dev/null

./build/01_scan_folder scans | tail -2
rmse=$(installed/bin/lego-loam-sc evaluate --json scans/truth.tum trajectory.tum | awk '/"rmse"/ { print $2 + 0; exit }')
awk "BEGIN { exit !($rmse < 0.05) }" || fail "01_scan_folder is off by $rmse m, less than 0.05 m is usual"
[[ $(head -c 3 map.ply) == ply ]] || fail "map.ply is no PLY file"

./build/02_own_driver > driver.txt
tail -1 driver.txt
awk 'END { x = $5; y = $7; exit !(x > 3.8 && x < 4.0 && y > -0.1 && y < 0.1) }' driver.txt ||
  fail "after 3.9 s at 1 m/s the vehicle of 02_own_driver must be near x = 3.9 m"

./build/03_own_loop_detector scans | tee loops.txt
grep -q "is back at" loops.txt || fail "03_own_loop_detector found no loop"
