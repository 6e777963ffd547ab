// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/text/text_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"

namespace seaglint {
namespace {

using namespace std::string_view_literals;

bool is_text_byte(unsigned char c) { return c >= 0x20 ? c != 0x7f : c == '\n' || c == '\r' || c == '\t' || c == '\f'; }

// Minus signs and blanks of typesetting as the characters of ASCII; each stays one character of its line.
std::string with_plain_signs(std::string text) {
  constexpr std::pair<std::string_view, char> kSigns[] = {
      {"\xe2\x88\x92", '-'},  // U+2212, minus sign
      {"\xc2\xa0", ' '},      // U+00A0, no-break space
      {"\xe2\x80\x87", ' '},  // U+2007, figure space
      {"\xe2\x80\x89", ' '},  // U+2009, thin space
      {"\xe2\x80\xaf", ' '},  // U+202F, narrow no-break space
  };
  const auto is_ascii = [](char c) { return static_cast<unsigned char>(c) < 0x80; };
  if (std::all_of(text.begin(), text.end(), is_ascii)) return text;
  std::size_t end = 0;
  for (std::size_t i = 0; i < text.size(); ++end) {
    const std::string_view rest = std::string_view(text).substr(i);
    const auto sign = std::find_if(std::begin(kSigns), std::end(kSigns),
                                   [&](const auto& known) { return rest.starts_with(known.first); });
    const bool known = sign != std::end(kSigns);
    const char c = known ? sign->second : text[i];
    i += known ? sign->first.size() : 1;
    text[end] = c;
  }
  text.resize(end);
  return text;
}

std::string text_of(const std::string& name, std::string bytes) {
  const std::string_view kind = foreign_kind(bytes);
  if (!kind.empty()) throw InputError(fmt::format("{}: no plain text: it is {}", name, kind));
  bytes = plain_lines(std::move(bytes));
  while (bytes.ends_with('\x1a')) bytes.pop_back();
  const auto strange =
      std::find_if(bytes.begin(), bytes.end(), [](char c) { return !is_text_byte(static_cast<unsigned char>(c)); });
  if (strange != bytes.end()) {
    throw InputError(fmt::format("{}:{}: byte 0x{:02x}: no plain text, a binary file or a damaged one", name,
                                 std::count(bytes.begin(), strange, '\n') + 1, static_cast<unsigned char>(*strange)));
  }
  return with_plain_signs(utf8_prefix(bytes) == bytes.size() ? std::move(bytes) : utf8_of(bytes));
}

}  // namespace

std::string_view foreign_kind(std::string_view bytes) {
  struct Kind {
    std::string_view magic, what;
  };
  constexpr Kind kKinds[] = {
      {"\xff\xfe\0\0"sv, "a text in UTF-32: save it as UTF-8"},
      {"\0\0\xfe\xff"sv, "a text in UTF-32: save it as UTF-8"},
      {"\xff\xfe"sv, "a text in UTF-16: save it as UTF-8"},
      {"\xfe\xff"sv, "a text in UTF-16: save it as UTF-8"},
      {"PK\x03\x04"sv, "a zip archive, as are the workbooks of Excel and LibreOffice: save the sheet as CSV"},
      {"\xd0\xcf\x11\xe0"sv, "a workbook of Excel: save the sheet as CSV"},
      {"\x89HDF\r\n\x1a\n"sv, "an HDF5 file, as are those of MATLAB from version 7.3 on: export it as CSV"},
      {"CDF\x01"sv, "a NetCDF file: export it as CSV"},
      {"CDF\x02"sv, "a NetCDF file: export it as CSV"},
      {"MATLAB 5.0 MAT-file"sv, "a file of MATLAB: export it as CSV"},
      {"\x93NUMPY"sv, "an array of NumPy: export it with numpy.savetxt"},
      {"\x1f\x8b"sv, "compressed by gzip: decompress it"},
      {"BZh"sv, "compressed by bzip2: decompress it"},
      {"\xfd\x37zXZ\0"sv, "compressed by xz: decompress it"},
      {"%PDF-"sv, "a PDF document"},
      {"glTF"sv, "a binary glTF mesh"},
  };
  const std::string_view head = bytes.substr(0, 64);
  for (const auto& [magic, what] : kKinds) {
    // The two bytes of UTF-16 may begin any binary file; Latin letters, digits and line ends have zeros.
    const bool by_chance = magic.size() == 2 && magic != "\x1f\x8b" && head.find('\0') == std::string_view::npos;
    if (bytes.starts_with(magic) && !by_chance) return what;
  }
  // OpenFAST's binary output begins with a little-endian int16, 1 to 5.
  if (bytes.size() > 2 && bytes[0] >= 1 && bytes[0] <= 5 && bytes[1] == 0)
    return "binary, perhaps output of OpenFAST (.outb): set OutFileFmt to 1 for text";
  // UTF-16 without a mark: every second byte of Latin letters and digits is 0.
  if (head.size() >= 8) {
    std::size_t zeros[2] = {0, 0};
    for (std::size_t i = 0; i < head.size(); ++i) zeros[i % 2] += head[i] == 0 ? 1 : 0;
    const std::size_t half = head.size() / 2;
    if ((zeros[1] >= half && zeros[0] == 0) || (zeros[0] >= half && zeros[1] == 0))
      return "a text in UTF-16: save it as UTF-8";
  }
  return {};
}

TextSource::TextSource(std::string name, std::string bytes)
    : name_(std::move(name)), text_(std::make_shared<const std::string>(text_of(name_, std::move(bytes)))) {}

TextSource TextSource::read(const std::filesystem::path& file, std::size_t max_bytes) {
  return TextSource(file.string(), read_file(file, max_bytes));
}

int TextSource::line_of(std::string_view part) const {
  return static_cast<int>(std::count(text_->data(), part.data(), '\n')) + 1;
}

std::string TextSource::place(std::string_view part) const {
  const char* begin = part.data();
  while (begin != text_->data() && begin[-1] != '\n') --begin;
  const auto column =
      std::count_if(begin, part.data(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; });
  return fmt::format("{}:{}:{}", name_, line_of(part), column + 1);
}

void TextSource::fail(std::string_view part, const std::string& what) const {
  throw InputError(fmt::format("{}: {}", place(part), what));
}

bool is_comment(std::string_view line) {
  const std::string_view text = trimmed(line);
  return text.starts_with('#') || text.starts_with('%') || text.starts_with("//") || text.starts_with('!');
}

}  // namespace seaglint
