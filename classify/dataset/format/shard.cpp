// SPDX-License-Identifier: BSD-3-Clause
#include "classify/dataset/format/shard.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <utility>

#include "classify/dataset/format/hdf5_file.h"
#include "classify/dataset/format/manifest.h"
#include "sim/core/process/error.h"
#include "sim/core/process/file.h"
#include "sim/scenario/fields.h"

namespace seaglint {

namespace {

constexpr const char* kShardFormat = "seaglint shard 5";
constexpr const char* kClasses = "classes";
constexpr std::string_view kBetween = ", ";
constexpr std::size_t kMaxBytes = std::size_t{64} << 30;  // a limit beyond every scenario's

constexpr const char* kNumbers = "drawn_numbers";
constexpr const char* kWords = "drawn_words";
constexpr std::string_view kDrawn = "/drawn/";

std::string drawn_path(const std::string& key) { return std::string(kDrawn) + key; }

std::vector<std::string> keys_of(const Hdf5Reader& file, const char* attribute) {
  std::vector<std::string> keys;
  std::istringstream list(file.attribute(attribute));
  for (std::string key; list >> key;) {
    const bool is_key = std::all_of(key.begin(), key.end(), [](unsigned char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-' ||
             c == '.';
    });
    if (!is_key || key.front() == '.') throw WorkError(fmt::format("attribute {}: a name is no key", attribute));
    keys.push_back(std::move(key));
  }
  return keys;
}

void check_shapes(const Shard& shard, int max_centres) {
  SEAGLINT_CHECK(!shard.samples.empty() && max_centres >= 1, "a shard contains at least one sample and one centre");
  const Sample& first = shard.samples.front();
  for (const Sample& sample : shard.samples) {
    SEAGLINT_CHECK(look_count(sample) == look_count(first), "equal numbers of looks");
    for (std::size_t i = 0; i < look_count(sample); ++i) {
      const Sample& look = look_of(sample, i);
      SEAGLINT_CHECK(look.magnitude.size() == shard.axes.cells(),
                     fmt::format("{} cells, axes say {}", look.magnitude.size(), shard.axes.cells()));
      SEAGLINT_CHECK(look.complex_values.size() == first.complex_values.size() &&
                         (look.complex_values.empty() || look.complex_values.size() == 2 * shard.axes.cells()),
                     "complex maps for all samples or none");
      SEAGLINT_CHECK(look.echo.size() == first.echo.size() && look.echo.size() % (2 * first.hop_code.size()) == 0,
                     "echoes of equal size for all samples or none");
      SEAGLINT_CHECK(!look.hop_code.empty() && look.hop_code.size() == first.hop_code.size(), "equal pulses");
    }
  }
}

// Writes a complete array.
template <class T>
void write_values(Hdf5Writer& file, const StoredArray& array, const Dimensions& size, const Dimensions& chunk,
                  const std::vector<T>& values) {
  file.array(array.path, array_type_of<T>(), size, chunk, array.text());
  file.write<T>(array.path, 0, values);
}

}  // namespace

DrawnKeys drawn_keys(const SampleRecord& record) {
  DrawnKeys keys;
  for (const auto& drawn : record.drawn_numbers) keys.numbers.push_back(drawn.key);
  for (const auto& drawn : record.drawn_words) keys.words.push_back(drawn.key);
  return keys;
}

DrawnKeys read_drawn_keys(const Hdf5Reader& file) { return {keys_of(file, kNumbers), keys_of(file, kWords)}; }

ArrayText drawn_text(const std::string& key) {
  const std::string unit(unit_of(key));
  return {unit.empty() ? "1" : unit, "drawn value of the scenario's key " + key};
}

namespace {

StoredColumn stored_column(const std::string& path, const SampleColumn& column, std::span<const SampleRecord> rows,
                           std::span<const std::string> classes) {
  return std::visit(
      [&]<class T>(T SampleRecord::*member) {
        std::vector<T> values;
        for (const SampleRecord& row : rows) values.push_back(row.*member);
        return StoredColumn{path, column_text(column, classes), std::move(values)};
      },
      column.member);
}

}  // namespace

std::vector<SampleRecord> look_rows(std::span<const Sample> samples) {
  std::vector<SampleRecord> rows;
  for (const Sample& sample : samples)
    for (std::size_t look = 0; look < look_count(sample); ++look) rows.push_back(look_of(sample, look).record);
  return rows;
}

std::vector<StoredColumn> stored_look_columns(std::span<const SampleRecord> look_rows,
                                              std::span<const std::string> classes) {
  std::vector<StoredColumn> columns;
  for (const SampleColumn& column : look_columns())
    columns.push_back(stored_column(look_path(column), column, look_rows, classes));
  return columns;
}

StoredColumns stored_columns(std::span<const SampleRecord> rows, std::span<const std::string> classes) {
  StoredColumns columns;
  for (const SampleColumn& column : sample_columns())
    columns.samples.push_back(stored_column(column_path(column), column, rows, classes));
  const DrawnKeys keys = drawn_keys(rows.front());
  for (const SampleRecord& row : rows) SEAGLINT_CHECK(drawn_keys(row) == keys, "all samples have the same drawn keys");
  const auto add = [&](const std::vector<std::string>& names, auto drawn) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      std::vector<std::decay_t<decltype((rows.front().*drawn)[i].value)>> values;
      for (const SampleRecord& row : rows) values.push_back((row.*drawn)[i].value);
      columns.drawn.push_back({drawn_path(names[i]), drawn_text(names[i]), std::move(values)});
    }
  };
  add(keys.numbers, &SampleRecord::drawn_numbers);
  add(keys.words, &SampleRecord::drawn_words);
  return columns;
}

