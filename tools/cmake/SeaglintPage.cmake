# SPDX-License-Identifier: BSD-3-Clause
# Files of HTML pages, compiled into the library of the tools (tools/page/html.h).
find_file(SEAGLINT_PLOTLY plotly.js PATHS /usr/share/python3-plotly NO_DEFAULT_PATH REQUIRED)
set(style ${CMAKE_SOURCE_DIR}/tools/page/style.css)
set(script ${CMAKE_SOURCE_DIR}/tools/page/page.js)
set(report ${CMAKE_SOURCE_DIR}/tools/report/report.js)
set(hot_spots ${CMAKE_SOURCE_DIR}/tools/report/hot_spots.js)
find_program(SEAGLINT_ESBUILD esbuild REQUIRED)
set(plotly ${CMAKE_BINARY_DIR}/generated/plotly.min.js)
add_custom_command(OUTPUT ${plotly}
  COMMAND ${SEAGLINT_ESBUILD} ${SEAGLINT_PLOTLY} --minify --log-level=warning --outfile=${plotly}
  DEPENDS ${SEAGLINT_PLOTLY} COMMENT "Minifying plotly" VERBATIM)
set(embedded ${CMAKE_BINARY_DIR}/generated/page_files.cpp)
add_custom_command(OUTPUT ${embedded}
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tools/cmake/embed_files.py ${embedded}
          page_style=${style} page_script=${script} report_script=${report} hot_spots_script=${hot_spots} plotly_gzip=gzip:${plotly}
  DEPENDS ${style} ${script} ${report} ${hot_spots} ${plotly} ${CMAKE_SOURCE_DIR}/tools/cmake/embed_files.py
  COMMENT "Embedding files of HTML pages" VERBATIM)
target_sources(seaglint_tools PRIVATE ${embedded})
set_source_files_properties(${embedded} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
