// SPDX-License-Identifier: BSD-3-Clause
#include <cstdint>
#include <filesystem>

#include "classify/dataset/directory/dataset_reader.h"
#include "classify/dataset/format/manifest.h"
#include "classify/dataset/format/npz.h"
#include "classify/dataset/format/shard.h"
#include "tests/fuzz/readers.h"

namespace seaglint {

void fuzz_manifest(const std::string& bytes) {
  is_refused([&] { read_manifest(file_of(bytes, "manifest.json")); });
}

void fuzz_shard(const std::string& bytes) {
  is_refused([&] {
    const Shard shard = read_shard(ShardFile{"shard_00000.h5", {bytes}, ""});
    for (const Sample& sample : shard.samples)
      SEAGLINT_CHECK(sample.magnitude.size() == shard.axes.cells(), "a map of another size");
  });
}

void fuzz_npz(const std::string& bytes) {
  const std::filesystem::path file = file_of(bytes, "data.npz");
  is_refused([&] { read_npz_text(file, "description.json"); });
  is_refused([&] { npz_members(file); });
  is_refused([&] {
    const NpzValues values = read_npz_array(file, "samples/label");
    std::uint64_t count = 1;
    for (const std::uint64_t length : values.shape) count *= length;
    SEAGLINT_CHECK(values.numbers().size() == count, "an array of another size");
  });
}

void fuzz_inputs(const std::string& bytes) {
  const std::filesystem::path list = file_of(bytes, kInputsFile);
  is_refused([&] { require_same_inputs(list.parent_path(), Scenario{}); });
}

}  // namespace seaglint
