# SPDX-License-Identifier: Apache-2.0
# Sourced by demo.sh and test.sh. Installs the Debian packages that a build
# needs; does nothing, and asks for no rights, when all of them are there.
# Node.js, npm and Chromium may come from elsewhere: only those that are no
# commands are installed. npm fetches the packages of the pages' 3D view.

myotet_packages=(
  g++ cmake ninja-build ccache
  libeigen3-dev libtbb-dev zlib1g-dev
  libinsighttoolkit5-dev libnifti2-dev libdcmtk-dev
  libopenvdb-dev libboost-iostreams-dev libblosc-dev
  libyaml-cpp-dev
  libsuitesparse-dev libopenblas-dev
  libvtk9-dev libhdf5-dev libpugixml-dev
  libpng-dev
  libsimbody-dev libceres-dev
  libcli11-dev libspdlog-dev nlohmann-json3-dev
  libgtest-dev libgmock-dev libbenchmark-dev
)

# install_packages [with_browser]: Chromium is for tests alone.
install_packages() {
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    echo "This script installs Debian packages, but apt-get is not here. Install what" >&2
    echo "corresponds to these, then build as README.md says: ${myotet_packages[*]}" >&2
    return 1
  fi
  local package missing=() as_root=()
  for package in "${myotet_packages[@]}"; do
    dpkg-query -W -f='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      missing+=("$package")
  done
  command -v node >/dev/null || missing+=(nodejs)
  command -v npm >/dev/null || missing+=(npm)
  if [[ "${1-}" == with_browser ]]; then
    command -v chromium >/dev/null || missing+=(chromium)
  fi
  if ((${#missing[@]} == 0)); then return 0; fi

  echo "Installing ${missing[*]}"
  if (($(id -u) != 0)); then
    if ! command -v sudo >/dev/null; then
      echo "Run this script as root, or install sudo: packages have to be installed." >&2
      return 1
    fi
    as_root=(sudo)
  fi
  local install=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive
    apt-get install --yes --quiet --no-install-recommends "${missing[@]}")
  # The lists of a fresh machine are empty or old: then fetch them and try again.
  if ! apt-cache show "${missing[@]}" >/dev/null 2>&1 || ! "${install[@]}"; then
    "${as_root[@]}" apt-get update --quiet && "${install[@]}"
  fi
}
