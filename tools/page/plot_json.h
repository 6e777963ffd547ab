// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures as JSON, which page.js of an HTML page draws in place of their pictures: with readouts, zoom and a legend
// that shows and hides series.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tools/figure/figure.h"

namespace seaglint {

// {"columns", "panels": [{"title", "x": {"label", "range", "log"}, "y", "equal", "series": [{"name", "style", "x", "y",
// "low", "high"}]}]}: numbers to six digits, null where a value is not finite, no `<`.
std::string plot_json(std::span<const LinePlot> plots, int columns);
std::string plot_json(const LinePlot& plot);

// Bytes compressed by zlib (RFC 1950), in Base64: unpacked by `inflate` of page.js.
std::string packed(std::span<const std::uint8_t> bytes);

// Single-precision numbers, little-endian, packed; `digits` significant binary digits are kept, 1 to 24.
std::string packed_floats(std::span<const double> values, int digits = 24);

}  // namespace seaglint
