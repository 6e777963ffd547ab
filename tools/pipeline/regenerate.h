// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// A sample of a data set made again from its scenario and row, and held against what is stored.

#include <string>
#include <vector>

#include "classify/dataset/directory/dataset_reader.h"
#include "tools/pipeline/pipeline.h"

namespace seaglint {

struct StoredSample {
  Sample sample;
  StoredAxes axes;
  Provenance origin;  // who made it
};

// Sample `number` < reader.size() of the data set. Throws InputError naming the shard that is damaged.
StoredSample stored_sample(const DatasetReader& reader, std::size_t number);

// What may differ when a sample of this origin is made again here, as a share of the map's peak and of a measured
// column: nothing for this program on this kind of processor, else kOtherProcessor.
double reproduction_tolerance(const Provenance& origin);

// What is not as stored in one sample made again, one entry each: map, complex map where both have one, hop code,
// columns of the row with SCR and features. Empty when all agree within the tolerance; with tolerance 0, bit for bit.
std::vector<std::string> differences(const Sample& stored, const Sample& again, double tolerance);

}  // namespace seaglint
