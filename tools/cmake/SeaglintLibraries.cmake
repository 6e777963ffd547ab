# SPDX-License-Identifier: BSD-3-Clause
# Third-party libraries and the flags of the project's own code.
include(SeaglintDependencies)
find_package(Torch REQUIRED)
find_package(GTest CONFIG REQUIRED)
find_package(benchmark CONFIG REQUIRED)

# Torch exports its flags as variables; a target keeps them inside classify/cnn.
add_library(SeaglintTorch INTERFACE)
target_link_libraries(SeaglintTorch INTERFACE ${TORCH_LIBRARIES})
target_include_directories(SeaglintTorch SYSTEM INTERFACE ${TORCH_INCLUDE_DIRS})

# Flags of the project's own code. Phase is formed in double: no fast-math, no contraction, so that bits agree across builds.
add_library(seaglint_flags INTERFACE)
target_compile_options(seaglint_flags INTERFACE -ffp-contract=off -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion)
if(SEAGLINT_WHOLE_FOLDERS)  # a local hides no constant of its own source, and a source's types are its own
  target_compile_options(seaglint_flags INTERFACE -Wno-subobject-linkage)
else()
  target_compile_options(seaglint_flags INTERFACE -Wshadow)
endif()
# Complex products and quotients do not check for infinities, which would double their cost; finite products keep
# their bits, quotients theirs to rounding. clang has the option only from 18 on, and clang-tidy reads the flags as clang.
include(CheckCXXCompilerFlag)
check_cxx_compiler_flag(-fcx-fortran-rules SEAGLINT_FINITE_PRODUCTS)
if(SEAGLINT_FINITE_PRODUCTS AND NOT CMAKE_CXX_CLANG_TIDY)
  target_compile_options(seaglint_flags INTERFACE -fcx-fortran-rules)
endif()
if(SEAGLINT_WARNINGS_AS_ERRORS)
  target_compile_options(seaglint_flags INTERFACE -Werror)
endif()
if(SEAGLINT_NATIVE)
  target_compile_options(seaglint_flags INTERFACE -march=native)
endif()
if(SEAGLINT_SANITIZE)
  target_compile_options(seaglint_flags INTERFACE -fsanitize=${SEAGLINT_SANITIZE} -fno-omit-frame-pointer)
  # gcc's sanitizers open libraries in place of the program, whose run path only counts for them as a DT_RPATH.
  target_link_options(seaglint_flags INTERFACE -fsanitize=${SEAGLINT_SANITIZE} -Wl,--disable-new-dtags)
endif()
if(SEAGLINT_FUZZ)
  target_compile_options(seaglint_flags INTERFACE -fsanitize=fuzzer-no-link -fno-sanitize-recover=all)
endif()
