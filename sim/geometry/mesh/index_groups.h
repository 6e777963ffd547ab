// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Indices 0 to count - 1 in groups, ascending in each (counting sort): triangles by vertex, members of a set.

#include <cstdint>
#include <span>
#include <vector>

namespace seaglint {

class IndexGroups {
 public:
  // group_of(i) < groups is called twice for every index.
  template <typename GroupOf>
  IndexGroups(std::size_t count, std::size_t groups, const GroupOf& group_of) : first_(groups + 1, 0), members_(count) {
    for (std::uint32_t i = 0; i < count; ++i) ++first_[group_of(i)];
    std::uint32_t end = 0;
    for (std::uint32_t& first : first_) first = end += first;
    for (auto i = static_cast<std::uint32_t>(count); i-- > 0;) members_[--first_[group_of(i)]] = i;
  }

  std::size_t size() const { return first_.size() - 1; }
  std::span<const std::uint32_t> operator[](std::size_t group) const {
    return {members_.data() + first_[group], members_.data() + first_[group + 1]};
  }

 private:
  std::vector<std::uint32_t> first_;
  std::vector<std::uint32_t> members_;
};

}  // namespace seaglint
