#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Builds Myotet, makes a phantom of an arm, meshes it and makes its muscles contract; then
# a moving skeleton lifts a dumbbell with it; a hollow ball is pressed.
# May be run again.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source CMake/install-packages.sh

install_packages
cmake --preset release
cmake --build --preset release --target myotet
myotet=build/release/bin/myotet
"$myotet" phantom arm -o results/arm.nii.gz
"$myotet" mesh results/arm.nii.gz -o results/arm
"$myotet" contract Data/scenes/isometric.yaml -o results/isometric
"$myotet" activate Data/arm/arm.osim Data/arm/curl.yaml --hold shoulder_flexion \
  -o results/activations
"$myotet" contract Data/scenes/curl.yaml -o results/curl
"$myotet" phantom shell -o results/shell.nii.gz
"$myotet" press results/shell.nii.gz --tool Data/tools/press_shell.yaml --levels 1 \
  -o results/press

cat <<END

Done. The scan of the arm phantom is results/arm.nii.gz, with the names of its
tissues in a table beside it. Its meshes are in the folder results/arm:
  <label>_<name>.vtu   the tissue in tetrahedra, for simulation and ParaView
  <label>_<name>.stl   its surface, for 3D Slicer, MeshLab or Blender
  report.html          all of it on one page, turned and cut open in 3D: open it in a
                       browser
  report.json          what each mesh is worth
Its biceps and triceps, which contract and relax, are in results/isometric:
  report.html                a 3D view over time, frames and curves on one page
  pictures/contraction.png   the whole of it on one sheet
  contraction.pvd            each moment, for ParaView
  history.csv                forces, lengths, volumes
The activations with which it lifts a dumbbell are in results/activations
(activation.png, activation.sto), the biceps that does so in results/curl.
A hollow ball that is pressed and comes back is in results/press (report.html).
To look at the meshes: paraview results/arm/*.vtu   (then press Apply)
To mesh your own scan: $myotet mesh SCAN.nii.gz -o FOLDER
END
