# What `cmake --install` and `cpack` leave: the programs, and the libraries as the CMake package
# weft; docs/embedding.md.
include(CMakePackageConfigHelpers)

get_property(WEFT_COMPONENTS GLOBAL PROPERTY WEFT_COMPONENTS)
get_property(WEFT_COMPONENT_LINKS GLOBAL PROPERTY WEFT_COMPONENT_LINKS)
set(folder ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
configure_package_config_file(cmake/weft-config.cmake.in weft-config.cmake
                              INSTALL_DESTINATION ${folder})
write_basic_package_version_file(weft-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/weft-config.cmake
              ${PROJECT_BINARY_DIR}/weft-config-version.cmake
        DESTINATION ${folder} COMPONENT development)
install(EXPORT weft-targets NAMESPACE weft:: DESTINATION ${folder} COMPONENT development)
install(FILES ${WEFT_GENERATED_HEADERS}/weft/core/Version.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft/core COMPONENT development)
# The licence of ours, and of the libraries whose code comes into our programs from headers.
foreach(package programs development)
  set(name $<IF:$<STREQUAL:${package},programs>,weft,libweft-dev>)
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
          RENAME copyright COMPONENT ${package})
  install(FILES THIRD-PARTY-NOTICES.md CHANGELOG.md
          DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${package})
endforeach()

# cpack: weft_VERSION_ARCHITECTURE.deb with the programs, libweft-dev_... with what programs that
# use Weft are built from.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "The Weft authors <weft@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME weft)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "libegl1, libgl1-mesa-dri")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "Measured materials for real-time rendering: programs\n \
Fits, evaluates and renders bidirectional texture functions.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libweft-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# What its static libraries and headers name; scripts/install-packages.sh has the same.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libexpected-dev, libfmt-dev, libglm-dev, libimath-dev, libhwy-dev, libepoxy-dev, libegl-dev, \
libopengl-dev, pkg-config")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "libopenexr-dev, libturbojpeg0-dev, libjpeg62-turbo-dev, libpng-dev, libzip-dev, \
libutf8proc-dev, nlohmann-json3-dev, libtbb-dev, libdraco-dev, libmeshoptimizer-dev, \
libeigen3-dev, libembree-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "Measured materials for real-time rendering: C++ libraries\n \
Static libraries, headers and the CMake package weft. All components but core, shaders, chunks and \
scenegraph need what is recommended.")
include(CPack)
