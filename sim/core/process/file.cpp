// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <limits.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "sim/core/process/error.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

// File descriptor, closed by the destructor.
class Descriptor {
 public:
  Descriptor(const fs::path& path, int flags) : number_(::open(path.c_str(), flags | O_CLOEXEC, 0666)) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int number() const { return number_; }

  // False, with errno, for a delayed write error.
  bool close() {
    const int number = number_;
    number_ = -1;
    return ::close(number) == 0;
  }

 private:
  int number_;
};

[[noreturn]] void fail_writing(const fs::path& path) {
  throw WorkError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
}

// name: file name in error messages.
void write_all(const fs::path& path, const fs::path& name, int flags, std::string_view content) {
  Descriptor file(path, O_WRONLY | flags);
  if (file.number() < 0) fail_writing(name);
  while (!content.empty()) {
    const ssize_t written = ::write(file.number(), content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(name);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
  if (!file.close()) fail_writing(name);
}

// Waits until the data are on the disk. EINVAL, from file systems that cannot synchronise directories, is ignored.
void synchronise(const fs::path& path, const fs::path& name, int flags) {
  const Descriptor file(path, O_RDONLY | flags);
  if (file.number() < 0 || (::fsync(file.number()) != 0 && errno != EINVAL)) fail_writing(name);
}

// "<path>.<host>-<process>.tmp"
fs::path temporary_name(fs::path path) {
  char host[HOST_NAME_MAX + 1] = {};
  ::gethostname(host, HOST_NAME_MAX);
  path += fmt::format(".{}-{}.tmp", host, ::getpid());
  return path;
}

// A pipe, terminal or device: written directly, since renaming would replace it.
bool is_stream(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

}  // namespace

fs::path find_file(const std::string& name, const fs::path& folder, const std::string& where) {
  const fs::path in_folder = folder / name;
  std::error_code error;
  for (const fs::path& candidate : {in_folder, fs::path(name)}) {
    if (fs::exists(candidate, error)) return candidate;
  }
  throw InputError(fmt::format("{}: value '{}': no such file, neither {} nor below the working directory", where, name,
                               in_folder.string()));
}

std::string read_file(const fs::path& path, std::size_t max_bytes) {
  // Without O_NONBLOCK, opening a pipe without a writer would block.
  const Descriptor file(path, O_RDONLY | O_NONBLOCK);
  const auto fail = [&](const std::string& reason) {
    throw InputError(fmt::format("{}: cannot read: {}", path.string(), reason));
  };
  if (file.number() < 0) fail(std::strerror(errno));
  struct stat status {};
  if (::fstat(file.number(), &status) != 0) fail(std::strerror(errno));
  if (S_ISDIR(status.st_mode)) fail("is a directory");
  if (!S_ISREG(status.st_mode)) fail("is not a regular file");
  const auto too_large = [&] { fail(fmt::format("is larger than the limit of {} bytes", max_bytes)); };
  if (static_cast<std::uintmax_t>(status.st_size) > max_bytes) too_large();

  std::string content;
  content.reserve(static_cast<std::size_t>(status.st_size));
  char buffer[65536];
  while (true) {
    const ssize_t count = ::read(file.number(), buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(std::strerror(errno));
    if (count == 0) return content;
    content.append(buffer, static_cast<std::size_t>(count));
    if (content.size() > max_bytes) too_large();
  }
}

void write_file(const fs::path& path, std::string_view content) {
  if (is_stream(path)) {
    write_all(path, path, 0, content);
  } else {
    write_file_with(path, [&](const fs::path& temporary) { write_all(temporary, path, O_CREAT | O_TRUNC, content); });
  }
}

void require_writable(const fs::path& path) {
  if (path.empty() || is_stream(path)) return;
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail_writing(path);
}

void write_file_with(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  if (is_stream(path)) throw WorkError(fmt::format("{}: cannot write: is not a regular file", path.string()));
  // A symbolic link is preserved: its target is replaced.
  std::error_code error;
  const fs::path resolved = fs::canonical(path, error);
  const fs::path target = error ? path : resolved;
  const fs::path folder = target.has_parent_path() ? target.parent_path() : fs::path(".");
  const fs::path temporary = temporary_name(target);
  try {
    if (fs::is_directory(target, error)) {
      errno = EISDIR;
      fail_writing(target);
    }
    write(temporary);
    synchronise(temporary, target, 0);
    if (::rename(temporary.c_str(), target.c_str()) != 0) fail_writing(target);
  } catch (...) {
    fs::remove(temporary, error);
    throw;
  }
  synchronise(folder, folder, O_DIRECTORY);
}

void make_directory(const fs::path& path) {
  const auto fail = [&](const std::string& reason) {
    throw WorkError(fmt::format("{}: cannot make the directory: {}", path.string(), reason));
  };
  std::error_code error;
  fs::create_directories(path, error);
  if (error) fail(error.message());
  if (!fs::is_directory(path, error)) fail("a file of this name exists");
  if (::access(path.c_str(), W_OK | X_OK) != 0)
    throw WorkError(fmt::format("{}: the directory is not writable: {}", path.string(), std::strerror(errno)));
}

}  // namespace seaglint
