// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/npz.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <exception>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
#include <optional>
#include <system_error>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/json.h"

namespace seaglint {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMaxDimensions = 32;  // NumPy's

// The dictionary of a header, {'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }, as JSON.
std::string as_json(std::string_view dictionary) {
  std::string json;
  for (const char c : dictionary) {
    if (c == '}' || c == ')') {
      json.erase(json.find_last_not_of(' ') + 1);
      if (json.ends_with(',')) json.pop_back();
    }
    json += c == '\'' ? '"' : c == '(' ? '[' : c == ')' ? ']' : c;
  }
  for (const auto& [python, word] : {std::pair{"True", "true"}, {"False", "false"}}) {
    const std::size_t at = json.find(python);
    if (at != std::string::npos) json.replace(at, std::strlen(python), word);
  }
  return json;
}

[[noreturn]] void fail_header() { throw InputError("no header of NumPy's .npy format"); }

}  // namespace

const char* numpy_type(ArrayType element) {
  switch (element) {
    case ArrayType::kFloat: return "<f4";
    case ArrayType::kInt64: return "<i8";
    case ArrayType::kUint16: return "<u2";
    case ArrayType::kName: return "|S64";
    default: return "<f8";
  }
}

std::string npy_header(const std::string& type, std::span<const std::uint64_t> shape) {
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}{}), }}", type,
                                 fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
  constexpr std::size_t kAlignment = 64, kBefore = 10;  // magic, version and length
  const std::size_t padded = (kBefore + text.size() + 1 + kAlignment - 1) / kAlignment * kAlignment - kBefore;
  text.resize(padded - 1, ' ');
  text += '\n';
  std::string header = std::string(kMagic) + std::string("\x01\x00", 2);
  header += static_cast<char>(padded & 0xff);
  header += static_cast<char>(padded >> 8);
  return header + text;
}

NpyHeader read_npy_header(std::string_view file) {
  const auto byte = [&](std::size_t i) -> std::size_t {
    if (i >= file.size()) fail_header();
    return static_cast<unsigned char>(file[i]);
  };
  const std::size_t version = byte(kMagic.size());
  if (!file.starts_with(kMagic) || version < 1 || version > 3) fail_header();
  const std::size_t lengths = version == 1 ? 2 : 4, first = kMagic.size() + 2;
  std::size_t text_bytes = 0;
  for (std::size_t i = lengths; i-- > 0;) text_bytes = text_bytes << 8 | byte(first + i);
  if (text_bytes > file.size() - first - lengths) fail_header();

  NpyHeader header;
  header.bytes = first + lengths + text_bytes;
  bool is_fortran = false;
  try {
    const std::string text = as_json(file.substr(first + lengths, text_bytes));
    check_json(text, "header", 3);
    const nlohmann::json json = nlohmann::json::parse(text);
    json.at("descr").get_to(header.type);
    json.at("fortran_order").get_to(is_fortran);
    const nlohmann::json& shape = json.at("shape");
    const bool are_lengths =
        std::ranges::all_of(shape, [](const nlohmann::json& length) { return length.is_number_unsigned(); });
    if (!shape.is_array() || shape.size() > kMaxDimensions || !are_lengths) fail_header();
    shape.get_to(header.shape);
  } catch (const InputError&) {
    fail_header();
  } catch (const nlohmann::json::exception&) {
    fail_header();
  }
  if (is_fortran) throw InputError("is in Fortran order; numpy.ascontiguousarray gives C order");
  return header;
}

std::uint64_t npy_data_bytes(const std::string& type, std::span<const std::uint64_t> shape) {
  std::uint64_t item = 0;
  const auto [end, error] = std::from_chars(type.data() + 2, type.data() + type.size(), item);
  SEAGLINT_CHECK(error == std::errc() && end == type.data() + type.size() && item > 0, type);
  return std::accumulate(shape.begin(), shape.end(), item, std::multiplies<>());
}

namespace {

// MS-DOS time and date of 1980-01-01 00:00.
constexpr zip_uint16_t kFirstTime = 0, kFirstDate = (1 << 5) | 1;

// A member of the archive, read by libzip while it writes the archive.
struct Member {
  std::string name;
  std::string head;  // before the blocks
  NextBlock next;
  std::uint64_t bytes = 0;  // head and blocks

  std::string block;
  std::size_t place = 0;       // in block
  std::uint64_t given = 0;     // bytes passed to libzip
  std::exception_ptr* failed;  // exception of any member's next()

