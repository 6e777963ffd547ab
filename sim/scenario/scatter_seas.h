// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Seas that a scenario draws from a scatter diagram, sea.scatter_diagram.

#include <memory>
#include <vector>

#include "sim/scenario/draws/variation.h"
#include "sim/scenario/files/scatter_diagram.h"

namespace seaglint {

class ErrorList;
struct ScenarioDocument;

// Reads the diagram that a document names; null without one. Records an error for a file that is missing or wrong and
// for heights and periods beside it; null then.
std::shared_ptr<ScatterDiagram> find_scatter_diagram(const ScenarioDocument& document, ErrorList& errors);

// Removes the cells in which waves may break (breaking_height()) with the document's other keys of `sea`, of those that
// are drawn, `variations`, with any end. Throws InputError if no cell is left.
void exclude_breaking(const ScenarioDocument& document, const std::vector<Variation>& variations,
                      ScatterDiagram& diagram);

// Of each wave height of a diagram: the highest waves with the shortest and the longest period, the lowest with the
// longest.
std::vector<SeaPair> extreme_pairs(const ScatterDiagram& diagram);

}  // namespace seaglint
