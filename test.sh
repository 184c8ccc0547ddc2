#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test but the slow ones.
#   ./test.sh --slow            the slow tests instead (hours on a small machine)
#   ./test.sh --preset asan     another preset of CMakePresets.json (clang, asan, tsan, debug)
# Further arguments go to ctest:  ./test.sh -R oracle
set -euo pipefail
cd "$(dirname "$0")"

preset=release
labels=(-LE slow)
arguments=()
while [ $# -gt 0 ]; do
  case "$1" in
    --slow) labels=(-L slow) ;;
    --preset) preset=$2; shift ;;
    *) arguments+=("$1") ;;
  esac
  shift
done

cmake/install-dependencies.sh test
mkdir -p build
cmake --preset "$preset" -DVOXMELT_TESTS=ON > build/configure.log || { cat build/configure.log; exit 1; }
cmake --build --preset "$preset"
exec ctest --test-dir "build/$preset" --output-on-failure --no-tests=error -j $(($(nproc) + 1)) "${labels[@]}" ${arguments+"${arguments[@]}"}
