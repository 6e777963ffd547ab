// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which things hang together, told pair by pair.

#include <cstdint>
#include <numeric>
#include <vector>

namespace seaglint {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  // The same number for all that hang together.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace seaglint
