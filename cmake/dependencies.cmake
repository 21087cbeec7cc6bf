# Debian 12 packages; docs/building.md names them. Heavy ones stay behind the target that needs them.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)

# SuiteSparse 5 in Debian has no CMake package of its own.
find_path(CHOLMOD_INCLUDE cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
add_library(cholmod INTERFACE)
target_include_directories(cholmod SYSTEM INTERFACE ${CHOLMOD_INCLUDE})
target_link_libraries(cholmod INTERFACE ${CHOLMOD_LIBRARY})

find_path(MESHOPTIMIZER_INCLUDE meshoptimizer.h REQUIRED)
find_library(MESHOPTIMIZER_LIBRARY meshoptimizer REQUIRED)
add_library(meshoptimizer INTERFACE)
target_include_directories(meshoptimizer SYSTEM INTERFACE ${MESHOPTIMIZER_INCLUDE})
target_link_libraries(meshoptimizer INTERFACE ${MESHOPTIMIZER_LIBRARY})

find_path(DRACO_INCLUDE draco/compression/decode.h REQUIRED)
find_library(DRACO_LIBRARY draco REQUIRED)
add_library(draco INTERFACE)
add_library(draco::draco ALIAS draco)
target_include_directories(draco SYSTEM INTERFACE ${DRACO_INCLUDE})
target_link_libraries(draco INTERFACE ${DRACO_LIBRARY})

# Finds OpenGL ES and EGL when the program runs; their libraries are not needed to build.
find_path(EPOXY_INCLUDE epoxy/egl.h REQUIRED)
find_library(EPOXY_LIBRARY epoxy REQUIRED)
add_library(epoxy INTERFACE)
target_include_directories(epoxy SYSTEM INTERFACE ${EPOXY_INCLUDE})
target_link_libraries(epoxy INTERFACE ${EPOXY_LIBRARY})

find_package(PNG REQUIRED)
find_package(JPEG REQUIRED)

find_package(PkgConfig REQUIRED)
pkg_check_modules(cairo REQUIRED IMPORTED_TARGET cairo)
if(MIEN_VIDEO)
  pkg_check_modules(libav REQUIRED IMPORTED_TARGET libavformat libavcodec libavutil libswscale)
endif()

# Reads FBX. Its own CMake package states another version than it is.
if(MIEN_FBX)
  find_path(ASSIMP_INCLUDE assimp/scene.h)
  find_library(ASSIMP_LIBRARY assimp)
  if(ASSIMP_INCLUDE AND ASSIMP_LIBRARY)
    add_library(assimp INTERFACE)
    target_include_directories(assimp SYSTEM INTERFACE ${ASSIMP_INCLUDE})
    target_link_libraries(assimp INTERFACE ${ASSIMP_LIBRARY})
  else()
    message(STATUS "Assimp is not installed (libassimp-dev): FBX files are refused")
  endif()
endif()
