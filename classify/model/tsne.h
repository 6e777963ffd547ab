// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// t-SNE: rows of features as points of a plane that keep their neighbours (van der Maaten and Hinton 2008), for the eye
// only.

#include <array>
#include <cstdint>
#include <vector>

#include "classify/model/booster.h"

namespace seaglint {

// Exact (not Barnes-Hut) t-SNE of standardised columns: cost grows with the square of the rows. The perplexity is
// lowered to a third of the rows where they are few. Start from stream kEmbeddingPlot of seed; below 4 rows all points
// are zero.
std::vector<std::array<double, 2>> tsne(const FeatureMatrix& features, double perplexity, int iterations,
                                        std::uint64_t seed);

}  // namespace seaglint
