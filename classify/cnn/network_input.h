// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Input of the network: the shape of a map without its level. With a fixed signal-to-clutter ratio the absolute level
// would reveal the class, so each map is divided by its own total energy first.

#include <cstddef>
#include <span>
#include <vector>

namespace seaglint {

inline constexpr std::size_t kInputRows = 64;      // velocity
inline constexpr std::size_t kInputColumns = 128;  // range
inline constexpr std::size_t kInputCells = kInputRows * kInputColumns;

// magnitude: [velocity][range], metres. Power is averaged over kInputRows x kInputColumns windows that cover the map,
// divided by its sum, taken in dB, cut off at floor_db (below the whole map's energy, negative), and scaled to 0
// (floor) .. 1 (all energy in one window). A map without energy gives zeros. Invariant to multiplication of the map by
// a positive number, up to rounding.
std::vector<float> network_input(std::span<const float> magnitude, std::size_t rows, std::size_t columns,
                                 double floor_db);

}  // namespace seaglint
