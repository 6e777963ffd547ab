// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>

#include "tests/fuzz/readers.h"
#include "tools/evaluate/classify.h"

namespace seaglint {

void fuzz_echo(const std::string& bytes) {
  is_refused([&] {
    const EchoFile read = read_echo_file(file_of(bytes, "echo.npz"));
    const std::size_t values = read.train.pulses() * read.train.frequencies();
    for (const auto* part : {&read.echo.target, &read.echo.clutter, &read.echo.noise})
      SEAGLINT_CHECK(part->empty() || part->size() == values, "an echo of another size");
    SEAGLINT_CHECK(std::isfinite(mean_power(read.echo.total())), "an echo that is not finite");
  });
}

}  // namespace seaglint
