// SPDX-License-Identifier: BSD-3-Clause
// The entry point of libFuzzer for one reader, SEAGLINT_READER.
#include <cstddef>
#include <cstdint>
#include <string>

#include "tests/fuzz/readers.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  seaglint::SEAGLINT_READER(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
