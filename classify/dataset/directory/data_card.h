// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The data card (README.md) of a data set: content, arrays, reading, splits, limitations.

#include <string>

#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/sample.h"
#include "sim/scenario/sample_plan.h"
#include "sim/scenario/scenario.h"

namespace seaglint {

// The card in Markdown; `plan`: of the scenario.
std::string data_card(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest,
                      const StoredAxes& axes);

// The text with a last line, a comment, that has the checksum of the text above it.
std::string signed_card(const std::string& text);

// True for a text of signed_card(): the program wrote it, and nobody changed it.
bool is_unchanged_card(const std::string& text);

// True for one that begins with metadata of the Hugging Face Hub (classify/dataset/cards/hub_card.h).
bool has_front_matter(const std::string& text);

// What the data are, in one paragraph without markup.
std::string data_set_summary(const Scenario& scenario, const SamplePlan& plan, const Manifest& manifest);

// Samples of every target: a plan has equally many of each.
std::size_t samples_per_target(const SamplePlan& plan);

}  // namespace seaglint
