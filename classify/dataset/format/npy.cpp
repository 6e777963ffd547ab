// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/npy.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <functional>
#include <numeric>

#include "sim/core/process/error.h"

namespace seaglint {

static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

namespace {

constexpr std::string_view kMagic = "\x93NUMPY";
constexpr std::size_t kMaxDimensions = 32;  // NumPy's

// The dictionary of a header: {'descr': '<f8', 'fortran_order': False, 'shape': (2, 3), }, keys in any order.
class HeaderText {
 public:
  explicit HeaderText(std::string_view text) : text_(text) {}

  bool accept(std::string_view token) {
    while (!text_.empty() && (text_.front() == ' ' || text_.front() == '\n')) text_.remove_prefix(1);
    if (!text_.starts_with(token)) return false;
    text_.remove_prefix(token.size());
    return true;
  }

  void expect(std::string_view token) {
    if (!accept(token)) fail();
  }

  std::string quoted() {
    const char* quote = accept("'") ? "'" : "\"";
    if (*quote == '"') expect(quote);
    const std::size_t end = text_.find(*quote);
    if (end == std::string_view::npos) fail();
    std::string word(text_.substr(0, end));
    text_.remove_prefix(end + 1);
    return word;
  }

  std::vector<std::uint64_t> lengths() {
    std::vector<std::uint64_t> values;
    expect("(");
    while (!accept(")")) {
      accept("");  // blanks
      std::uint64_t value = 0;
      const auto [end, error] = std::from_chars(text_.data(), text_.data() + text_.size(), value);
      if (error != std::errc() || values.size() == kMaxDimensions) fail();
      text_.remove_prefix(static_cast<std::size_t>(end - text_.data()));
      values.push_back(value);
      if (!accept(",")) {
        expect(")");
        break;
      }
    }
    return values;
  }

  [[noreturn]] static void fail() { throw InputError("no header of NumPy's .npy format"); }

 private:
  std::string_view text_;
};

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
  std::string lengths;
  for (const std::uint64_t length : shape) lengths += fmt::format("{}, ", length);
  if (shape.size() > 1) lengths.resize(lengths.size() - 2);
  if (shape.size() == 1) lengths.pop_back();
  std::string text = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}), }}", type, lengths);
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
    if (i >= file.size()) HeaderText::fail();
    return static_cast<unsigned char>(file[i]);
  };
  const std::size_t version = byte(kMagic.size());
  if (!file.starts_with(kMagic) || version < 1 || version > 3) HeaderText::fail();
  const std::size_t lengths = version == 1 ? 2 : 4, first = kMagic.size() + 2;
  std::size_t text_bytes = 0;
  for (std::size_t i = lengths; i-- > 0;) text_bytes = text_bytes << 8 | byte(first + i);
  if (text_bytes > file.size() - first - lengths) HeaderText::fail();

  NpyHeader header;
  header.bytes = first + lengths + text_bytes;
  HeaderText text(file.substr(first + lengths, text_bytes));
  text.expect("{");
  std::vector<std::string> found;
  while (!text.accept("}")) {
    const std::string key = text.quoted();
    if (std::ranges::find(found, key) != found.end()) HeaderText::fail();
    found.push_back(key);
    text.expect(":");
    if (key == "descr") {
      header.type = text.quoted();
    } else if (key == "shape") {
      header.shape = text.lengths();
    } else if (key != "fortran_order") {
      HeaderText::fail();
    } else if (!text.accept("False")) {
      text.expect("True");
      throw InputError("is in Fortran order; numpy.ascontiguousarray gives C order");
    }
    if (!text.accept(",")) {
      text.expect("}");
      break;
    }
  }
  if (found.size() != 3) HeaderText::fail();
  return header;
}

std::uint64_t npy_data_bytes(const std::string& type, std::span<const std::uint64_t> shape) {
  std::uint64_t item = 0;
  const auto [end, error] = std::from_chars(type.data() + 2, type.data() + type.size(), item);
  SEAGLINT_CHECK(error == std::errc() && end == type.data() + type.size() && item > 0, type);
  return std::accumulate(shape.begin(), shape.end(), item, std::multiplies<>());
}

}  // namespace seaglint
