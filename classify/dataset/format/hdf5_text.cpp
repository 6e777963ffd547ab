// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/hdf5_text.h"

#include <fmt/format.h>

namespace seaglint {

std::string system_reason(std::string_view description) {
  constexpr std::string_view kBefore = "error message = '";
  const std::size_t begin = description.find(kBefore);
  if (begin == std::string_view::npos) return "";
  const std::size_t from = begin + kBefore.size();
  return fmt::format(": {}", description.substr(from, description.find('\'', from) - from));
}

bool says_no_memory(std::string_view description) {
  for (const std::string_view known : {"memory allocation failed", "unable to allocate memory"}) {
    if (description.find(known) != std::string_view::npos) return true;
  }
  return false;
}

std::string with_percents(const std::string& name, std::string_view from, std::string_view to) {
  std::string result;
  std::size_t begin = 0;
  for (std::size_t i = name.find(from); i != std::string::npos; i = name.find(from, begin)) {
    result.append(name, begin, i - begin).append(to);
    begin = i + from.size();
  }
  return result.append(name, begin);
}

}  // namespace seaglint
