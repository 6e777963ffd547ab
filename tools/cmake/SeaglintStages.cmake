# SPDX-License-Identifier: BSD-3-Clause
# add_stage(FOLDER [ROOMS ...] [LIBRARIES ...])
# A folder is a stage is a static library `seaglint_<folder>`. It links every stage declared before it and keeps its third-party
# libraries to itself. ROOMS are its sub-folders from left to right: a file includes its own room or rooms to its left; a file
# beside the rooms comes after all of them. Its tests are tests/FOLDER/*_test.cpp and tests/FOLDER/*/*_test.cpp, one program
# per stage.
function(add_stage folder)
  cmake_parse_arguments(STAGE "" "" "ROOMS;LIBRARIES" ${ARGN})
  string(REPLACE "/" "_" name "${folder}")
  string(REGEX REPLACE "^(sim|radar|classify)_" "" name "${name}")
  set(target seaglint_${name})

  set(source_globs ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  set(header_globs ${CMAKE_SOURCE_DIR}/${folder}/*.h)
  foreach(room IN LISTS STAGE_ROOMS)
    list(APPEND source_globs ${CMAKE_SOURCE_DIR}/${folder}/${room}/*.cpp)
    list(APPEND header_globs ${CMAKE_SOURCE_DIR}/${folder}/${room}/*.h)
    set_property(GLOBAL APPEND PROPERTY SEAGLINT_ROOMS ${folder}/${room})
  endforeach()
  file(GLOB sources CONFIGURE_DEPENDS ${source_globs})
  list(FILTER sources EXCLUDE REGEX "/tools/main\\.cpp$")
  file(GLOB headers CONFIGURE_DEPENDS ${header_globs})
  get_property(upstream GLOBAL PROPERTY SEAGLINT_STAGE_TARGETS)

  if(sources)
    add_library(${target} STATIC ${sources} ${headers})
    target_include_directories(${target} PUBLIC ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/generated)
    target_link_libraries(${target} PUBLIC ${upstream} PRIVATE seaglint_flags ${STAGE_LIBRARIES})
    # Eigen and fmt are the two libraries whose types the public headers use.
    target_link_libraries(${target} PUBLIC Eigen3::Eigen fmt::fmt)
  else()
    add_library(${target} INTERFACE)
    target_include_directories(${target} INTERFACE ${CMAKE_SOURCE_DIR} ${CMAKE_BINARY_DIR}/generated)
    target_link_libraries(${target} INTERFACE ${upstream} Eigen3::Eigen fmt::fmt)
  endif()

  set_property(GLOBAL APPEND PROPERTY SEAGLINT_STAGE_TARGETS ${target})
  set_property(GLOBAL APPEND PROPERTY SEAGLINT_STAGES ${folder})
endfunction()
