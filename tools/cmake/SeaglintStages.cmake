# SPDX-License-Identifier: BSD-3-Clause
# add_stage(FOLDER [LIBRARIES ...])
# A folder is a stage is a static library `seaglint_<folder>`. It links every stage declared before it and keeps its third-party
# libraries to itself. Its tests are tests/FOLDER/*_test.cpp, one program per stage.
function(add_stage folder)
  cmake_parse_arguments(STAGE "" "" "LIBRARIES" ${ARGN})
  string(REPLACE "/" "_" name "${folder}")
  string(REGEX REPLACE "^(sim|radar|classify)_" "" name "${name}")
  set(target seaglint_${name})

  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.cpp)
  list(FILTER sources EXCLUDE REGEX "/tools/main\\.cpp$")
  file(GLOB headers CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${folder}/*.h)
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
