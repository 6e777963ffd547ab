# SPDX-License-Identifier: BSD-3-Clause
# compile_folders_whole(TARGET SOURCE...)
# The sources of a folder are compiled as one unit: each header is read once in it. So names are unique in a folder, those in
# anonymous namespaces, too. The preset dev compiles sources one by one, which shows whether each includes what it uses.
function(compile_folders_whole target)
  if(NOT SEAGLINT_WHOLE_FOLDERS)
    return()
  endif()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
  foreach(source IN LISTS ARGN)
    cmake_path(GET source PARENT_PATH folder)
    string(MAKE_C_IDENTIFIER ${folder} unit)
    set_source_files_properties(${source} PROPERTIES UNITY_GROUP ${unit})
  endforeach()
endfunction()

# The target of a stage by its folder; other names are targets themselves.
function(stage_target name result)
  string(REGEX REPLACE "^(sim|radar|classify)/" "seaglint_" target "${name}")
  string(REGEX REPLACE "^tools$" "seaglint_tools" target "${target}")
  set(${result} ${target} PARENT_SCOPE)
endfunction()

# add_stage(FOLDER [ROOMS ...] SOURCES ... [PUBLIC ...] [PRIVATE ...] [RUNS_ONCE])
# A folder is a stage is a static library `seaglint_<folder>`. ROOMS are its sub-folders with sources, from the first that may
# be included to the last. PUBLIC and PRIVATE are the libraries that its headers, or its sources alone, include: stages by
# folder, others by target. RUNS_ONCE: code that no loop of the simulation calls; optimising it further takes longer than it
# runs. Its tests are tests/FOLDER/*_test.cpp and tests/FOLDER/ROOM/*_test.cpp, one program per stage.
function(add_stage folder)
  cmake_parse_arguments(STAGE "RUNS_ONCE" "" "ROOMS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  stage_target(${folder} target)
  set(root ${CMAKE_SOURCE_DIR}/${folder})
  list(TRANSFORM STAGE_SOURCES PREPEND ${root}/)
  file(GLOB_RECURSE headers CONFIGURE_DEPENDS ${root}/*.h)
  add_library(${target} STATIC ${STAGE_SOURCES} ${headers})
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${CMAKE_SOURCE_DIR}> $<BUILD_INTERFACE:${CMAKE_BINARY_DIR}/generated>)
  target_link_libraries(${target} PRIVATE seaglint_flags)
  foreach(kind PUBLIC PRIVATE)
    foreach(library IN LISTS STAGE_${kind})
      stage_target(${library} linked)
      target_link_libraries(${target} ${kind} ${linked})
    endforeach()
    list(JOIN STAGE_${kind} " " links)
    set_property(GLOBAL APPEND PROPERTY SEAGLINT_LINKS "${folder} ${kind} ${links}")
  endforeach()
  if(STAGE_RUNS_ONCE AND CMAKE_BUILD_TYPE STREQUAL "Release")
    target_compile_options(${target} PRIVATE -O1)
  endif()
  compile_folders_whole(${target} ${STAGE_SOURCES})

  list(TRANSFORM STAGE_ROOMS PREPEND ${folder}/)
  set_property(GLOBAL APPEND PROPERTY SEAGLINT_ROOMS ${STAGE_ROOMS})
  set_property(GLOBAL APPEND PROPERTY SEAGLINT_STAGE_TARGETS ${target})
  set_property(GLOBAL APPEND PROPERTY SEAGLINT_STAGES ${folder})
endfunction()
