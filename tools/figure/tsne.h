// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// t-SNE: maps rows of features to points of a plane that preserve neighbourhoods (van der Maaten and Hinton 2008); for
// display only.

#include <array>
#include <cstdint>
#include <vector>

#include "classify/features/feature_vector.h"

namespace seaglint {

// Exact (not Barnes-Hut) t-SNE of standardised columns: cost grows with the square of the rows. The perplexity is at
// most a third of the rows. Initial points from stream kEmbeddingPlot of seed; below 4 rows all points are zero.
std::vector<std::array<double, 2>> tsne(const FeatureMatrix& features, double perplexity, int iterations,
                                        std::uint64_t seed);

}  // namespace seaglint
