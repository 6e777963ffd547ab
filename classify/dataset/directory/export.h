// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Exports shards to NumPy's .npz: the arrays of the shards under their names without the leading slash (`maps`,
// `samples/label`), complex maps as complex64 [sample][velocity][range], names as 64 bytes each. description.json
// inside lists units and meaning of every array and the provenance.

#include <filesystem>
#include <functional>
#include <string>

#include "classify/dataset/directory/dataset_reader.h"
#include "sim/core/process/parallel.h"

namespace seaglint {

// Writes shards `first` to `first + count - 1` of a data set into one file, completely or not at all; count >= 1. Every
// shard's checksum is verified first. Memory holds one shard's maps and the rows of all samples (300 bytes each).
// Throws InputError naming a damaged shard, WorkError when the file cannot be written, Interrupted when *stop becomes
// true.
void export_shards(const DatasetReader& reader, std::size_t first, std::size_t count, const std::filesystem::path& file,
                   const StopFlag* stop = nullptr);

// Checks a directory for an export of several files: it must be new or empty, or contain only files of an export of the
// same data set, complete or incomplete: their names satisfy is_name(), their contents is_of_this_set(name). Throws
// InputError naming the directory and its content; the data set's own directory is rejected too.
using ExportedName = std::function<bool(const std::string& name)>;
void require_export_directory(const DatasetReader& reader, const std::filesystem::path& directory,
                              const ExportedName& is_name, const ExportedName& is_of_this_set);

// The same for one .npz per shard.
void require_npz_directory(const DatasetReader& reader, const std::filesystem::path& directory);

}  // namespace seaglint
