#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds Myotet, makes a phantom of an arm and meshes it. May be run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source CMake/install-packages.sh

install_packages
cmake --preset release
cmake --build --preset release --target myotet
myotet=build/release/bin/myotet
"$myotet" phantom arm -o results/arm.nii.gz
"$myotet" mesh results/arm.nii.gz -o results/arm

cat <<END

Done. The scan of the arm phantom is results/arm.nii.gz, with the names of its
tissues in a table beside it. Its meshes are in the folder results/arm:
  <label>_<name>.vtu   the tissue in tetrahedra, for simulation and ParaView
  <label>_<name>.stl   its surface, for 3D Slicer, MeshLab or Blender
  report.json          what each mesh is worth
To look at them: paraview results/arm/*.vtu   (then press Apply)
To mesh your own scan: $myotet mesh SCAN.nii.gz -o FOLDER
END
