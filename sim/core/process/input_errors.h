// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Several mistakes in one input, reported together.

#include <string>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

// what(): all messages, each on a line of its own.
class SeveralInputErrors : public InputError {
 public:
  explicit SeveralInputErrors(std::vector<std::string> messages);  // at least one
  const std::vector<std::string>& messages() const { return messages_; }

 private:
  std::vector<std::string> messages_;
};

// The messages of an error: those of SeveralInputErrors, else the one that it is.
std::vector<std::string> messages_of(const InputError& error);

// Throws an InputError with these messages, with SeveralInputErrors for more than one; at least one.
[[noreturn]] void throw_input_errors(std::vector<std::string> messages);

}  // namespace seaglint