void create_column(Hdf5Writer& file, const StoredColumn& column, std::uint64_t rows, std::uint64_t chunk,
                   std::uint64_t looks) {
  Dimensions size{rows}, of_chunk{chunk};
  if (looks > 1) size.push_back(looks), of_chunk.push_back(looks);
  std::visit(
      [&]<class T>(const std::vector<T>&) { file.array(column.path, array_type_of<T>(), size, of_chunk, column.text); },
      column.values);
}

void create_drawn(Hdf5Writer& file, const StoredColumns& columns, std::uint64_t rows, std::uint64_t chunk) {
  if (columns.drawn.empty()) return;
  std::vector<std::string> numbers, words;
  for (const StoredColumn& column : columns.drawn)
    (column.values.index() == 1 ? numbers : words).push_back(column.path.substr(kDrawn.size()));
  if (!numbers.empty()) file.attribute(kNumbers, fmt::format("{}", fmt::join(numbers, " ")));
  if (!words.empty()) file.attribute(kWords, fmt::format("{}", fmt::join(words, " ")));
  file.group("/drawn");
  for (const StoredColumn& column : columns.drawn) create_column(file, column, rows, chunk);
}

void write_column(Hdf5Writer& file, const StoredColumn& column, std::uint64_t first) {
  std::visit([&]<class T>(const std::vector<T>& values) { file.write<T>(column.path, first, values); }, column.values);
}

std::vector<SampleRecord> read_rows(const Hdf5Reader& file, std::uint64_t first, std::uint64_t count) {
  std::vector<SampleRecord> rows(count);
  for (const SampleColumn& column : sample_columns()) {
    std::visit(
        [&]<class T>(T SampleRecord::*member) {
          std::vector<T> values = file.rows<T>(column_path(column), first, count);
          for (std::size_t i = 0; i < rows.size(); ++i) rows[i].*member = std::move(values[i]);
        },
        column.member);
  }
  const DrawnKeys keys = read_drawn_keys(file);
  const auto read = [&]<class T>(const std::vector<std::string>& names,
                                 std::vector<DrawnValue<T>> SampleRecord::*drawn) {
    for (const std::string& key : names) {
      std::vector<T> values = file.rows<T>(drawn_path(key), first, count);
      for (std::size_t i = 0; i < rows.size(); ++i) (rows[i].*drawn).push_back({key, std::move(values[i])});
    }
  };
  read(keys.numbers, &SampleRecord::drawn_numbers);
  read(keys.words, &SampleRecord::drawn_words);
  return rows;
}

