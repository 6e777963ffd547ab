// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The shared library seaglint_layers, the only part of the program with libtorch: it is loaded where a network is made.
// clang compiles libtorch 1.13 as C++17 only (as C++20 it instantiates a vector of a type that is not complete).

#include "classify/cnn/layers.h"

// Layers of these sizes, owned by the caller. Throws WorkError, std::bad_alloc.
extern "C" seaglint::Layers* seaglint_torch_layers(const seaglint::LayerSizes& sizes);
