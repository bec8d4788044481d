#!/usr/bin/env bash
# Installs what VoroCL needs on Debian or Ubuntu: the OpenCL loader, PoCL, OpenCV, Boost.Test, the command's libraries
# and Matplotlib for its plots. Does nothing where all is there.
set -euo pipefail

packages=(
  g++ cmake ninja-build
  ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd
  libopencv-dev libtiff-dev
  libcli11-dev libfmt-dev nlohmann-json3-dev libnanoflann-dev
  libboost-test-dev
  python3-matplotlib
)

missing=()
for package in "${packages[@]}"; do
  if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
    missing+=("$package")
  fi
done
[ ${#missing[@]} -eq 0 ] && exit 0

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup.sh: ${missing[*]} must be installed, and there is no sudo" >&2; exit 1; }
  as_root=(sudo)
fi
echo "Installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