std::string differing_column(const SampleRecord& a, const SampleRecord& b) {
  for (const SampleColumn& column : sample_columns()) {
    const bool same = std::visit(
        [&](auto member) { return a.*member == b.*member || (a.*member != a.*member && b.*member != b.*member); },
        column.member);
    if (!same) return column_path(column);
  }
  return same_drawn(a, b) ? "" : "a drawn value";
}

std::vector<SampleRecord> Shard::rows() const {
  std::vector<SampleRecord> rows;
  for (const Sample& sample : samples) rows.push_back(sample.record);
  return rows;
}

namespace {

constexpr Hdf5Version kFileVersion = Hdf5Version::k18;

void write_content(Hdf5Writer& file, const Shard& shard, int max_centres) {
  file.attribute("format", kShardFormat);
  file.attribute("program_version", shard.origin.program_version);
  file.attribute("processor", shard.origin.processor);
  if (shard.classes != default_classes())
    file.attribute(kClasses, fmt::format("{}", fmt::join(shard.classes, kBetween)));

  const StoredAxes& axes = shard.axes;
  const std::uint64_t n = shard.samples.size(), rows = axes.velocity_mps.size(), columns = axes.range_m.size();
  file.group("/axes");
  write_values(file, kRangeAxis, {columns}, {columns}, axes.range_m);
  write_values(file, kVelocityAxis, {rows}, {rows}, axes.velocity_mps);

  std::vector<float> maps, complex_maps;
  std::vector<double> echoes;
  std::vector<std::uint16_t> codes;
  const std::uint64_t pulses = shard.samples.front().hop_code.size(), looks = look_count(shard.samples.front());
  const auto centres = static_cast<std::uint64_t>(max_centres);
  std::vector<float> centre_table(n * looks * centres * 3, 0.0f);
  for (std::size_t i = 0; i < n * looks; ++i) {
    const Sample& look = look_of(shard.samples[i / looks], i % looks);
    maps.insert(maps.end(), look.magnitude.begin(), look.magnitude.end());
    complex_maps.insert(complex_maps.end(), look.complex_values.begin(), look.complex_values.end());
    echoes.insert(echoes.end(), look.echo.begin(), look.echo.end());
    codes.insert(codes.end(), look.hop_code.begin(), look.hop_code.end());
    for (std::size_t k = 0; k < std::min<std::size_t>(look.centre_list.size(), centres); ++k) {
      std::copy(look.centre_list[k].begin(), look.centre_list[k].end(), centre_table.begin() + (i * centres + k) * 3);
    }
  }
  const auto write = [&](const StoredArray& array, Dimensions of_look, const auto& values) {
    Dimensions size{n}, chunk{1};
    if (looks > 1) size.push_back(looks), chunk.push_back(1);
    size.insert(size.end(), of_look.begin(), of_look.end());
    chunk.insert(chunk.end(), of_look.begin(), of_look.end());
    write_values(file, array, size, chunk, values);
  };
  write(kMaps, {rows, columns}, maps);
  if (!complex_maps.empty()) write(kComplexMaps, {rows, columns, 2}, complex_maps);
  if (!echoes.empty()) write(kEchoes, {pulses, echoes.size() / (2 * n * looks * pulses), 2}, echoes);
  write(kHopCodes, {pulses}, codes);
  write(kCentres, {centres, 3}, centre_table);
  file.group("/samples");
  const StoredColumns table = stored_columns(shard.rows(), shard.classes);
  for (const StoredColumn& column : table.samples) {
    create_column(file, column, n, n);
    write_column(file, column, 0);
  }
  create_drawn(file, table, n, n);
  for (const StoredColumn& column : table.drawn) write_column(file, column, 0);
  if (looks == 1) return;
  file.group("/looks");
  for (const StoredColumn& column : stored_look_columns(look_rows(shard.samples), shard.classes)) {
    create_column(file, column, n, n, looks);
    write_column(file, column, 0);
  }
}

void expect(bool condition, const std::string& what) {
  if (!condition) throw WorkError(what);
}

// "decoys, ship" as two names, which contain no comma.
std::vector<std::string> classes_of(const std::string& names) {
  std::vector<std::string> classes;
  for (std::size_t begin = 0; begin <= names.size();) {
    const std::size_t end = std::min(names.find(kBetween, begin), names.size());
    classes.push_back(names.substr(begin, end - begin));
    begin = end + kBetween.size();
  }
  return classes;
}

// The columns of /looks into the rows of n samples; the first look's are those of /samples.
template <class LookAt>
void read_look_columns(const Hdf5Reader& file, std::size_t looks, const LookAt& look, std::size_t n) {
  for (const SampleColumn& column : look_columns()) {
    std::visit(
        [&]<class T>(T SampleRecord::*member) {
          if constexpr (std::is_same_v<T, std::string>) return;  // no column of a look
          const ReadArray<T> values = file.read<T>(look_path(column), 2);
          expect(values.size == Dimensions{n, looks}, fmt::format("{} does not fit /maps", look_path(column)));
          for (std::size_t i = 0; i < n * looks; ++i) {
            const bool is_first = i % looks == 0;
            const T &stored = values.values[i], &of_sample = look(i).record.*member;
            expect(!is_first || stored == of_sample || (stored != stored && of_sample != of_sample),
                   fmt::format("{} is not that of {} in a first look", look_path(column), column_path(column)));
            look(i).record.*member = stored;
          }
        },
        column.member);
  }
}

Shard read_content(const ShardFile& loaded) {
  const Hdf5Reader file(loaded.image);
  const std::string format = file.attribute("format");
  expect(!format.empty(), "the attribute format is missing");
  if (format != kShardFormat) {
    throw UnsupportedFormat(
        fmt::format("{}: format \"{}\"; this program reads \"{}\"", loaded.path.string(), format, kShardFormat));
  }
  Shard shard;
  shard.origin = {file.attribute("program_version"), file.attribute("processor")};
  if (const std::string names = file.attribute(kClasses); !names.empty()) shard.classes = classes_of(names);
  shard.axes.range_m = file.read<double>(kRangeAxis.path, 1).values;
  shard.axes.velocity_mps = file.read<double>(kVelocityAxis.path, 1).values;
  const std::size_t cells = shard.axes.cells();
  expect(cells > 0, "the axes are empty");
  // Dimensions of an array without that of the looks.
  const Dimensions of_maps = file.size(kMaps.path);
  const std::size_t looks = of_maps.size() == 4 ? of_maps[1] : 1;
  expect(looks >= 1, "/maps has no look");
  const auto read = [&]<class T>(const StoredArray& array, std::size_t rank, std::type_identity<T>) {
    ReadArray<T> values = file.read<T>(array.path, looks > 1 ? rank + 1 : rank);
    if (looks > 1) {
      expect(values.size[1] == looks, fmt::format("{} does not fit the looks of /maps", array.path));
      values.size.erase(values.size.begin() + 1);
    }
    return values;
  };
  const ReadArray<float> maps = read(kMaps, 3, std::type_identity<float>());
  const std::size_t n = maps.size[0];
  expect(n > 0 && maps.size[1] == shard.axes.velocity_mps.size() && maps.size[2] == shard.axes.range_m.size(),
         "/maps does not fit the axes");
  shard.samples.resize(n);
  for (Sample& sample : shard.samples) sample.further_looks.resize(looks - 1);
  const auto look = [&](std::size_t i) -> Sample& {
    Sample& sample = shard.samples[i / looks];
    return i % looks == 0 ? sample : sample.further_looks[i % looks - 1];
  };
  // Gives each look its part of the values of an array.
  const auto divide = [&](const auto& values, auto member) {
    const std::size_t each = values.size() / (n * looks);
    for (std::size_t i = 0; i < n * looks; ++i)
      (look(i).*member).assign(values.begin() + i * each, values.begin() + (i + 1) * each);
  };
  divide(maps.values, &Sample::magnitude);
  if (file.has(kComplexMaps.path)) {
    const std::vector<float> values = read(kComplexMaps, 4, std::type_identity<float>()).values;
    expect(values.size() == 2 * n * looks * cells, "/maps_complex does not fit /maps");
    divide(values, &Sample::complex_values);
  }
  const ReadArray<std::uint16_t> codes = read(kHopCodes, 2, std::type_identity<std::uint16_t>());
  expect(codes.size[0] == n, "/hop_code does not fit /maps");
  const std::size_t pulses = codes.size[1];
  divide(codes.values, &Sample::hop_code);
  if (file.has(kEchoes.path)) {
    const ReadArray<double> echoes = read(kEchoes, 4, std::type_identity<double>());
    expect(echoes.size[0] == n && echoes.size[1] == pulses && echoes.size[3] == 2, "/echoes does not fit /hop_code");
    divide(echoes.values, &Sample::echo);
  }
  const ReadArray<float> centres = read(kCentres, 3, std::type_identity<float>());
  expect(centres.size[0] == n && centres.size[2] == 3, "/centres does not fit /maps");
  const std::size_t max_centres = centres.size[1];

  for (const SampleColumn& column : sample_columns())
    expect(file.size(column_path(column)) == Dimensions{n}, fmt::format("{} does not fit /maps", column_path(column)));
  std::vector<SampleRecord> rows = read_rows(file, 0, n);
  for (std::size_t i = 0; i < n * looks; ++i) look(i).record = rows[i / looks];
  if (looks > 1) read_look_columns(file, looks, look, n);
  for (std::size_t i = 0; i < n * looks; ++i) {
    const std::int64_t count = look(i).record.centres;
    expect(count >= 0 && static_cast<std::size_t>(count) <= max_centres, "/samples/centres does not fit /centres");
    for (std::size_t k = 0; k < static_cast<std::size_t>(count); ++k) {
      const float* row = centres.values.data() + (i * max_centres + k) * 3;
      look(i).centre_list.push_back({row[0], row[1], row[2]});
    }
  }
  return shard;
}

}  // namespace

