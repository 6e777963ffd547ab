// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/error.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <utility>

namespace seaglint {

SeveralInputErrors::SeveralInputErrors(std::vector<std::string> messages)
    : InputError(fmt::format("{}", fmt::join(messages, "\n"))), messages_(std::move(messages)) {}

std::vector<std::string> messages_of(const InputError& error) {
  const auto* several = dynamic_cast<const SeveralInputErrors*>(&error);
  return several != nullptr ? several->messages() : std::vector<std::string>{error.what()};
}

void throw_input_errors(std::vector<std::string> messages) {
  SEAGLINT_CHECK(!messages.empty(), "an error without a message");
  if (messages.size() == 1) throw InputError(messages.front());
  throw SeveralInputErrors(std::move(messages));
}

void fail_check(const char* condition, const char* file, int line, const std::string& detail) {
  throw std::logic_error(fmt::format("{}:{}: internal check failed: {} ({})", file, line, condition, detail));
}

}  // namespace seaglint
