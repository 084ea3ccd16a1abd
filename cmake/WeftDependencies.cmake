# Everything comes from Debian 12; scripts/install-packages.sh installs it.

find_package(PkgConfig REQUIRED)
find_package(Threads REQUIRED)
find_package(OpenGL REQUIRED COMPONENTS OpenGL EGL)
pkg_check_modules(epoxy REQUIRED IMPORTED_TARGET epoxy)
pkg_check_modules(libzip REQUIRED IMPORTED_TARGET libzip) # its CMake config names programs that are not installed
pkg_check_modules(libutf8proc REQUIRED IMPORTED_TARGET libutf8proc)
pkg_check_modules(highway REQUIRED IMPORTED_TARGET libhwy)
find_package(tl-expected REQUIRED)
find_package(fmt REQUIRED)
find_package(glm REQUIRED)
find_package(OpenEXR REQUIRED)
find_package(libjpeg-turbo REQUIRED)
find_package(JPEG REQUIRED)
find_package(PNG REQUIRED)
find_package(TinyGLTF REQUIRED)
find_package(draco QUIET) # without these two, glTF files that are packed with them are refused
find_package(meshoptimizer QUIET)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(Eigen3 REQUIRED NO_MODULE)
find_package(Ceres REQUIRED)
find_package(TBB REQUIRED)
set(MPI_CXX_SKIP_MPICXX TRUE) # the deprecated C++ interface
find_package(MPI COMPONENTS CXX) # without it weft-fit runs in one process
find_package(embree 3 REQUIRED)
find_package(glfw3 QUIET) # without it and OpenSceneGraph their embedding samples are not built
find_package(OpenSceneGraph 3.6 QUIET COMPONENTS osgViewer osgGA osgText osgDB osgUtil)
if(OPENSCENEGRAPH_FOUND)
  add_library(weft_openscenegraph INTERFACE)
  target_include_directories(weft_openscenegraph SYSTEM INTERFACE ${OPENSCENEGRAPH_INCLUDE_DIRS})
  target_link_libraries(weft_openscenegraph INTERFACE ${OPENSCENEGRAPH_LIBRARIES})
endif()
find_package(GTest REQUIRED)
find_package(benchmark REQUIRED)
