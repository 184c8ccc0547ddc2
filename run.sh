#!/usr/bin/env bash
# Installs what is missing, builds, melts the default scene and says where the pictures are.
# Extra arguments go to `voxmelt run`:  ./run.sh goblet --steps 500
set -euo pipefail
cd "$(dirname "$0")"

cmake/install-dependencies.sh build
cmake --preset release -DVOXMELT_TESTS=OFF > build/configure.log || { cat build/configure.log; exit 1; }
cmake --build --preset release

if [ $# -eq 0 ]; then set -- cello; fi
exec build/release/app/voxmelt run "$@"
