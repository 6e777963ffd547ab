# SPDX-License-Identifier: BSD-3-Clause
# precompile_headers(TARGET OWNER HEADER...)
# Headers that most sources of a target read are compiled once: by OWNER, from which targets with the same list take them.
# Sources still include what they use; the presets dev and tidy build without.
function(precompile_headers target owner)
  if(NOT SEAGLINT_PRECOMPILED_HEADERS)
    return()
  endif()
  if(target STREQUAL owner)
    target_precompile_headers(${target} PRIVATE ${ARGN})
  else()
    target_precompile_headers(${target} REUSE_FROM ${owner})
  endif()
endfunction()

set(SEAGLINT_COMMON_HEADERS
  <fmt/format.h> <algorithm> <array> <cmath> <complex> <cstdint> <filesystem> <functional> <map>
  <memory> <optional> <set> <span> <string> <string_view> <utility> <vector>)

# add_stage(FOLDER [ROOMS ...] [LIBRARIES ...])
# A folder is a stage is a static library `seaglint_<folder>`. It links every stage declared before it and keeps its third-party
# libraries to itself. ROOMS are its sub-folders with sources, from the first that may be included to the last. Its tests are
# tests/FOLDER/*_test.cpp and tests/FOLDER/ROOM/*_test.cpp, one program per stage.
function(add_stage folder)
  cmake_parse_arguments(STAGE "" "" "ROOMS;LIBRARIES" ${ARGN})
  string(REPLACE "/" "_" name "${folder}")
  string(REGEX REPLACE "^(sim|radar|classify)_" "" name "${name}")
  set(target seaglint_${name})

  set(patterns ${CMAKE_SOURCE_DIR}/${folder})
  foreach(room IN LISTS STAGE_ROOMS)
    if(NOT IS_DIRECTORY ${CMAKE_SOURCE_DIR}/${folder}/${room})
      message(FATAL_ERROR "${folder} has no room ${room}")
    endif()
    list(APPEND patterns ${CMAKE_SOURCE_DIR}/${folder}/${room})
    set_property(GLOBAL APPEND PROPERTY SEAGLINT_ROOMS ${folder}/${room})
  endforeach()
  list(TRANSFORM patterns APPEND "/*.h" OUTPUT_VARIABLE header_patterns)
  list(TRANSFORM patterns APPEND "/*.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  list(FILTER sources EXCLUDE REGEX "/(tools/main|classify/cnn/layers)\\.cpp$")  # of other targets
  file(GLOB headers CONFIGURE_DEPENDS ${header_patterns})
  get_property(upstream GLOBAL PROPERTY SEAGLINT_STAGE_TARGETS)

  set(tree $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/generated>)
  if(sources)
    add_library(${target} STATIC ${sources} ${headers})
    target_include_directories(${target} PUBLIC ${tree})
    target_link_libraries(${target} PUBLIC ${upstream} PRIVATE seaglint_flags ${STAGE_LIBRARIES})
    # Libraries whose types headers use: fmt, and Eigen in sim/cavity.
    target_link_libraries(${target} PUBLIC Eigen3::Eigen fmt::fmt)
    if(NOT folder STREQUAL "classify/cnn")  # libtorch has macros and flags of its own
      precompile_headers(${target} seaglint_core ${SEAGLINT_COMMON_HEADERS})
    endif()
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${tree})
    target_link_libraries(${target} INTERFACE ${upstream} Eigen3::Eigen fmt::fmt)
  endif()

  set_property(GLOBAL APPEND PROPERTY SEAGLINT_STAGE_TARGETS ${target})
  set_property(GLOBAL APPEND PROPERTY SEAGLINT_STAGES ${folder})
endfunction()
