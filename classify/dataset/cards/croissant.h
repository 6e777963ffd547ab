// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Description of a data set in the Croissant format 1.0 of MLCommons (http://mlcommons.org/croissant/1.0), JSON-LD that
// search engines and loaders of data sets read.

#include <string>
#include <vector>

#include "classify/dataset/cards/publication.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Content of croissant.json: the data set with every file of its directory as a FileObject with SHA-256 (shards by the
// manifest), the classes as a RecordSet of their own, and the RecordSet `samples` with a Field for every column of
// columns.csv, which must exist. `citation`: BibTeX.
std::string croissant_json(const DatasetReader& reader, const Scenario& scenario, const Publication& publication,
                           const std::string& citation);

// The properties that the specification requires of a data set and that are not given: license, url, creator,
// datePublished.
std::vector<std::string> missing_properties(const Publication& publication);

// True for the text of a croissant.json that croissant_json() made, of any version.
bool is_croissant_of_seaglint(const std::string& text);

}  // namespace seaglint
