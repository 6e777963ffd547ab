// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Files that HTML pages contain, embedded when the program is built (tools/cmake/embed_files.py).

#include <string_view>

namespace seaglint {

std::string_view page_style();        // style.css
std::string_view page_script();       // page.js: unpacks plotly, draws the plots of a page
std::string_view report_script();     // report.js: maps and features of a report
std::string_view hot_spots_script();  // hot_spots.js: targets of a report
std::string_view plotly_gzip();       // plotly.js (MIT licence) of Debian's python3-plotly, minified, gzip in Base64

}  // namespace seaglint
