// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Disjoint sets (union-find) of indices 0 to count - 1.

#include <cstdint>
#include <numeric>
#include <vector>

namespace seaglint {

class DisjointSets {
 public:
  explicit DisjointSets(std::size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0u); }

  // Representative index of the set that holds i.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void unite(std::uint32_t a, std::uint32_t b) { parent_[find(a)] = find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace seaglint
