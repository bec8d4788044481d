#!/usr/bin/env bash
# Installs what VoroCL needs on Debian or Ubuntu, and does nothing where all is there: setup.sh [GROUP]...
# The groups are build (the libraries and the command), test (their tests), check (what .ci/run checks with besides),
# drivers (what tools/checks/drivers.sh runs the tests on) and intel (what tools/checks/gpu_compilers.sh intel compiles with). Without any:
# build and test.
#   setup.sh gpu FOLDER    copies what tools/gpu_report.sh needs besides a compiler into FOLDER, some 10 MB, for a machine
#                          without a network whose C library is at least as new as this one's
set -euo pipefail
gpu_folder=
if [ "${1:-}" = gpu ]; then
  gpu_folder=$(realpath -m "${2:?"setup.sh gpu needs a folder"}")
  set -- core
fi
cd "$(dirname "$0")/.."
[ $# -gt 0 ] || set -- build test

as_root() {
  if [ "$(id -u)" -eq 0 ]; then
    "$@"
  elif command -v sudo >/dev/null; then
    sudo "$@"
  else
    echo "setup.sh: there is no sudo, and as another user than root it cannot run: $*" >&2
    exit 1
  fi
}

packages=()
for group in "$@"; do
  case $group in
  build)
    packages+=(g++ cmake ninja-build ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd
      libopencv-dev libavcodec-dev libavformat-dev libswscale-dev libtiff-dev zlib1g-dev libarchive-dev libgeotiff-dev libcli11-dev
      libfmt-dev nlohmann-json3-dev libnanoflann-dev
      python3-dev python3-venv)
    ;;
  core) packages+=(g++ ocl-icd-opencl-dev opencl-clhpp-headers libboost-test-dev) ;;
  test) packages+=(libboost-test-dev pkgconf groff-base python3-matplotlib) ;;
  check)
    # libclc is of the version of the distribution's clang, which a fresh system does not know yet.
    apt-cache show clang >/dev/null 2>&1 || as_root apt-get update -qq
    clang=$(apt-cache depends clang | sed -n 's/.*Depends: clang-\([0-9]*\)$/\1/p')
    packages+=(clang "libclang-rt-$clang-dev" "libclc-$clang-dev" "libclc-$clang" clang-format clang-tidy oclgrind valgrind doxygen python3-vtk9
      python3-numpy python3-zarr python3-gdal python3-pip libopenmpi-dev openmpi-bin procps abigail-tools xz-utils)
    ;;
  drivers)
    packages+=(pocl-opencl-icd python3-pip)
    ! grep -q '^VERSION_ID="13"' /etc/os-release || packages+=(mesa-opencl-icd)
    ;;
  intel) ;;
  *) echo "setup.sh: there is no group \"$group\", but build, test, check, drivers, intel and gpu FOLDER" >&2; exit 2 ;;
  esac
done

missing=()
for package in "${packages[@]}"; do
  if [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" != installed ]; then
    missing+=("$package")
  fi
done
if [ ${#missing[@]} -gt 0 ]; then
  echo "Installing ${missing[*]}"
  as_root apt-get update -qq
  as_root env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}"
fi

# Headers, OpenCL's loader and Boost.Test, of whose headers those alone that the tests include.
if [ -n "$gpu_folder" ]; then
  mkdir -p "$gpu_folder"/{include,lib/cmake/Boost}
  headers=$(grep -rhoE '#include <(boost|CL)/[^>]+>' include src tests/core tests/support
    grep -oE '<boost/[^>]+>' tests/CMakeLists.txt | sed 's/^/#include /')
  # shellcheck disable=SC2046 # names of headers, without blanks
  (cd /usr/include && cp --parents $(g++ -M -std=c++17 -DBOOST_TEST_DYN_LINK -x c++ - <<<"$headers" |
    grep -oE '/usr/include/(boost|CL)/[^ ]+' | sed 's|/usr/include/||' | sort -u) "$gpu_folder/include")
  libraries=$(dirname "$(ldconfig -p | grep -om1 '/.*/libOpenCL.so$')")
  cp -P "$libraries"/libOpenCL.so* "$libraries"/libboost_unit_test_framework.so* "$gpu_folder/lib"
  cat >"$gpu_folder/lib/cmake/Boost/BoostConfig.cmake" <<'END'
get_filename_component(folder "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
add_library(Boost::unit_test_framework SHARED IMPORTED)
set_target_properties(Boost::unit_test_framework PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "${folder}/include"
                      IMPORTED_LOCATION "${folder}/lib/libboost_unit_test_framework.so")
END
  git describe --always --dirty >"$gpu_folder/commit" 2>/dev/null || true
  du -sh "$gpu_folder"
fi

# ptxas, where no CUDA is installed: tools/checks/gpu_compilers.sh looks for it there.
ptxas=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl/ptxas
if [[ " $* " == *" check "* ]] && [ ! -e "$ptxas" ] && ! command -v ptxas >/dev/null; then
  python3 -m pip install --quiet --no-deps --target "$ptxas" nvidia-cuda-nvcc-cu12
fi

# Intel's compiler for GPUs, in a folder of its own: its packages would add a driver to the system.
ocloc=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl/ocloc
if [[ " $* " == *" intel "* ]] && [ ! -e "$ocloc" ] && ! command -v ocloc >/dev/null; then
  trap 'rm -rf "$ocloc.part"' EXIT
  mkdir -p "$ocloc.part"
  as_root apt-get update -qq
  (cd "$ocloc.part"
    apt-cache depends --recurse --important intel-opencl-icd |
      grep -E '^(intel-opencl-icd|lib(igc|igdfcl|igdgmm|opencl-clang|llvm|clang-cpp))' | sort -u | xargs apt-get download -qq -o APT::Sandbox::User=
    for package in *.deb; do dpkg -x "$package" . && rm "$package"; done)
  mv "$ocloc.part" "$ocloc"
fi

# Intel's runtime for CPUs, in a folder of its own where no other program sees it. Its own libOpenCL.so would take the
# place of the system's.
intel=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl/intel-opencl
if [[ " $* " == *" drivers "* ]] && [ ! -e "$intel" ]; then
  trap 'rm -rf "$intel.part"' EXIT
  python3 -m pip install --quiet --ignore-installed --prefix "$intel.part" intel-opencl-rt intel-cmplr-lib-rt
  rm -f "$intel.part"/lib/libOpenCL.so*
  mv "$intel.part" "$intel"
fi

# What the tests of the Python package need, as wheels: python/tests/run.sh installs them into a fresh environment.
if [[ " $* " == *" check "* ]]; then
  wheels=${XDG_CACHE_HOME:-$HOME/.cache}/vorocl/$(python3 -c "import sys; print(sys.implementation.cache_tag)")
  if ! cmp -s python/tests/requirements.txt "$wheels/requirements.txt"; then
    python3 -m pip download --quiet --only-binary :all: --dest "$wheels" --requirement python/tests/requirements.txt
    cp python/tests/requirements.txt "$wheels"
  fi
fi
