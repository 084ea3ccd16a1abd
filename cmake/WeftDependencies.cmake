# Everything comes from Debian 12; scripts/install-packages.sh installs it. What only programs,
# tests, benchmarks or samples need is asked for where these are built.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET GLOBAL epoxy)
# Its CMake config names programs that are not installed.
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET GLOBAL libzip)
pkg_check_modules(libutf8proc REQUIRED IMPORTED_TARGET GLOBAL libutf8proc)
pkg_check_modules(highway REQUIRED IMPORTED_TARGET GLOBAL libhwy)
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(libjpeg-turbo REQUIRED)
find_package(JPEG REQUIRED)
find_package(PNG REQUIRED)
# Only the header: TinyGltf.cpp compiles it into a namespace of its own.
find_path(WEFT_TINYGLTF_HEADERS tiny_gltf.h REQUIRED)
# Without these two, glTF files that are packed with them are refused.
find_package(draco QUIET)
find_package(meshoptimizer QUIET)
find_package(nlohmann_json REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(embree 3 REQUIRED)
if(WEFT_BUILD_PROGRAMS OR WEFT_BUILD_BENCHMARKS)
  find_package(CLI11 REQUIRED)
endif()
if(WEFT_BUILD_PROGRAMS)
  find_package(Python3 QUIET COMPONENTS Interpreter) # without it there are no man pages
  set(MPI_CXX_SKIP_MPICXX TRUE) # the deprecated C++ interface
  find_package(MPI COMPONENTS CXX) # without it weft-fit runs in one process
endif()
if(WEFT_BUILD_TESTS OR WEFT_BUILD_BENCHMARKS)
  find_package(GTest REQUIRED)
  find_package(Ceres REQUIRED) # solvers are compared with it
endif()
if(WEFT_BUILD_BENCHMARKS)
  find_package(benchmark REQUIRED)
endif()
if(WEFT_BUILD_PROGRAMS)
  # Without these two there is no weft-view.
  find_package(glfw3 QUIET)
  pkg_check_modules(imgui QUIET IMPORTED_TARGET GLOBAL imgui)
endif()
if(WEFT_BUILD_SAMPLES OR WEFT_BUILD_BENCHMARKS)
  # Without these two, the samples that embed Weft in their windows are not built.
  find_package(glfw3 QUIET)
  find_package(OpenSceneGraph 3.6 QUIET COMPONENTS osgViewer osgGA osgText osgDB osgUtil)
endif()
if(OPENSCENEGRAPH_FOUND)
  add_library(weft_openscenegraph INTERFACE)
  target_include_directories(weft_openscenegraph SYSTEM INTERFACE ${OPENSCENEGRAPH_INCLUDE_DIRS})
  target_link_libraries(weft_openscenegraph INTERFACE ${OPENSCENEGRAPH_LIBRARIES})
endif()
