# SPDX-License-Identifier: Apache-2.0
# The rooms, in the order in which data flows, and who may include whom.
# CMake/CheckIncludes.cmake holds the sources to it.

set(myotet_rooms Core Segmentation LevelSet Repair Surface Quality Lattice Elasticity Dynamics Meshing
                 Cage MeshFiles Report Fibres Muscle Skeleton Activation Membrane Contraction Play)

# Rooms that lie in Simulation/, the others in Modules/.
set(myotet_simulation_rooms Fibres Muscle Skeleton Activation Membrane Contraction Play)

# <room>_may_include: rooms besides itself.
set(Core_may_include)
set(Segmentation_may_include Core)
set(LevelSet_may_include Core)
set(Repair_may_include Core LevelSet)
set(Surface_may_include Core)
set(Quality_may_include Core)
set(Lattice_may_include Core)
set(Elasticity_may_include Core)
set(Dynamics_may_include Core Elasticity)
set(Meshing_may_include Core LevelSet Lattice Quality Elasticity Dynamics)
set(Cage_may_include Core Surface Quality Lattice)
set(MeshFiles_may_include Core)
set(Report_may_include Core Quality MeshFiles)
set(Fibres_may_include Core Elasticity)
set(Muscle_may_include Core Elasticity)
set(Skeleton_may_include Core)
set(Activation_may_include Core Muscle Skeleton)
set(Membrane_may_include Core Surface Dynamics)
set(Contraction_may_include Core Segmentation LevelSet Repair Surface Quality Lattice Elasticity Dynamics
                            Meshing MeshFiles Fibres Muscle Skeleton Activation)
set(Play_may_include Core Repair Elasticity Dynamics Cage MeshFiles Fibres Muscle Contraction)

# Third-party headers: a pattern of the header's name, then the rooms whose
# .cpp files may include it. "Applications" is no room, but owns some.
set(myotet_owned_headers itk nifti dcmtk zlib openvdb yaml vtk hdf5 pugixml png tbb cholmod simbody ceres CLI spdlog nlohmann)
set(itk_pattern "^itk[A-Z]")
set(itk_owners Segmentation LevelSet)
set(nifti_pattern "^nifti")
set(nifti_owners Segmentation)
set(dcmtk_pattern "^dcmtk/")
set(dcmtk_owners Segmentation)
set(zlib_pattern "^zlib\\.h$")
set(zlib_owners Segmentation Report)
set(openvdb_pattern "^openvdb/")
set(openvdb_owners LevelSet)
set(yaml_pattern "^yaml-cpp/")
set(yaml_owners Repair)
set(vtk_pattern "^vtk[A-Z]")
set(vtk_owners MeshFiles Report)
set(hdf5_pattern "^hdf5\\.h$")
set(hdf5_owners MeshFiles)
set(pugixml_pattern "^pugixml\\.hpp$")
set(pugixml_owners MeshFiles Skeleton)
set(png_pattern "^png\\.h$")
set(png_owners Report)
set(tbb_pattern "^tbb/")
set(tbb_owners Core)
set(cholmod_pattern "^suitesparse/|^openblas")
set(cholmod_owners Dynamics)
set(simbody_pattern "^Simbody|^simbody|^SimTK")
set(simbody_owners Skeleton)
set(ceres_pattern "^ceres/")
set(ceres_owners Activation)
set(CLI_pattern "^CLI/")
set(CLI_owners Applications)
set(spdlog_pattern "^spdlog/")
set(spdlog_owners Applications)
set(nlohmann_pattern "^nlohmann/")
set(nlohmann_owners Segmentation Applications)

# Headers that any file may include: Eigen, the standard library (names
# without a dot and without a folder) and a few of POSIX.
set(myotet_free_headers "^Eigen/|^[a-z_0-9]+$|^(unistd|stdlib|fcntl)\\.h$|^sys/[a-z]+\\.h$")
