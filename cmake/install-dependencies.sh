#!/usr/bin/env bash
# Installs the Debian packages that are missing; does nothing, and needs no network, when all are there.
#   install-dependencies.sh build|test
set -euo pipefail

packages=(cmake ninja-build g++ pkg-config libpng-dev libdeflate-dev libzstd-dev libxxhash-dev libfmt-dev
          libtomlplusplus-dev libcli11-dev nlohmann-json3-dev libtbb-dev libxsimd-dev libbenchmark-dev libsystemc-dev
          libboost-dev libjpeg-dev libwebp-dev libtiff-dev opencl-c-headers)
if [ "$(dpkg --print-architecture)" = amd64 ]; then packages+=(libembree-dev); fi
if [ "${1:-build}" = test ]; then
  packages+=(libgtest-dev libgmock-dev libopenvdb-dev libopenvdb-tools python3-openvdb clang clang-format clang-tidy doxygen python3 python3-numpy python3-pil pybind11-dev python3-dev python3-venv teem-apps assimp-utils strace valgrind verilator
             yosys z3 ocl-icd-libopencl1 pocl-opencl-icd)
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2> /dev/null | grep -q 'ok installed' || missing+=("$package")
done
mkdir -p "$(dirname "$0")/../build"
if [ ${#missing[@]} -eq 0 ]; then exit 0; fi

echo "installing: ${missing[*]}"
as_root=()
if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
export DEBIAN_FRONTEND=noninteractive
${as_root[@]+"${as_root[@]}"} apt-get update -qq
${as_root[@]+"${as_root[@]}"} apt-get install -y -qq --no-install-recommends "${missing[@]}" > /dev/null
