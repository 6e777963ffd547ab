// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/temporary.h"

#include <string_view>

#include "classify/dataset/directory/file_names.h"
#include "sim/core/process/temporary_file.h"

namespace seaglint {

bool is_temporary(const std::string& name) {
  const std::string_view target = target_of_temporary(name);
  for (const std::string_view own : kSingleFiles) {
    if (target == own) return true;
  }
  for (const std::string_view ending : {".h5", ".npz"}) {
    if (target.size() > ending.size() && target.ends_with(ending)) return true;
  }
  return false;
}

}  // namespace seaglint
