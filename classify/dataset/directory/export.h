// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Shards as NumPy's .npz: the arrays of the shards under their names without the leading slash (`maps`,
// `samples/label`), complex maps as complex64 [sample][velocity][range], names as 64 bytes each. description.json
// inside says units and meaning of every array and who made it.

#include <filesystem>

#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// Writes shards `first` to `first + count - 1` of a data set into one file, whole or not at all; count >= 1. Every
// shard is read against its checksum first. In memory are one shard's maps and the rows of all samples (300 bytes
// each). Throws InputError naming the shard that is damaged, WorkError when the disk refuses, Interrupted when *stop
// becomes true.
void export_shards(const DatasetReader& reader, std::size_t first, std::size_t count, const std::filesystem::path& file,
                   const StopFlag* stop = nullptr);

// A directory for one file a shard is new or empty, or holds an export of this very data set, whole or cut short, and
// nothing else. Throws InputError naming the directory and what it holds; that of the data set is refused too.
void require_export_directory(const DatasetReader& reader, const std::filesystem::path& directory);

}  // namespace seaglint
