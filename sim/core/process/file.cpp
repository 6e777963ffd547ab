// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"

namespace seaglint {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kEnding = ".tmp";
constexpr std::size_t kDigits = 16;
constexpr int kMaxAttempts = 100;  // each is lost only to a process that removes leftovers in the same microseconds

[[noreturn]] void fail_writing(const fs::path& path) {
  throw WorkError(fmt::format("{}: cannot write: {}", path.string(), std::strerror(errno)));
}

// Writes all of the content; `path` stands in the error message.
void write_all(int descriptor, std::string_view content, const fs::path& path) {
  while (!content.empty()) {
    const ssize_t written = ::write(descriptor, content.data(), content.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail_writing(path);
    content.remove_prefix(static_cast<std::size_t>(written));
  }
}

// 64 random bits of the system.
std::uint64_t random_bits() {
  std::uint64_t bits = 0;
  while (::getrandom(&bits, sizeof bits, 0) != static_cast<ssize_t>(sizeof bits)) {
    if (errno != EINTR) throw WorkError(fmt::format("no random numbers of the system: {}", std::strerror(errno)));
  }
  return bits;
}

enum class Lock { kHeld, kRefused, kUnsupported };

// Locks the whole file for this descriptor without waiting; type F_WRLCK or F_RDLCK.
Lock lock(int descriptor, short type) {
  struct flock whole {};
  whole.l_type = type;
  whole.l_whence = SEEK_SET;
  while (::fcntl(descriptor, F_OFD_SETLK, &whole) != 0) {
    if (errno == EAGAIN || errno == EACCES) return Lock::kRefused;
    if (errno != EINTR) return Lock::kUnsupported;
  }
  return Lock::kHeld;
}

// True if the path is this open file, and no link to it.
bool is_open_file(const fs::path& path, int descriptor) {
  struct stat named {
  }, opened{};
  return ::lstat(path.c_str(), &named) == 0 && ::fstat(descriptor, &opened) == 0 && named.st_dev == opened.st_dev &&
         named.st_ino == opened.st_ino;
}

bool is_old(int descriptor) {
  struct stat status {};
  if (::fstat(descriptor, &status) != 0) return false;
  const auto written = std::chrono::system_clock::from_time_t(status.st_mtim.tv_sec);
  return std::chrono::system_clock::now() - written > std::chrono::hours(24);
}

// Calls use() while the leftover is locked, so that no process can begin to write it; false for a file that is none.
template <class Use>
bool with_leftover(const fs::path& file, Use use) {
  if (target_of_temporary(file.filename().native()).empty()) return false;
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return false;
  const Lock state = lock(descriptor, F_RDLCK);
  const bool left = state == Lock::kHeld || (state == Lock::kUnsupported && is_old(descriptor));
  if (left) use();
  ::close(descriptor);
  return left;
}

}  // namespace

TemporaryFile::TemporaryFile(fs::path target) : target_(std::move(target)) {
  for (int attempt = 0; attempt < kMaxAttempts; ++attempt) {
    path_ = target_;
    path_ += fmt::format(".{:016x}{}", random_bits(), kEnding);
    descriptor_ = ::open(path_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    if (descriptor_ < 0 && (errno == EEXIST || errno == EINTR)) continue;
    if (descriptor_ < 0) fail_writing(target_);
    // Between creation and lock, another process may have taken the file for a leftover.
    if (lock(descriptor_, F_WRLCK) != Lock::kRefused && is_open_file(path_, descriptor_)) return;
    ::unlink(path_.c_str());  // if it is still there, nothing but the name could not be looked up
    ::close(std::exchange(descriptor_, -1));
  }
  errno = EBUSY;
  fail_writing(target_);
}

TemporaryFile::~TemporaryFile() {
  if (descriptor_ < 0) return;
  if (is_open_file(path_, descriptor_)) ::unlink(path_.c_str());
  ::close(descriptor_);
}

void TemporaryFile::write(std::string_view content) { write_all(descriptor_, content, target_); }

void TemporaryFile::publish() {
  while (::fsync(descriptor_) != 0) {
    if (errno != EINTR) fail_writing(target_);
  }
  if (!is_open_file(path_, descriptor_)) {
    errno = ENOENT;
    fail_writing(target_);
  }
  if (::rename(path_.c_str(), target_.c_str()) != 0) fail_writing(target_);
  // Reports write errors that a file system delays until now.
  if (::close(std::exchange(descriptor_, -1)) != 0 && errno != EINTR) fail_writing(target_);
}

std::string_view target_of_temporary(std::string_view name) {
  if (!name.ends_with(kEnding)) return {};
  name.remove_suffix(kEnding.size());
  if (name.size() < kDigits + 2 || name[name.size() - kDigits - 1] != '.') return {};
  const auto is_digit = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  if (!std::all_of(name.end() - kDigits, name.end(), is_digit)) return {};
  return name.substr(0, name.size() - kDigits - 1);
}

bool is_leftover(const fs::path& file) {
  return with_leftover(file, [] {});
}

void remove_leftover(const fs::path& file) {
  with_leftover(file, [&] {
    std::error_code ignored;
    fs::remove(file, ignored);
  });
}

void remove_leftovers(const fs::path& folder, std::string_view target) {
  std::vector<fs::path> found;
  std::error_code ended;
  for (fs::directory_iterator it(folder.empty() ? "." : folder, ended), end; !ended && it != end; it.increment(ended)) {
    const std::string name = it->path().filename();
    const std::string_view of = target_of_temporary(name);
    if (!of.empty() && (target.empty() || of == target)) found.push_back(it->path());
  }
  for (const fs::path& file : found) remove_leftover(file);
}

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

// Without O_NONBLOCK, opening a pipe without a writer would block.
constexpr int kReading = O_RDONLY | O_NONBLOCK;

// A name that is wrong, or that may not be read, is an error of the input; a disk or a system that fails is not.
bool is_of_input(int error) {
  constexpr int kOfInput[] = {ENOENT, ENOTDIR, EACCES, EPERM, EISDIR, ELOOP, ENAMETOOLONG, EINVAL, ENXIO, ENODEV};
  return std::ranges::find(kOfInput, error) != std::end(kOfInput);
}

[[noreturn]] void fail_reading(const fs::path& path) {
  const int error = errno;
  const std::string message = fmt::format("{}: cannot read: {}", path.string(), std::strerror(error));
  if (is_of_input(error)) throw InputError(message);
  throw WorkError(message);
}

struct stat status_of_regular(const Descriptor& file, const fs::path& path) {
  struct stat status {};
  if (file.number() < 0 || ::fstat(file.number(), &status) != 0) fail_reading(path);
  if (S_ISDIR(status.st_mode)) throw InputError(fmt::format("{}: cannot read: is a directory", path.string()));
  if (!S_ISREG(status.st_mode)) throw InputError(fmt::format("{}: cannot read: is not a regular file", path.string()));
  return status;
}

template <class Use>
void read_all(const Descriptor& file, const fs::path& path, const Use& use) {
  std::array<char, 65536> buffer;
  while (true) {
    const ssize_t count = ::read(file.number(), buffer.data(), buffer.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail_reading(path);
    if (count == 0) return;
    use(std::string_view(buffer.data(), static_cast<std::size_t>(count)));
  }
}

void write_stream(const fs::path& path, std::string_view content) {
  Descriptor file(path, O_WRONLY);
  if (file.number() < 0) fail_writing(path);
  write_all(file.number(), content, path);
  if (!file.close()) fail_writing(path);
}

// Waits until a renamed file is on the disk. EINVAL, from file systems that cannot synchronise folders, is ignored.
void synchronise_folder(const fs::path& folder) {
  const Descriptor file(folder, O_RDONLY | O_DIRECTORY);
  if (file.number() < 0) fail_writing(folder);
  while (::fsync(file.number()) != 0) {
    if (errno == EINVAL) return;
    if (errno != EINTR) fail_writing(folder);
  }
}

// Creates a file completely or not at all; fill(TemporaryFile&) writes it. A symbolic link is preserved: its target is
// replaced.
template <class Fill>
void replace_file(const fs::path& path, Fill fill) {
  std::error_code error;
  const fs::path resolved = fs::canonical(path, error);
  const fs::path target = error ? path : resolved;
  if (fs::is_directory(target, error)) {
    errno = EISDIR;
    fail_writing(target);
  }
  {
    TemporaryFile temporary(target);
    fill(temporary);
    temporary.publish();
  }
  synchronise_folder(target.has_parent_path() ? target.parent_path() : fs::path("."));
}

// A pipe, terminal or device: written directly, since renaming would replace it.
bool is_stream(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

}  // namespace

bool is_there(const fs::path& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) == 0) return true;
  if (!is_of_input(errno)) fail_reading(path);
  return false;
}

std::string read_file(const fs::path& path, std::size_t max_bytes) {
  const Descriptor file(path, kReading);
  const struct stat status = status_of_regular(file, path);
  const auto too_large = [&](std::uintmax_t size) {
    throw InputError(
        fmt::format("{}: cannot read: has {} bytes, more than the limit of {}", path.string(), size, max_bytes));
  };
  if (static_cast<std::uintmax_t>(status.st_size) > max_bytes) too_large(static_cast<std::uintmax_t>(status.st_size));
  std::string content;
  content.reserve(static_cast<std::size_t>(status.st_size));
  read_all(file, path, [&](std::string_view block) {
    content.append(block);
    if (content.size() > max_bytes) too_large(content.size());
  });
  return content;
}

void read_blocks(const fs::path& path, const std::function<void(std::string_view)>& use) {
  const Descriptor file(path, kReading);
  status_of_regular(file, path);
  read_all(file, path, use);
}

void write_file(const fs::path& path, std::string_view content) {
  if (is_stream(path)) {
    write_stream(path, content);
  } else {
    replace_file(path, [&](TemporaryFile& temporary) { temporary.write(content); });
  }
}

void require_writable(const fs::path& path) {
  if (path.empty() || is_stream(path)) return;
  const fs::path folder = path.parent_path().empty() ? fs::path(".") : path.parent_path();
  if (::access(folder.c_str(), W_OK | X_OK) != 0) fail_writing(path);
}

void write_file_with(const fs::path& path, const std::function<void(const fs::path&)>& write) {
  if (is_stream(path)) throw WorkError(fmt::format("{}: cannot write: is not a regular file", path.string()));
  replace_file(path, [&](TemporaryFile& temporary) {
    write(temporary.path());
    std::error_code error;
    if (fs::file_size(temporary.path(), error) != 0 && !error) return;
    errno = ENOENT;
    fail_writing(path);
  });
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
