# SPDX-License-Identifier: BSD-3-Clause
# Files of HTML pages, compiled into the library of the tools (tools/page/html.h).
find_file(SEAGLINT_PLOTLY plotly.js PATHS /usr/share/python3-plotly NO_DEFAULT_PATH REQUIRED)
set(page_files
  page_template=${CMAKE_SOURCE_DIR}/tools/page/page.html
  page_style=${CMAKE_SOURCE_DIR}/tools/page/style.css
  page_script=${CMAKE_SOURCE_DIR}/tools/page/page.js
  report_template=${CMAKE_SOURCE_DIR}/tools/report/report.html
  benchmark_template=${CMAKE_SOURCE_DIR}/tools/report/benchmark.html
  report_script=${CMAKE_SOURCE_DIR}/tools/report/report.js
  hot_spots_template=${CMAKE_SOURCE_DIR}/tools/rcs/hot_spots.html
  hot_spots_script=${CMAKE_SOURCE_DIR}/tools/rcs/hot_spots.js
  comparison_template=${CMAKE_SOURCE_DIR}/tools/compare/comparison.html
  comparison_script=${CMAKE_SOURCE_DIR}/tools/compare/comparison.js)
list(TRANSFORM page_files REPLACE "^[a-z_]+=" "" OUTPUT_VARIABLE page_inputs)
find_program(SEAGLINT_ESBUILD esbuild REQUIRED)
set(plotly ${CMAKE_BINARY_DIR}/generated/plotly.min.js)
add_custom_command(OUTPUT ${plotly}
  COMMAND ${SEAGLINT_ESBUILD} ${SEAGLINT_PLOTLY} --minify --log-level=warning --outfile=${plotly}
  DEPENDS ${SEAGLINT_PLOTLY} COMMENT "Minifying plotly" VERBATIM)
set(embedded ${CMAKE_BINARY_DIR}/generated/page_files.cpp)
add_custom_command(OUTPUT ${embedded}
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tools/cmake/embed_files.py ${embedded}
          ${page_files} plotly_gzip=gzip:${plotly}
  DEPENDS ${page_inputs} ${plotly} ${CMAKE_SOURCE_DIR}/tools/cmake/embed_files.py
  COMMENT "Embedding files of HTML pages" VERBATIM)
target_sources(seaglint_tools PRIVATE ${embedded})
set_source_files_properties(${embedded} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
