#!/usr/bin/env bash
# Installs what is missing, builds, melts the default scene and says where the pictures are.
# Extra arguments go to `voxmelt run`:  ./run.sh goblet --steps 500
set -euo pipefail
cd "$(dirname "$0")"

cmake/install-dependencies.sh build
cmake --preset release -DVOXMELT_TESTS=OFF > build/configure.log || { cat build/configure.log; exit 1; }
cmake --build --preset release

# Options alone mean the default scene. All but two of them have a value.
scene=cello before=
for word in "$@"; do
  case "$word" in
    --resume* | -h | --help*) scene= ;;
    -*) ;;
    *) case "$before" in -*=* | --quiet | "" | [!-]*) scene= ;; esac ;;
  esac
  before=$word
done
if [ -n "$scene" ]; then set -- "$scene" "$@"; fi
exec build/release/app/voxmelt run "$@"
