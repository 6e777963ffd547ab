// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Checks gradient-boosted trees in XGBoost's JSON (its documentation, "Introduction to Model IO"; version 1.7, src/tree
// and src/gbm). The library follows the indices of the nodes as the file states them.

#include <string>

namespace seaglint {

// Throws InputError "NAME: not the trees of a model: tree 3: split_indices: 9, must be ..." unless the text is a model
// as Booster::save() writes it: objective binary:logistic or multi:softprob, booster gbtree, at least one tree, each of
// one class. Every array of a tree has one entry per node; nodes split at one of the model's columns, by a number; they
// have two children or none, and each is reached once from the first; all numbers are finite in single precision.
void require_sound_trees(const std::string& text, const std::string& name);

}  // namespace seaglint
