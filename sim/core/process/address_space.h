// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Memory that libraries take without reporting its lack: some end the process or wait for ever.

#include <cstddef>
#include <string>

namespace seaglint {

// Throws WorkError "out of memory: WHAT needs N MB more ..." unless the process may still map so many bytes; nothing
// stays reserved.
void require_address_space(std::size_t bytes, const std::string& what);

}  // namespace seaglint
