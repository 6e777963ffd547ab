// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Complex Gaussian processes with Gaussian correlation e^{-(w tau)^2 / 2}: speckle of scatterers of the sea, of one
// width or of widths that differ and vary.

#include <cstddef>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "sim/core/numbers/linear.h"
#include "sim/core/numbers/random.h"

namespace seaglint {

// A Gaussian process with correlation e^{-(w tau)^2/2} is white noise at nodes every kNodeSpacing/w through the kernel
// e^{-(w t)^2}; spacing and reach cause errors of 1e-6 and 5e-6 in the correlation.
inline constexpr double kNodeSpacing = 0.6;
inline constexpr double kKernelReach = 3.5;

// Nodes for the time x (in 1/w), from index `first` on, with weights whose squares sum to 1.
struct Kernel {
  double first = 0;
  std::vector<double> weight;
};
Kernel kernel_at(double x);

// Independent processes of power 1 and one rate w (rad/s). The generator must outlive it.
class Speckle {
 public:
  Speckle(int scatterers, double rate_rad_s, Random& random);

  // Values at time_s >= 0, ascending from call to call.
  void at(double time_s, Complex* values);

 private:
  int scatterers_;
  double rate_;
  Random& random_;
  double first_;  // number of the node nodes_.front(), at time first_ kNodeSpacing / rate
  std::deque<std::vector<Complex>> nodes_;
};

// Independent processes of power 1, each with a phase u = integral of w dt (rad) of its own: between two moments of one
// process the correlation is e^{-(u2 - u1)^2 / 2}. Stream kClutter of (seed, number of the process).
class IndividualSpeckle {
 public:
  IndividualSpeckle(int scatterers, std::uint64_t seed);

  // Values at phases u >= 0 of every process, each ascending from call to call.
  void at(std::span<const double> phase, Complex* values);

 private:
  static constexpr std::size_t kNodes = 16;  // at least the nodes under a kernel, 2 kKernelReach / kNodeSpacing + 1
  struct Process {
    Random random;
    std::int64_t end = 0;   // nodes below it are drawn, the last kNodes of them in `nodes`
    Complex nodes[kNodes];  // node q at q modulo kNodes
  };
  std::vector<Process> processes_;
};

}  // namespace seaglint
