// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Application of a trained model to single maps of a data set, or to the map of an echo file.

#include <cstddef>
#include <filesystem>
#include <optional>
#include <set>
#include <string>

#include "classify/dataset/format/sample.h"
#include "radar/echo/echo.h"
#include "radar/waveform/pulse_train.h"
#include "sim/core/process/parallel.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// Reads the echo of one interval as I/Q samples over time (.npz): a file of `seaglint echo`, or a measured interval in
// the same layout (README.md, "Echo files").

struct EchoFile {
  Scenario scenario;            // scenario.yaml of the archive
  PulseTrain train;             // of the map, with the code, carriers and times of the archive
  Echo echo;                    // at the map's frequencies; a measured interval is all `target`
  SampleRecord record;          // columns of description.json; zero or empty where it has none
  std::set<std::string> given;  // names of these columns
  bool is_measured = false;     // target, clutter and noise are not separate
};

// Throws InputError naming file and array: no archive, or truncated; no scenario.yaml; an array that is missing or of
// another type or shape; values that are not finite, or no power; pulses, times, carriers, frequencies or samples that
// contradict `radar` of the scenario.
EchoFile read_echo_file(const std::filesystem::path& file);

struct ClassifyRequest {
  std::filesystem::path model;
  std::filesystem::path data;         // data set, or echo file (.npz, EchoFile)
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
