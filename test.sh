#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds everything and runs every test. May be run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source CMake/install-packages.sh

install_packages with_browser
cmake --preset release
cmake --build --preset release
ctest --preset release --no-tests=error