  zip_int64_t read(char* to, zip_uint64_t max_bytes) {
    zip_uint64_t count = 0;
    while (count < max_bytes) {
      if (place == block.size()) {
        block = given + count < head.size() ? head : next();
        place = 0;
        if (block.empty()) break;
      }
      const std::size_t some = std::min<std::size_t>(max_bytes - count, block.size() - place);
      std::memcpy(to + count, block.data() + place, some);
      count += some;
      place += some;
    }
    given += count;
    if (count == 0) SEAGLINT_CHECK(given == bytes, fmt::format("{}: {} bytes, {} announced", name, given, bytes));
    return static_cast<zip_int64_t>(count);
  }
};

zip_int64_t serve(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  auto* member = static_cast<Member*>(user);
  switch (command) {
    case ZIP_SOURCE_OPEN:
    case ZIP_SOURCE_CLOSE:
    case ZIP_SOURCE_FREE: return 0;
    case ZIP_SOURCE_READ: try { return member->read(static_cast<char*>(data), length);
      } catch (...) {  // exceptions must not propagate through a C library
        *member->failed = std::current_exception();
        return -1;
      }
    case ZIP_SOURCE_STAT: {
      auto* stat = static_cast<zip_stat_t*>(data);
      zip_stat_init(stat);
      stat->valid = ZIP_STAT_SIZE;
      stat->size = member->bytes;
      return sizeof(zip_stat_t);
    }
    case ZIP_SOURCE_ERROR: {
      const int error[2] = {ZIP_ER_READ, 0};
      std::memcpy(data, error, sizeof error);
      return sizeof error;
    }
    case ZIP_SOURCE_SUPPORTS: return ZIP_SOURCE_SUPPORTS_READABLE;
    default: return -1;
  }
}

// The file that libzip writes: by itself it would write another one and rename it, without the lock of this one.
class Output {
 public:
  explicit Output(const std::filesystem::path& file) : file_(::open(file.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC)) {
    if (file_ < 0) throw WorkError(std::strerror(errno));
  }
  ~Output() { ::close(file_); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  static zip_int64_t serve(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command) {
    return static_cast<Output*>(user)->serve(data, length, command);
  }

 private:
  zip_int64_t serve(void* data, zip_uint64_t length, zip_source_cmd_t command) {
    switch (command) {
      case ZIP_SOURCE_BEGIN_WRITE:
      case ZIP_SOURCE_COMMIT_WRITE:
      case ZIP_SOURCE_ROLLBACK_WRITE:
      case ZIP_SOURCE_REMOVE:
      case ZIP_SOURCE_CLOSE:
      case ZIP_SOURCE_FREE: return 0;
      case ZIP_SOURCE_WRITE: return write(static_cast<const char*>(data), length);
      case ZIP_SOURCE_TELL_WRITE: return static_cast<zip_int64_t>(place_);
      case ZIP_SOURCE_SEEK_WRITE: {
        const zip_int64_t place = zip_source_seek_compute_offset(place_, end_, data, length, nullptr);
        if (place < 0) return -1;
        place_ = static_cast<zip_uint64_t>(place);
        return 0;
      }
      case ZIP_SOURCE_ERROR: {
        const int error[2] = {error_ == ENOENT ? ZIP_ER_READ : ZIP_ER_WRITE, error_};
        std::memcpy(data, error, sizeof error);
        return sizeof error;
      }
      case ZIP_SOURCE_SUPPORTS: return ZIP_SOURCE_SUPPORTS_WRITABLE;
      default: return -1;  // with ENOENT: an archive that does not exist yet
    }
  }

  zip_int64_t write(const char* bytes, zip_uint64_t length) {
    for (zip_uint64_t done = 0; done < length;) {
      const ssize_t count = ::pwrite(file_, bytes + done, length - done, static_cast<off_t>(place_));
      if (count < 0 && errno == EINTR) continue;
      if (count < 0) {
        error_ = errno;
        return -1;
      }
      done += static_cast<zip_uint64_t>(count);
      place_ += static_cast<zip_uint64_t>(count);
      end_ = std::max(end_, place_);
    }
    return static_cast<zip_int64_t>(length);
  }

  int file_;
  int error_ = ENOENT;
  zip_uint64_t place_ = 0, end_ = 0;
};

struct ErrorEnd {
  void operator()(zip_error_t* error) const { zip_error_fini(error); }
};

void write_archive(const std::filesystem::path& file, std::vector<Member>& members) {
  std::exception_ptr failed;
  Output output(file);
  zip_error_t opening;
  zip_error_init(&opening);
  const std::unique_ptr<zip_error_t, ErrorEnd> ends(&opening);
  zip_source_t* sink = zip_source_function_create(&Output::serve, &output, &opening);
  if (sink == nullptr) throw WorkError(zip_error_strerror(&opening));
  std::unique_ptr<zip_t, decltype(&zip_discard)> archive(
      zip_open_from_source(sink, ZIP_CREATE | ZIP_TRUNCATE, &opening), &zip_discard);
  const auto fail = [&](zip_error_t* error) {
    if (failed) std::rethrow_exception(failed);
    throw WorkError(zip_error_strerror(error));
  };
  if (!archive) {
    zip_source_free(sink);
    throw WorkError(zip_error_strerror(&opening));
  }
  for (Member& member : members) {
    member.failed = &failed;
    zip_source_t* source = zip_source_function(archive.get(), &serve, &member);
    if (source == nullptr) fail(zip_get_error(archive.get()));
    const zip_int64_t index = zip_file_add(archive.get(), member.name.c_str(), source, ZIP_FL_ENC_UTF_8);
    if (index < 0) {
      zip_source_free(source);
      fail(zip_get_error(archive.get()));
    }
    const auto number = static_cast<zip_uint64_t>(index);
    if (zip_set_file_compression(archive.get(), number, ZIP_CM_STORE, 0) != 0 ||
        zip_file_set_dostime(archive.get(), number, kFirstTime, kFirstDate, 0) != 0) {
      fail(zip_get_error(archive.get()));
    }
  }
  if (zip_close(archive.get()) != 0) fail(zip_get_error(archive.get()));
  static_cast<void>(archive.release());  // closed
}

using ArchiveToRead = std::unique_ptr<zip_t, decltype(&zip_discard)>;

// Null when the file is no archive.
ArchiveToRead open_to_read(const std::filesystem::path& file) {
  int code = 0;
  return {zip_open(file.c_str(), ZIP_RDONLY, &code), &zip_discard};
}

// Throws InputError when the file is no archive.
ArchiveToRead opened(const std::filesystem::path& file) {
  ArchiveToRead archive = open_to_read(file);
  if (!archive) throw InputError(fmt::format("{}: no .npz archive of NumPy, or truncated", file.string()));
  return archive;
}

// Bytes of a member, checked against its checksum, which the library does at the end; empty when it is damaged.
std::optional<std::string> read_member(zip_t* archive, const std::string& name, std::uint64_t bytes) {
  const std::unique_ptr<zip_file_t, decltype(&zip_fclose)> member(zip_fopen(archive, name.c_str(), 0), &zip_fclose);
  if (!member) return {};
  std::string text(bytes, '\0');
  if (zip_fread(member.get(), text.data(), bytes) != static_cast<zip_int64_t>(bytes)) return {};
  char beyond = 0;
  if (zip_fread(member.get(), &beyond, 1) != 0) return {};
  return text;
}

template <class To, class Stored>
std::vector<To> converted(const std::string& bytes) {
  std::vector<To> values(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < values.size(); ++i) {
    Stored value;
    std::memcpy(&value, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    values[i] = static_cast<To>(value);
  }
  return values;
}

}  // namespace

NpzArray npz_array(std::string name, std::string type, std::vector<std::uint64_t> shape, std::string bytes) {
  return {std::move(name), std::move(type), std::move(shape),
          [bytes = std::move(bytes)]() mutable { return std::exchange(bytes, std::string()); }};
}

std::string read_npz_text(const std::filesystem::path& file, const std::string& name) {
  constexpr zip_uint64_t kMaxBytes = 4 << 20;
  const auto fail = [&] { throw InputError(fmt::format("{}: no archive with a {} inside", file.string(), name)); };
  const ArchiveToRead archive = open_to_read(file);
  if (!archive) fail();
  zip_stat_t stat;
  if (zip_stat(archive.get(), name.c_str(), 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE) || stat.size > kMaxBytes)
    fail();
  const std::optional<std::string> text = read_member(archive.get(), name, stat.size);
  if (!text) fail();
  return *text;
}

std::vector<std::string> npz_members(const std::filesystem::path& file) {
  const ArchiveToRead archive = opened(file);
  std::vector<std::string> names;
  for (zip_int64_t i = 0; i < zip_get_num_entries(archive.get(), 0); ++i) {
    const char* name = zip_get_name(archive.get(), static_cast<zip_uint64_t>(i), 0);
    if (name != nullptr) names.emplace_back(name);
  }
  return names;
}

std::string NpzValues::shape_text() const {
  return fmt::format("({}{})", fmt::join(shape, ", "), shape.size() == 1 ? "," : "");
}

std::vector<double> NpzValues::numbers() const {
  if (type == "<f4") return converted<double, float>(bytes);
  if (type == "<f8") return converted<double, double>(bytes);
  if (type == "<i4") return converted<double, std::int32_t>(bytes);
  if (type == "<i8") return converted<double, std::int64_t>(bytes);
  if (type == "<u2") return converted<double, std::uint16_t>(bytes);
  throw InputError(fmt::format("type {}: must be <f4, <f8, <i4, <i8 or <u2", shown(type)));
}

std::vector<std::complex<double>> NpzValues::complex_numbers() const {
  if (type == "<c8") return converted<std::complex<double>, std::complex<float>>(bytes);
  if (type == "<c16") return converted<std::complex<double>, std::complex<double>>(bytes);
  throw InputError(fmt::format("type {}: must be <c8 or <c16", shown(type)));
}

NpzValues read_npz_array(const std::filesystem::path& file, const std::string& name) {
  const auto fail = [&](const std::string& why) {
    throw InputError(fmt::format("{}: array {}: {}", file.string(), name, why));
  };
  const ArchiveToRead archive = opened(file);
  const std::string member = name + ".npy";
  zip_stat_t stat;
  constexpr zip_uint64_t kNeeded = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_COMP_METHOD;
  if (zip_stat(archive.get(), member.c_str(), 0, &stat) != 0 || (stat.valid & kNeeded) != kNeeded) fail("is missing");
  if (stat.comp_method != ZIP_CM_STORE) fail("is compressed; numpy.savez writes archives that are not");
  std::error_code error;
  if (stat.size != stat.comp_size || stat.size > std::filesystem::file_size(file, error) || error)
    fail("claims more bytes than the file has");
  std::optional<std::string> bytes = read_member(archive.get(), member, stat.size);
  if (!bytes) fail("is damaged");
  NpzValues values;
  try {
    NpyHeader header = read_npy_header(*bytes);
    bytes->erase(0, header.bytes);
    values = {std::move(header.type), std::move(header.shape), std::move(*bytes)};
  } catch (const InputError& wrong) {
    fail(wrong.what());
  }
  // The bytes of an element, by the digits of its type; types without are no numbers.
  std::uint64_t item = 0;
  const char* const end = values.type.data() + values.type.size();
  if (values.type.size() < 3 || std::from_chars(values.type.data() + 2, end, item).ptr != end || item == 0 || item > 16)
    fail(fmt::format("type {}: no array of numbers", shown(values.type)));
  std::uint64_t left = values.bytes.size() / item;  // elements that the bytes suffice for, at every dimension
  bool fits = values.bytes.size() % item == 0;
  for (const std::uint64_t length : values.shape) {
    fits = fits && (length == 0 ? values.bytes.empty() : left % length == 0);
    if (length > 0) left /= length;
  }
  const bool empty = std::ranges::find(values.shape, std::uint64_t{0}) != values.shape.end();
  if (!fits || (!empty && left != 1))
    fail(fmt::format("{} bytes of values for {} of {}", values.bytes.size(), values.shape_text(), values.type));
  return values;
}

void require_npz(const std::filesystem::path& file) {
  if (!file.empty() && file.extension() != ".npz")
    throw InputError(fmt::format("{}: NumPy's archives end in .npz", file.string()));
  require_writable(file);
}

void write_npz(const std::filesystem::path& file, const std::vector<NpzArray>& arrays,
               const std::vector<NpzText>& texts) {
  std::vector<Member> members;
  const auto add = [&](std::string name, std::string head, NextBlock next, std::uint64_t bytes) {
    Member& member = members.emplace_back();
    member.bytes = head.size() + bytes;
    member.name = std::move(name);
    member.head = std::move(head);
    member.next = std::move(next);
  };
  for (const NpzArray& array : arrays)
    add(array.name + ".npy", npy_header(array.type, array.shape), array.next, npy_data_bytes(array.type, array.shape));
  for (const NpzText& text : texts)
    add(
        text.name, text.text, [] { return std::string(); }, 0);
  write_file_with(file, [&](const std::filesystem::path& temporary) {
    try {
      write_archive(temporary, members);
    } catch (const Interrupted&) {
      throw;
    } catch (const WorkError& error) {
      throw WorkError(fmt::format("{}: cannot write: {}", file.string(), error.what()));
    }
  });
}

}  // namespace seaglint
