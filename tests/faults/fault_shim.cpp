// SPDX-License-Identifier: BSD-3-Clause
// A library for LD_PRELOAD that lets one call on a path below a folder fail: see fault_counts.h. Calls of the C library
// among themselves are not seen; those of stdio are counted as what they are, `fwrite` as a write.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>

#include "tests/faults/fault_counts.h"

namespace {

using seaglint::FaultCounts;
using seaglint::FaultKind;
using seaglint::kFaultKinds;
using seaglint::kKill;
using seaglint::kShort;
using seaglint::kStop;

// The function of this name that the program would call without this library.
template <class Function>
Function next_function(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

// As set by the environment; a null folder if the library does nothing.
struct Plan {
  const char* folder = nullptr;
  std::size_t folder_length = 0;
  FaultCounts* counts = nullptr;
  int kind = -1;
  std::uint64_t number = 0;
  int error = 0;
  char end[64] = {};  // of the path
};

Plan plan_of_environment() {
  Plan plan;
  const char* const folder = std::getenv("SEAGLINT_FAULT_FOLDER");
  const char* const counts = std::getenv("SEAGLINT_FAULT_COUNTS");
  if (folder == nullptr || counts == nullptr) return plan;
  const int file = static_cast<int>(::syscall(SYS_openat, AT_FDCWD, counts, O_RDWR | O_CLOEXEC));
  if (file < 0) return plan;
  void* const mapped = ::mmap(nullptr, sizeof(FaultCounts), PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
  ::syscall(SYS_close, file);
  if (mapped == MAP_FAILED) return plan;
  plan.counts = static_cast<FaultCounts*>(mapped);
  char kind[16] = {};
  unsigned long long number = 0;
  int error = 0;
  const char* const fault = std::getenv("SEAGLINT_FAULT");
  if (fault != nullptr && ::sscanf(fault, "%15[a-z]:%llu:%d:%63s", kind, &number, &error, plan.end) >= 3) {
    for (std::size_t i = 0; i < kFaultKinds.size(); ++i)
      if (std::strcmp(kind, kFaultKinds[i]) == 0) plan.kind = static_cast<int>(i);
    plan.number = number;
    plan.error = error;
  }
  plan.folder_length = std::strlen(folder);
  plan.folder = folder;
  return plan;
}

const Plan& plan() {
  static const Plan planned = plan_of_environment();
  return planned;
}

bool is_below_folder(const char* path) {
  return std::strncmp(path, plan().folder, plan().folder_length) == 0 &&
         (path[plan().folder_length] == '/' || path[plan().folder_length] == '\0');
}

bool has_end(const char* path) {
  const std::size_t length = std::strlen(path), end = std::strlen(plan().end);
  return length >= end && std::strcmp(path + length - end, plan().end) == 0;
}

// Counts a call on this absolute path; the errno or kShort that it must fail with, or 0.
int fault_at(FaultKind kind, const char* path) {
  if (!is_below_folder(path)) return 0;
  FaultCounts& counts = *plan().counts;
  ++counts.calls[static_cast<std::size_t>(kind)];
  if (static_cast<int>(kind) != plan().kind || !has_end(path) || ++counts.matching != plan().number) return 0;
  ++counts.injected;
  std::strncpy(counts.path.data(), path, counts.path.size() - 1);
  if (plan().error == kKill) ::kill(::getpid(), SIGKILL);
  if (plan().error == kStop) ::kill(::getpid(), SIGSTOP);
  return plan().error == kStop ? 0 : plan().error;
}

// The path of an open descriptor or, for AT_FDCWD, of the working directory; false if it has none.
bool path_of(int descriptor, char (&path)[PATH_MAX]) {
  char link[64];
  if (descriptor == AT_FDCWD)
    std::strcpy(link, "/proc/self/cwd");
  else
    std::snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t length = static_cast<ssize_t>(::syscall(SYS_readlink, link, path, sizeof path - 1));
  if (length < 0) return false;
  path[length] = '\0';
  return true;
}

int fault_at(FaultKind kind, int folder, const char* path) {
  if (plan().folder == nullptr || path == nullptr) return 0;
  if (path[0] == '/') return fault_at(kind, path);
  char whole[PATH_MAX];
  if (!path_of(folder, whole) || std::strlen(whole) + std::strlen(path) + 2 > sizeof whole) return 0;
  if (path[0] != '\0') std::strcat(std::strcat(whole, "/"), path);
  return fault_at(kind, whole);
}

int fault_at(FaultKind kind, int descriptor) {
  const int before = errno;
  char path[PATH_MAX];
  const int fault = plan().folder != nullptr && path_of(descriptor, path) ? fault_at(kind, path) : 0;
  errno = before;
  return fault;
}

template <class Result>
Result failed(int error, Result result) {
  errno = error == kShort ? EIO : error;
  return result;
}

// At least one byte: none would be the end of the file.
std::size_t half(std::size_t bytes) { return std::max<std::size_t>(bytes / 2, std::min<std::size_t>(bytes, 1)); }

void mark_error(FILE* stream) {
  constexpr int kErrorSeen = 0x20;  // of glibc, what ferror() looks at
  stream->_flags |= kErrorSeen;
}

}  // namespace

// `real` is the function of this name that the program would call without this library.
#define SEAGLINT_REAL(name) static const auto real = next_function<decltype(&(name))>(#name)

extern "C" {

// ---- open
#define SEAGLINT_OPEN(name)                                                                     \
  int name(const char* path, int flags, ...) {                                                  \
    va_list more;                                                                               \
    va_start(more, flags);                                                                      \
    const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;      \
    va_end(more);                                                                               \
    SEAGLINT_REAL(name);                                                                        \
    if (const int fault = fault_at(FaultKind::kOpen, AT_FDCWD, path)) return failed(fault, -1); \
    return real(path, flags, mode);                                                             \
  }
SEAGLINT_OPEN(open)
SEAGLINT_OPEN(open64)

#define SEAGLINT_OPENAT(name)                                                                 \
  int name(int folder, const char* path, int flags, ...) {                                    \
    va_list more;                                                                             \
    va_start(more, flags);                                                                    \
    const mode_t mode = (flags & (O_CREAT | __O_TMPFILE)) != 0 ? va_arg(more, mode_t) : 0;    \
    va_end(more);                                                                             \
    SEAGLINT_REAL(name);                                                                      \
    if (const int fault = fault_at(FaultKind::kOpen, folder, path)) return failed(fault, -1); \
    return real(folder, path, flags, mode);                                                   \
  }
SEAGLINT_OPENAT(openat)
SEAGLINT_OPENAT(openat64)

// A function of a path (in a folder) that returns -1, or a null pointer, after a fault.
#define SEAGLINT_OF_PATH(name, kind, result, folder, path, parameters, arguments)                \
  decltype(result) name parameters {                                                             \
    SEAGLINT_REAL(name);                                                                         \
    if (const int fault = fault_at(FaultKind::kind, folder, path)) return failed(fault, result); \
    return real arguments;                                                                       \
  }
using FilePointer = FILE*;
using FolderPointer = DIR*;
using EntryPointer = dirent*;
using Entry64Pointer = dirent64*;
SEAGLINT_OF_PATH(fopen, kOpen, FilePointer{}, AT_FDCWD, path, (const char* path, const char* mode), (path, mode))
SEAGLINT_OF_PATH(fopen64, kOpen, FilePointer{}, AT_FDCWD, path, (const char* path, const char* mode), (path, mode))
SEAGLINT_OF_PATH(opendir, kList, FolderPointer{}, AT_FDCWD, path, (const char* path), (path))
SEAGLINT_OF_PATH(rename, kRename, -1, AT_FDCWD, to, (const char* from, const char* to), (from, to))
SEAGLINT_OF_PATH(renameat, kRename, -1, b, to, (int a, const char* from, int b, const char* to), (a, from, b, to))
SEAGLINT_OF_PATH(truncate, kTruncate, -1, AT_FDCWD, path, (const char* path, off_t size), (path, size))
SEAGLINT_OF_PATH(truncate64, kTruncate, -1, AT_FDCWD, path, (const char* path, off64_t size), (path, size))
SEAGLINT_OF_PATH(unlink, kUnlink, -1, AT_FDCWD, path, (const char* path), (path))
SEAGLINT_OF_PATH(remove, kUnlink, -1, AT_FDCWD, path, (const char* path), (path))
SEAGLINT_OF_PATH(rmdir, kUnlink, -1, AT_FDCWD, path, (const char* path), (path))
SEAGLINT_OF_PATH(unlinkat, kUnlink, -1, folder, path, (int folder, const char* path, int flags), (folder, path, flags))
SEAGLINT_OF_PATH(mkdir, kMkdir, -1, AT_FDCWD, path, (const char* path, mode_t mode), (path, mode))
SEAGLINT_OF_PATH(mkdirat, kMkdir, -1, folder, path, (int folder, const char* path, mode_t mode), (folder, path, mode))
using Status = struct stat;
using Status64 = struct stat64;
SEAGLINT_OF_PATH(stat, kStat, -1, AT_FDCWD, path, (const char* path, Status* status), (path, status))
SEAGLINT_OF_PATH(stat64, kStat, -1, AT_FDCWD, path, (const char* path, Status64* status), (path, status))
SEAGLINT_OF_PATH(lstat, kStat, -1, AT_FDCWD, path, (const char* path, Status* status), (path, status))
SEAGLINT_OF_PATH(lstat64, kStat, -1, AT_FDCWD, path, (const char* path, Status64* status), (path, status))
SEAGLINT_OF_PATH(fstatat, kStat, -1, folder, path, (int folder, const char* path, Status* status, int flags),
                 (folder, path, status, flags))

// A function of a descriptor that returns -1, or a null pointer, after a fault.
#define SEAGLINT_OF_DESCRIPTOR(name, kind, result, descriptor, parameters, arguments)          \
  decltype(result) name parameters {                                                           \
    SEAGLINT_REAL(name);                                                                       \
    if (const int fault = fault_at(FaultKind::kind, descriptor)) return failed(fault, result); \
    return real arguments;                                                                     \
  }
SEAGLINT_OF_DESCRIPTOR(fstat, kStat, -1, file, (int file, Status* status), (file, status))
SEAGLINT_OF_DESCRIPTOR(fstat64, kStat, -1, file, (int file, Status64* status), (file, status))
SEAGLINT_OF_DESCRIPTOR(fsync, kSync, -1, file, (int file), (file))
SEAGLINT_OF_DESCRIPTOR(fdatasync, kSync, -1, file, (int file), (file))
SEAGLINT_OF_DESCRIPTOR(ftruncate, kTruncate, -1, file, (int file, off_t size), (file, size))
SEAGLINT_OF_DESCRIPTOR(ftruncate64, kTruncate, -1, file, (int file, off64_t size), (file, size))
SEAGLINT_OF_DESCRIPTOR(fdopendir, kList, FolderPointer{}, file, (int file), (file))
SEAGLINT_OF_DESCRIPTOR(readdir, kList, EntryPointer{}, ::dirfd(folder), (DIR * folder), (folder))
SEAGLINT_OF_DESCRIPTOR(readdir64, kList, Entry64Pointer{}, ::dirfd(folder), (DIR * folder), (folder))

// A function that transfers bytes.
#define SEAGLINT_TRANSFER(name, kind, parameters, whole, halved)          \
  ssize_t name parameters {                                               \
    SEAGLINT_REAL(name);                                                  \
    const int fault = fault_at(FaultKind::kind, file);                    \
    if (fault != 0 && fault != kShort) return failed(fault, ssize_t{-1}); \
    return fault == kShort ? real halved : real whole;                    \
  }
SEAGLINT_TRANSFER(read, kRead, (int file, void* to, size_t bytes), (file, to, bytes), (file, to, half(bytes)))
SEAGLINT_TRANSFER(pread, kRead, (int file, void* to, size_t bytes, off_t at), (file, to, bytes, at),
                  (file, to, half(bytes), at))
SEAGLINT_TRANSFER(pread64, kRead, (int file, void* to, size_t bytes, off64_t at), (file, to, bytes, at),
                  (file, to, half(bytes), at))
SEAGLINT_TRANSFER(readv, kRead, (int file, const iovec* parts, int count), (file, parts, count), (file, parts, 1))
SEAGLINT_TRANSFER(write, kWrite, (int file, const void* from, size_t bytes), (file, from, bytes),
                  (file, from, half(bytes)))
SEAGLINT_TRANSFER(pwrite, kWrite, (int file, const void* from, size_t bytes, off_t at), (file, from, bytes, at),
                  (file, from, half(bytes), at))
SEAGLINT_TRANSFER(pwrite64, kWrite, (int file, const void* from, size_t bytes, off64_t at), (file, from, bytes, at),
                  (file, from, half(bytes), at))
SEAGLINT_TRANSFER(writev, kWrite, (int file, const iovec* parts, int count), (file, parts, count), (file, parts, 1))

size_t fread(void* to, size_t size, size_t count, FILE* stream) {
  SEAGLINT_REAL(fread);
  const int fault = fault_at(FaultKind::kRead, ::fileno(stream));
  if (fault == 0) return real(to, size, count, stream);
  mark_error(stream);
  return failed(fault, size_t{0});
}

size_t fwrite(const void* from, size_t size, size_t count, FILE* stream) {
  SEAGLINT_REAL(fwrite);
  const int fault = fault_at(FaultKind::kWrite, ::fileno(stream));
  if (fault == 0) return real(from, size, count, stream);
  mark_error(stream);
  return failed(fault, size_t{0});
}

// The descriptor is closed all the same, as Linux does.
int close(int file) {
  SEAGLINT_REAL(close);
  const int fault = fault_at(FaultKind::kClose, file);
  const int result = real(file);
  return fault == 0 ? result : failed(fault, -1);
}

int fclose(FILE* stream) {
  SEAGLINT_REAL(fclose);
  const int fault = fault_at(FaultKind::kClose, ::fileno(stream));
  const int result = real(stream);
  return fault == 0 ? result : failed(fault, EOF);
}

}  // extern "C"
