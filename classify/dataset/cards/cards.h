// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The files with which a data set is handed to others: README.md with metadata of the Hugging Face Hub, croissant.json
// and columns.csv.

#include <string>

#include "classify/dataset/cards/publication.h"
#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// Writes the three files into the data set's directory, each completely or not at all; croissant.json, which has the
// checksums of the others, last. Every shard is read and checked. The bytes depend only on data set and publication.
// Throws InputError for a README.md, croissant.json or columns.csv that this program did not write or that was changed
// since, and for a damaged shard, with nothing written; WorkError when a file cannot be written; Interrupted when *stop
// becomes true.
void write_cards(const DatasetReader& reader, const Publication& publication, const StopFlag* stop = nullptr);

// The citation of the program (CITATION.cff) of this version in BibTeX.
std::string program_citation(const std::string& version);

}  // namespace seaglint
