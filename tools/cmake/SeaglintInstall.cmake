# SPDX-License-Identifier: BSD-3-Clause
# cmake --install and cpack: the program with its data (package seaglint); libraries, headers and the CMake package
# `seaglint` (seaglint-dev).
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(SEAGLINT_DATA ${CMAKE_INSTALL_DATADIR}/seaglint)
install(TARGETS seaglint RUNTIME COMPONENT program)
install(TARGETS seaglint_layers LIBRARY DESTINATION lib/seaglint COMPONENT program)  # the run path of the program
install(DIRECTORY assets scenarios DESTINATION ${SEAGLINT_DATA} COMPONENT program PATTERN pictures EXCLUDE)
install(DIRECTORY tests/reference/rcs DESTINATION ${SEAGLINT_DATA}/reference COMPONENT program)
install(FILES README.md CONVENTIONS.md CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES tools/install/copyright DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)
install(FILES tools/install/seaglint.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT program)
install(FILES tools/install/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
        RENAME seaglint COMPONENT program)


# The manual, except with sanitizers, whose program would make it.
if(NOT SEAGLINT_SANITIZE)
  file(GLOB_RECURSE chapters CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/*.md)
  list(FILTER chapters EXCLUDE REGEX "^${CMAKE_BINARY_DIR}/|/build/")
  file(GLOB modules CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/tools/python/manual_*.py)
  set(manual ${CMAKE_BINARY_DIR}/manual)
  add_custom_command(OUTPUT ${manual}/index.html
    COMMAND ${CMAKE_SOURCE_DIR}/tools/manual --program $<TARGET_FILE:seaglint> -o ${manual}
    DEPENDS seaglint ${CMAKE_SOURCE_DIR}/tools/manual ${CMAKE_SOURCE_DIR}/tools/page/style.css ${modules} ${chapters} COMMENT "Building the manual" VERBATIM)
  add_custom_target(seaglint_manual ALL DEPENDS ${manual}/index.html)
  install(DIRECTORY ${manual}/ DESTINATION ${CMAKE_INSTALL_DOCDIR}/html COMPONENT program)
endif()

get_property(stages GLOBAL PROPERTY SEAGLINT_STAGES)
get_property(stage_targets GLOBAL PROPERTY SEAGLINT_STAGE_TARGETS)
set(headers ${CMAKE_INSTALL_INCLUDEDIR}/seaglint)
install(TARGETS ${stage_targets} seaglint_flags EXPORT seaglintTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}/seaglint COMPONENT development
        INCLUDES DESTINATION ${headers})
foreach(stage IN LISTS stages)
  install(DIRECTORY ${stage}/ DESTINATION ${headers}/${stage} COMPONENT development FILES_MATCHING PATTERN *.h
          PATTERN bindings EXCLUDE)
endforeach()
install(FILES ${CMAKE_BINARY_DIR}/generated/seaglint_version.h DESTINATION ${headers} COMPONENT development)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/seaglint)
install(EXPORT seaglintTargets NAMESPACE seaglint:: DESTINATION ${package} COMPONENT development)
configure_package_config_file(tools/cmake/seaglintConfig.cmake.in ${CMAKE_BINARY_DIR}/generated/seaglintConfig.cmake
                              INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/generated/seaglintConfigVersion.cmake COMPATIBILITY ExactVersion)
install(FILES ${CMAKE_BINARY_DIR}/generated/seaglintConfig.cmake ${CMAKE_BINARY_DIR}/generated/seaglintConfigVersion.cmake
              tools/cmake/SeaglintDependencies.cmake
        DESTINATION ${package} COMPONENT development)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "the seaglint authors")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME seaglint)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS gnuplot-nox)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-h5py, python3-pandas, python3-tables")  # of the Python package
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME seaglint-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
# Packages of tools/packages.txt that SeaglintDependencies.cmake finds.
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "seaglint (= ${PROJECT_VERSION}), libembree-dev, libtbb-dev, libopenmesh-dev, libtinygltf-dev, libeigen3-dev, libboost-dev, libfftw3-dev, libyaml-cpp-dev, libxgboost-dev, libhdf5-dev, libssl-dev, libzip-dev, libcli11-dev, libfmt-dev, libpng-dev, nlohmann-json3-dev, zlib1g-dev, pkg-config")
include(CPack)
