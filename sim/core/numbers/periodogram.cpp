// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/numbers/periodogram.h"

#include <cmath>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/fourier.h"

namespace seaglint {

std::vector<std::vector<double>> periodograms(std::span<const std::vector<double>> series, double step,
                                              std::size_t count, std::size_t padding) {
  const std::size_t samples = series[0].size();
  FourierBatch transform(padding * samples, series.size(), Fourier::kForward);
  double power = 0;
  for (std::size_t n = 0; n < samples; ++n) {
    const double window = 0.5 - 0.5 * std::cos(2 * kPi * (static_cast<double>(n) + 0.5) / static_cast<double>(samples));
    for (std::size_t i = 0; i < series.size(); ++i) transform.row(i)[n] = window * series[i][n];
    power += window * window;
  }
  transform.execute();
  std::vector<std::vector<double>> density(series.size());
  for (std::size_t i = 0; i < series.size(); ++i) {
    for (std::size_t k = 1; k <= count; ++k)
      density[i].push_back(std::norm(transform.row(i)[k]) * step / (kPi * power));
  }
  return density;
}

}  // namespace seaglint
