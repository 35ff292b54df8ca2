#!/usr/bin/env bash
# Makes the Debian packages and looks into them:  package_test.sh BUILD_DIR
set -euo pipefail
build_dir=$1
fail() { echo "package_test: $*" >&2; exit 1; }

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
cpack --config "$build_dir/CPackConfig.cmake" -B "$work" >cpack.log 2>&1 || { cat cpack.log; fail "cpack failed"; }
program=$(echo lego-loam-sc_*.deb) development=$(echo liblego-loam-sc-dev_*.deb)
[[ -f $program && -f $development ]] || fail "two packages must be made, there are: $(ls)"

# What the program needs was found in its file.
depends=$(dpkg-deb --field "$program" Depends)
for library in libc6 libgtsam4 libtbb12 libembree4 libspdlog; do
  [[ $depends == *"$library"* ]] || fail "$program does not depend on $library but on: $depends"
done
[[ -n $(dpkg-deb --field "$program" Version Architecture Maintainer Description) ]]

dpkg-deb --extract "$program" program
[[ $(cd program && find . -type f | sort | xargs) == "./usr/bin/lego-loam-sc ./usr/share/doc/lego-loam-sc/copyright" ]] ||
  fail "$program holds: $(cd program && find . -type f)"
program/usr/bin/lego-loam-sc --version
program/usr/bin/lego-loam-sc config >/dev/null

dpkg-deb --extract "$development" development
for file in include/lego_loam_sc/slam/slam.hpp lib/liblego_loam_sc.a lib/liblego_loam_sc_io.a \
  lib/cmake/lego_loam_sc/lego_loam_sc-config.cmake share/doc/liblego-loam-sc-dev/copyright; do
  [[ -s development/usr/$file ]] || fail "$development has no $file"
done
