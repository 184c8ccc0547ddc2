#!/usr/bin/env bash
# Installs what is missing, builds the program that runs and draws, and melts the default scene.
# Extra arguments go to `voxmelt run`:  ./run.sh goblet --steps 500
set -euo pipefail
cd "$(dirname "$0")"

voxmelt=build/first/app/voxmelt
if [ ! -x $voxmelt ]; then
  echo "Building voxmelt takes some two minutes on two cores, once." >&2
  [ $# -gt 0 ] || echo "Then look at out/cello/contact_sheet.png." >&2
fi
command -v ffmpeg > /dev/null || echo "Without ffmpeg the film is WebP, not MP4: apt-get install ffmpeg" >&2
cmake/install-dependencies.sh build
cmake --preset first > build/configure.log || { cat build/configure.log; exit 1; }
case "$*" in *vdb*) targets="voxmelt voxmelt-vdb" ;; *) targets=voxmelt ;; esac  # OpenVDB compiles long
cmake --build --preset first --target $targets

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
exec $voxmelt run "$@"
