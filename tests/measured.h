// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Figures that tests measure. `tools/measure accuracy` collects them and writes the accuracy tables of the READMEs.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <utility>

namespace seaglint {

// Records `value`, with this number of decimals, under the identifier that `id` and its arguments give: lower-case
// letters, digits and underscores. It stands in the body of a test, where its name is read from the source.
template <typename... Arguments>
void record_figure(double value, int decimals, fmt::format_string<Arguments...> id, Arguments&&... arguments) {
  testing::Test::RecordProperty("figure:" + fmt::format(id, std::forward<Arguments>(arguments)...),
                                fmt::format("{:.{}f}", value, decimals));
}

}  // namespace seaglint
