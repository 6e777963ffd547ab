// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Elements of glTF accessors as they lie in memory: floats, quantised integers, replaced (sparse) values.

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct GltfElements {
  const unsigned char* first = nullptr;  // null: all are zero
  std::size_t stride = 0, size = 0;      // bytes from one to the next, and of one
  std::size_t count = 0;
  int component = 0;                                        // componentType of glTF 2.0, section 3.6.2.2
  bool normalised = false;                                  // integers stand for fractions of their largest value
  std::shared_ptr<const std::vector<unsigned char>> own{};  // of replaced values: the memory
};

// Element i, of three components.
Vec3 vector_at(const GltfElements& elements, std::size_t i);

// The elements with `count` of them replaced by `values`, at indices of `width` bytes each; nullopt where one is beyond
// the elements.
std::optional<GltfElements> with_replaced(const GltfElements& elements, std::size_t count, const unsigned char* indices,
                                          std::size_t width, const unsigned char* values);

}  // namespace seaglint
