// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Comparison of a regenerated sample of a data set with the stored one.

#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

struct StoredSample {
  Sample sample;
  StoredAxes axes;
  Provenance origin;  // program version and processor that wrote it
};

// Reads sample `number` < reader.size() of the data set. Throws InputError naming a damaged shard.
StoredSample stored_sample(const DatasetReader& reader, std::size_t number);

// Allowed difference of a sample of this origin regenerated here, as a fraction of the map's peak and of a measured
// column: 0 for this program version on this kind of processor, else kOtherProcessor.
double reproduction_tolerance(const Provenance& origin);

// Differences between a stored and a regenerated sample, one entry each: map, complex map if both have one, hop code,
// columns of the row with SCR and features. Empty when all agree within the tolerance; tolerance 0 means bit for bit.
std::vector<std::string> differences(const Sample& stored, const Sample& again, double tolerance);

}  // namespace seaglint
