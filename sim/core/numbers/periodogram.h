// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace seaglint {

// One-sided spectral densities over angular frequency, unit squared times s/rad, of series of equal length with time
// step `step` (s), each with a Hann window and zero-padded to `padding` times its length: [series] [n - 1] at omega = n
// 2 pi / (padding length step), n = 1 to count, count <= padding length / 2.
std::vector<std::vector<double>> periodograms(std::span<const std::vector<double>> series, double step,
                                              std::size_t count, std::size_t padding = 1);

}  // namespace seaglint
