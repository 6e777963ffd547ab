# SPDX-License-Identifier: BSD-3-Clause
# Files of HTML pages, compiled into the library of the tools (tools/page/page_files.h).
find_file(SEAGLINT_PLOTLY plotly.js PATHS /usr/share/python3-plotly NO_DEFAULT_PATH REQUIRED)
set(page_files ${CMAKE_SOURCE_DIR}/tools/page/style.css ${CMAKE_SOURCE_DIR}/tools/page/page.js ${CMAKE_SOURCE_DIR}/tools/report/report.js)
list(GET page_files 0 style)
list(GET page_files 1 script)
list(GET page_files 2 report)
set(embedded ${CMAKE_BINARY_DIR}/generated/page_files.cpp)
add_custom_command(OUTPUT ${embedded}
  COMMAND /usr/bin/python3 ${CMAKE_SOURCE_DIR}/tools/cmake/embed_files.py ${embedded}
          page_style=${style} page_script=${script} report_script=${report} plotly_gzip=gzip:${SEAGLINT_PLOTLY}
  DEPENDS ${page_files} ${SEAGLINT_PLOTLY} ${CMAKE_SOURCE_DIR}/tools/cmake/embed_files.py
  COMMENT "Embedding files of HTML pages" VERBATIM)
target_sources(seaglint_tools PRIVATE ${embedded})
set_source_files_properties(${embedded} PROPERTIES SKIP_PRECOMPILE_HEADERS ON)
