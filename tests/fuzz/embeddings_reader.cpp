// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <vector>

#include "classify/features/feature_matrix.h"
#include "tests/fuzz/readers.h"
#include "tests/fuzz/refusal.h"

namespace seaglint {

void fuzz_embeddings(const std::string& bytes) {
  is_refused([&] { read_embeddings(file_of(bytes, "embeddings.csv"), std::vector<std::int64_t>{0, 1, 2}); });
}

}  // namespace seaglint
