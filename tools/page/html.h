// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Self-contained HTML pages: templates with placeholders, tables, and figures as JSON that page.js draws in place of
// their pictures.

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tools/figure/figure.h"

namespace seaglint {

std::string escape_html(std::string_view text);
std::string base64(std::string_view bytes);  // RFC 4648, section 4

// Values of a template by the names of its placeholders.
using PageValues = std::map<std::string, std::string, std::less<>>;

// A template (notation of Mustache) with its values: `{{name}}` is the value as text, `{{{name}}}` the value as HTML;
// `{{#name}}...{{/name}}` stays where the value is not empty, `{{^name}}...{{/name}}` where it is. Values are not
// searched for placeholders. Throws std::logic_error for a placeholder without a value, a value without a placeholder
// and a section that does not end.
std::string filled(std::string_view page, const PageValues& values);

// A table; cells are HTML, the first row is the head. Columns after the first are right-aligned when `numbers`.
std::string html_table(const std::vector<std::vector<std::string>>& rows, bool numbers = true);

// A .png or .svg file as an embedded picture with its caption (HTML) below; `alternative` is the text for screen
// readers. `plot` (plot_json()), unless empty, is drawn in its place where scripts run, except in print.
std::string html_figure(const std::filesystem::path& file, std::string_view caption, std::string_view alternative,
                        std::string_view plot = {});

// The bytes of a PNG as an embedded picture.
std::string html_picture(std::string_view png, std::string_view caption, std::string_view alternative);

// The whole page around its body. A body with JSON for scripts gets plotly and page.js, then `script`; the page needs
// no network.
std::string html_page(std::string_view title, std::string_view body, std::string_view script = {});

// Files that pages contain, embedded when the program is built (tools/cmake/embed_files.py).
std::string_view page_template();        // page.html: the page around a body
std::string_view page_style();           // style.css
std::string_view page_script();          // page.js: unpacks plotly, draws the plots of a page
std::string_view report_template();      // report.html: body of a report
std::string_view benchmark_template();   // benchmark.html: a benchmark within a report
std::string_view report_script();        // report.js: maps and features of a report
std::string_view hot_spots_template();   // hot_spots.html: body of a page of hot spots
std::string_view hot_spots_script();     // hot_spots.js: targets in three dimensions, coloured by their echo
std::string_view comparison_template();  // comparison.html: body of a comparison
std::string_view comparison_script();    // comparison.js: curves and images of a comparison
std::string_view plotly_gzip();          // plotly.js (MIT licence) of Debian's python3-plotly, minified, gzip in Base64

// JSON as content of an HTML script element: `<` is \u003c; null for a number that is not finite.
std::string json_string(std::string_view text);  // with its quotes; UTF-8
std::string json_number(double value, int digits = 6);
std::string json_numbers(std::span<const double> values, int digits = 6);

// Figures as JSON, which page.js of an HTML page draws in place of their pictures: with readouts, zoom and a legend
// that shows and hides series.

// {"columns", "panels": [{"title", "x": {"label", "log", "range"}, "y", "equal", "series": [{"name", "style", "x", "y",
// "low", "high", "colour", "width"}], "marks": [[x, y, name]]}]}: numbers to six digits; colour and width of series
// that state a colour; marks of plots that have some.
std::string plot_json(std::span<const LinePlot> plots, int columns);
std::string plot_json(const LinePlot& plot);

// Bytes compressed by zlib (RFC 1950), in Base64: unpacked by `inflate` of page.js.
std::string packed(std::span<const std::uint8_t> bytes);

// Single-precision numbers, little-endian, packed; `digits` significant binary digits are kept, 1 to 24.
std::string packed_floats(std::span<const double> values, int digits = 24);

}  // namespace seaglint