std::string shard_name(std::size_t index) { return fmt::format("shard_{:05}.h5", index); }

std::string write_shard(const std::filesystem::path& file, const Shard& shard, int max_centres) {
  check_shapes(shard, max_centres);
  for (const Sample& sample : shard.samples) {
    if (sample.record.target_name.size() > kNameBytes) {
      throw InputError(
          fmt::format("targets.{}: the name has more than {} bytes", sample.record.target_name, kNameBytes));
    }
  }
  std::string written;
  write_file_with(file, [&](const std::filesystem::path& temporary) {
    try {
      Hdf5Writer content(temporary, kFileVersion);
      write_content(content, shard, max_centres);
      content.close();
      written = sha256_file(temporary);
    } catch (const WorkError& error) {
      throw WorkError(fmt::format("{}: {}", file.string(), error.what()));
    }
  });
  return written;
}

ShardFile load_shard(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) throw InputError(fmt::format("{}: no such shard", file.string()));
  ShardFile loaded{file, {read_file(file, kMaxBytes)}, {}};
  loaded.sha256 = sha256(loaded.image.bytes);
  return loaded;
}

Shard read_shard(const ShardFile& file) {
  try {
    return read_content(file);
  } catch (const WorkError& error) {
    throw InputError(fmt::format("{}: {}", file.path.string(), error.what()));
  }
}

Shard read_shard(const std::filesystem::path& file) { return read_shard(load_shard(file)); }

bool is_as_written(const ShardFile& file, const Shard& content, int max_centres) {
  Hdf5Writer again(kFileVersion);
  write_content(again, content, max_centres);
  return has_bytes_of(file.image, again.image());
}

}  // namespace seaglint
