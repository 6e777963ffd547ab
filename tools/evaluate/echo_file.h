// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Reads the echo of one interval as I/Q samples over time (.npz): a file of `seaglint echo`, or a measured interval in
// the same layout (README.md, "Echo files").

#include <filesystem>
#include <set>
#include <string>

#include "classify/dataset/format/sample.h"
#include "radar/echo/echo.h"
#include "radar/waveform/pulse_train.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

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

}  // namespace seaglint
