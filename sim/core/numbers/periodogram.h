// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace seaglint {

// One-sided densities over angular frequency, in the series' unit squared times s/rad, of series of one length with
// `step` s between their values, each under Hann's window and padded with zeros to `padding` times its length: [series]
// [n - 1] at omega = n 2 pi / (padding length step), n = 1 to count, count <= padding length / 2.
std::vector<std::vector<double>> periodograms(std::span<const std::vector<double>> series, double step,
                                              std::size_t count, std::size_t padding = 1);

}  // namespace seaglint
