// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The container of a .glb: JSON and one piece of binary data.

#include <string>
#include <string_view>

namespace seaglint {

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  // empty where there is none
};

bool is_glb(std::string_view bytes);

// A .glb by its chunks; any other text is all JSON. Throws InputError for a container that is cut short or no version
// 2.
GlbChunks glb_chunks(std::string_view bytes, const std::string& file);

// A .glb of these chunks, each filled up to a multiple of 4 bytes.
std::string glb_of(std::string json, std::string_view binary);

}  // namespace seaglint
