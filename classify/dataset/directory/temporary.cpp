// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/directory/temporary.h"

#include <limits.h>
#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <initializer_list>
#include <optional>
#include <string_view>

#include "classify/dataset/directory/file_names.h"
#include "classify/dataset/directory/input_list.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// Process that writes a temporary file.
struct Author {
  std::string_view host;
  pid_t process = 0;
};

// The rest of a file name after the name of a data set's file, from its dot on; empty if it has no such prefix.
std::string_view behind_own_name(std::string_view name) {
  for (const std::string_view own : {kScenarioFile, kInputsFile, kManifestFile, kDataCardFile}) {
    if (name.starts_with(own)) return name.substr(own.size());
  }
  for (const std::string_view ending : {".h5.", ".npz."}) {
    const std::size_t place = name.find(ending);
    if (place != std::string_view::npos && place > 0) return name.substr(place + ending.size() - 1);
  }
  return {};
}

// Host names may contain dots and hyphens; the process number follows the last hyphen.
std::optional<Author> author_of(std::string_view name) {
  constexpr std::string_view kEnding = ".tmp";
  if (!name.ends_with(kEnding)) return std::nullopt;
  name.remove_suffix(kEnding.size());
  const std::string_view rest = behind_own_name(name);
  const std::size_t hyphen = rest.rfind('-');
  if (!rest.starts_with('.') || hyphen == std::string_view::npos || hyphen < 2) return std::nullopt;
  Author author{rest.substr(1, hyphen - 1), 0};
  const char* end = rest.data() + rest.size();
  const auto [stop, error] = std::from_chars(rest.data() + hyphen + 1, end, author.process);
  if (error != std::errc() || stop != end || author.process <= 0) return std::nullopt;
  return author;
}

}  // namespace

bool is_temporary(const std::string& name) { return author_of(name).has_value(); }

bool is_stale(const fs::path& file) {
  const std::string name = file.filename();
  const std::optional<Author> author = author_of(name);
  if (!author) return false;
  char host[HOST_NAME_MAX + 1] = {};
  ::gethostname(host, HOST_NAME_MAX);
  if (author->host == host) return ::kill(author->process, 0) != 0 && errno == ESRCH;
  std::error_code error;
  const fs::file_time_type written = fs::last_write_time(file, error);
  return !error && fs::file_time_type::clock::now() - written > std::chrono::hours(24);
}

}  // namespace seaglint
