// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The data card with metadata as the Hugging Face Hub reads them: YAML between two lines `---` at its beginning.

#include <cstdint>
#include <string>

#include "classify/dataset/cards/publication.h"

namespace seaglint {

// Metadata: title, licence if given, task, size, tags, and columns.csv as what the Hub's viewer and
// `datasets.load_dataset` read.
std::string hub_front_matter(const Publication& publication, const std::string& title, std::uint64_t samples);

// "1K<n<10K" for 1,000 <= samples < 10,000.
std::string hub_size_category(std::uint64_t samples);

// The Hub's identifier of a licence in SPDX's spelling; empty if it has none.
std::string hub_licence(const std::string& spdx);

// Sections on licence, creators, citation and the files beside the card.
std::string publication_sections(const Publication& publication, const std::string& citation);

}  // namespace seaglint
