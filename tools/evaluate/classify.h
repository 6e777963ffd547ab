// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Applies a trained model to single maps of a data set, or to the map of an echo file: probabilities, and features
// against their training ranges.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include "sim/core/process/parallel.h"

namespace seaglint {

struct ClassifyRequest {
  std::filesystem::path model;
  std::filesystem::path data;         // data set, or echo file (.npz, tools/evaluate/echo_file.h)
  std::optional<std::size_t> sample;  // of a data set; all samples without
  std::filesystem::path output;       // CSV file; may be empty
};

// Returns the text for the terminal: of one sample or an echo file its probabilities and features against the ranges
// and class quantiles of the training maps, of all samples a line each. The CSV file has a line per sample with
// probabilities, features and the names of the features outside the training range. Throws InputError when the model
// does not fit the data (tools/evaluate/evaluate.h), there is no such sample, an echo file is refused
// (read_echo_file()), or the output is a file of the data set or the model; WorkError when the file cannot be written;
// Interrupted when *stop becomes true.
std::string classify_samples(const ClassifyRequest& request, const StopFlag* stop = nullptr);

}  // namespace seaglint
