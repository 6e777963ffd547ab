// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Container of a .glb file: one JSON chunk and at most one binary chunk (glTF 2.0, section 4.4).

#include <string>
#include <string_view>

namespace seaglint {

struct GlbChunks {
  std::string_view json;
  std::string_view binary;  // empty: no binary chunk
};

bool is_glb(std::string_view bytes);

// Chunks of a .glb; any other text is one JSON chunk. Throws InputError for a truncated container or a version other
// than 2.
GlbChunks glb_chunks(std::string_view bytes, const std::string& file);

// A .glb of these chunks, each padded to a multiple of 4 bytes.
std::string glb_of(std::string json, std::string_view binary);

}  // namespace seaglint
