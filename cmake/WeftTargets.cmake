# How every library, program and test of Weft is declared.

add_library(weft_options INTERFACE)
target_compile_options(weft_options INTERFACE -Wall -Wextra -Wconversion -Wshadow)
# Broken contracts name their file from the root of the source, wherever that was.
target_compile_options(weft_options INTERFACE -fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
if(CMAKE_UNITY_BUILD AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # It takes the files of a unit for headers.
  target_compile_options(weft_options INTERFACE -Wno-subobject-linkage)
endif()
if(WEFT_WERROR)
  target_compile_options(weft_options INTERFACE -Werror)
endif()
if(CMAKE_CXX_COMPILER_ID STREQUAL Clang)
  # As GCC does: products and sums are joined across statements, so that both find the same fits.
  target_compile_options(weft_options INTERFACE -ffp-contract=fast)
  # GCC's -Wconversion leaves out signs in C++.
  target_compile_options(weft_options INTERFACE -Wno-sign-conversion)
endif()
if(WEFT_SANITIZE)
  set(WEFT_SANITIZERS
      -fsanitize=address,undefined -fno-sanitize-recover=undefined -fno-omit-frame-pointer)
  target_compile_definitions(weft_options INTERFACE WEFT_SANITIZE)
elseif(WEFT_SANITIZE_THREADS)
  set(WEFT_SANITIZERS -fsanitize=thread)
endif()
if(WEFT_SANITIZERS)
  # GCC 12 sees uninitialized values, and strings beyond their ends, in the sanitizers' own code
  # paths; other builds still warn of them.
  target_compile_options(weft_options INTERFACE ${WEFT_SANITIZERS}
    -Wno-maybe-uninitialized -Wno-array-bounds -Wno-stringop-overflow)
  target_link_options(weft_options INTERFACE ${WEFT_SANITIZERS})
endif()
# Programs and tests call what is fast, and are compiled a third sooner where they are not made so;
# with sanitizers, whose checks fill every line, in half the time.
if(WEFT_SANITIZERS)
  set(WEFT_LIGHT_OPTIMISATION -O0)
else()
  set(WEFT_LIGHT_OPTIMISATION $<$<CONFIG:Release>:-O1>)
endif()

# weft_compile_alone(SOURCES...)
# Files that no other may share a unit with where files are compiled together (CMAKE_UNITY_BUILD).
function(weft_compile_alone)
  set_source_files_properties(${ARGN} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# Headers that are made here: <build>/include/weft.
set(WEFT_GENERATED_HEADERS ${PROJECT_BINARY_DIR}/include)
configure_file(${PROJECT_SOURCE_DIR}/cmake/Version.h.in
               ${WEFT_GENERATED_HEADERS}/weft/core/Version.h @ONLY)

# weft_component_header(NAME)
# weft/NAME.h, which includes every public header of the library.
function(weft_component_header name)
  file(GLOB headers CONFIGURE_DEPENDS RELATIVE ${CMAKE_CURRENT_SOURCE_DIR}/include
       ${CMAKE_CURRENT_SOURCE_DIR}/include/weft/${name}/*.h)
  list(FILTER headers EXCLUDE REGEX "-inl\\.h$")
  list(TRANSFORM headers REPLACE "(.+)" "#include \"\\1\"\n")
  list(JOIN headers "" includes)
  file(CONFIGURE OUTPUT ${WEFT_GENERATED_HEADERS}/weft/${name}.h @ONLY CONTENT
"#pragma once

/// Every public header of weft::${name}.
${includes}")
  if(WEFT_INSTALL)
    install(FILES ${WEFT_GENERATED_HEADERS}/weft/${name}.h
            DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft COMPONENT development)
  endif()
endfunction()

# weft_install_library(NAME libraries...)
# The library weft::NAME, which links these, and its headers become a component of the package weft.
function(weft_install_library name)
  set_target_properties(weft_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS weft_${name} EXPORT weft-targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(DIRECTORY include/weft/${name}
          DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft COMPONENT development)
  set_property(GLOBAL APPEND PROPERTY WEFT_COMPONENTS ${name})
  list(JOIN ARGN " " links)
  set_property(GLOBAL APPEND_STRING PROPERTY WEFT_COMPONENT_LINKS
               "set(weft_${name}_links ${links})\n")
endfunction()

# weft_library(NAME [INTERNAL] [USES libraries...] [PRIVATE libraries...])
# The library weft::NAME from src/NAME, or from src where a folder holds one library. INTERNAL: not
# installed.
function(weft_library name)
  cmake_parse_arguments(ARG "INTERNAL" "" "USES;PRIVATE" ${ARGN})
  set(folder ${CMAKE_CURRENT_SOURCE_DIR}/src)
  if(IS_DIRECTORY ${folder}/${name})
    set(folder ${folder}/${name})
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${folder}/*.cpp)
  add_library(weft_${name} STATIC ${sources})
  set_target_properties(weft_${name} PROPERTIES LINKER_LANGUAGE CXX)
  add_library(weft::${name} ALIAS weft_${name})
  target_compile_features(weft_${name} PUBLIC cxx_std_20)
  target_include_directories(weft_${name} PRIVATE ${folder} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>
    $<BUILD_INTERFACE:${WEFT_GENERATED_HEADERS}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)
  target_link_libraries(weft_${name} PUBLIC ${ARG_USES}
                        PRIVATE ${ARG_PRIVATE} $<BUILD_INTERFACE:weft_options>)
  if(NOT ARG_INTERNAL)
    weft_component_header(${name})
    if(WEFT_INSTALL)
      weft_install_library(${name} ${ARG_USES} ${ARG_PRIVATE})
    endif()
  endif()
endfunction()

# weft_command_page(NAME)
# The man page of a program, made from its --help, and what completes its options in bash.
function(weft_command_page name)
  set(completions ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${PROJECT_SOURCE_DIR}/programs/completion.bash RENAME ${name}
          DESTINATION ${completions} COMPONENT programs)
  if(NOT Python3_FOUND)
    return()
  endif()
  set(script ${PROJECT_SOURCE_DIR}/scripts/command-page.py)
  set(page ${PROJECT_BINARY_DIR}/man/${name}.1)
  add_custom_command(OUTPUT ${page}.gz
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PROJECT_BINARY_DIR}/man
    COMMAND Python3::Interpreter ${script} man $<TARGET_FILE:${name}> > ${page}
    COMMAND gzip -9nf ${page}
    DEPENDS ${name} ${script} VERBATIM)
  add_custom_target(${name}-page ALL DEPENDS ${page}.gz)
  install(FILES ${page}.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT programs)
endfunction()

# weft_program(NAME SOURCE libraries...)
# Installed where it is named weft-something: the others are examples.
function(weft_program name source)
  add_executable(${name} ${source})
  target_link_libraries(${name} PRIVATE ${ARGN} weft_options)
  target_compile_options(${name} PRIVATE ${WEFT_LIGHT_OPTIMISATION})
  if(NOT TARGET weft_program_headers)
    # Compiled once for all: the option parser takes longer than most programs. A program, too,
    # because the code of a library is placed by other flags.
    file(WRITE ${PROJECT_BINARY_DIR}/none.cpp "int main() {}\n")
    add_executable(weft_program_headers EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/none.cpp)
    target_link_libraries(weft_program_headers PRIVATE weft::tool weft_options)
    target_compile_options(weft_program_headers PRIVATE ${WEFT_LIGHT_OPTIMISATION})
    target_precompile_headers(weft_program_headers PRIVATE
      <filesystem> <functional> <fmt/format.h> <CLI/CLI.hpp> <nlohmann/json.hpp>)
  endif()
  if(name MATCHES "^weft-")
    target_precompile_headers(${name} REUSE_FROM weft_program_headers)
  endif()
  if(WEFT_INSTALL AND name MATCHES "^weft-")
    install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT programs)
    if(NOT WEFT_SANITIZERS)
      weft_command_page(${name})
    endif()
  endif()
endfunction()

# What the tests include most, compiled once for all of them.
function(weft_test_headers)
  file(WRITE ${PROJECT_BINARY_DIR}/none.cpp "int main() {}\n")
  add_executable(weft_test_headers EXCLUDE_FROM_ALL ${PROJECT_BINARY_DIR}/none.cpp)
  target_link_libraries(weft_test_headers PRIVATE GTest::gtest GTest::gmock weft_options)
  target_compile_options(weft_test_headers PRIVATE ${WEFT_LIGHT_OPTIMISATION})
  target_precompile_headers(weft_test_headers PRIVATE
    <gmock/gmock.h> <filesystem> <fstream> <functional> <map>)
endfunction()

# weft_test(NAME FOLDER LABEL libraries...)
# A GoogleTest program from FOLDER/*.cpp, every test of it known to ctest, under a label.
function(weft_test name folder label)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cpp)
  add_executable(${name} ${sources})
  target_link_libraries(${name} PRIVATE ${ARGN} weft_test_support weft_test_main GTest::gmock
                        weft_options)
  target_compile_options(${name} PRIVATE ${WEFT_LIGHT_OPTIMISATION})
  target_precompile_headers(${name} REUSE_FROM weft_test_headers)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES
    TIMEOUT 300 LABELS ${label} ENVIRONMENT LIBGL_ALWAYS_SOFTWARE=true)
endfunction()

# weft_benchmark(NAME SOURCES SOURCE... USES libraries...)
# Built by the target benchmarks, not with the rest.
function(weft_benchmark name)
  cmake_parse_arguments(ARG "" "" "SOURCES;USES" ${ARGN})
  add_executable(${name} EXCLUDE_FROM_ALL ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE ${ARG_USES} weft_options)
  if(NOT TARGET benchmarks)
    add_custom_target(benchmarks)
  endif()
  add_dependencies(benchmarks ${name})
endfunction()
