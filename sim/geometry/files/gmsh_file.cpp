// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/shell_model.h"

namespace seaglint {

namespace {

// Whether the second line of the file, "2.2 1 8", declares binary values.
bool declares_binary(std::string_view text) {
  next_line(text);
  std::string_view line = next_line(text);
  next_word(line);
  return next_word(line) == "1";
}

// Sections of Gmsh's .msh files and the values in them, as words of a text or in binary.
class GmshValues {
 public:
  // Reads $MeshFormat. Throws InputError for versions other than 2.0 to 2.2 and 4.1, and other sizes than doubles.
  GmshValues(std::string bytes, std::string file) : file_(std::move(file)) {
    is_binary_ = declares_binary(bytes);
    if (is_binary_) {
      bytes_ = std::move(bytes);
      rest_ = bytes_;
    } else {
      source_.emplace(file_, std::move(bytes));
      rest_ = source_->text();
    }
    at_ = rest_.data();
    read_format();
  }
  GmshValues(const GmshValues&) = delete;
  GmshValues& operator=(const GmshValues&) = delete;

  int version() const { return version_; }  // 2 or 4

  // Moves into the next section; false at the end of the file.
  bool next_section() {
    const std::size_t begin = rest_.find_first_not_of(" \t\r\n");
    if (begin == std::string_view::npos) return false;
    rest_.remove_prefix(begin);
    at_ = rest_.data();
    const std::string_view line = trimmed(next_line(rest_));
    if (!line.starts_with('$') || line.starts_with("$End"))
      fail(fmt::format("{} where a section begins with $", in_quotes(line.substr(0, 40))));
    section_ = line.substr(1);
    return true;
  }
  std::string_view section() const { return section_; }
  // Moves behind $End... of the section; throws InputError where it does not follow, or nowhere.
  void end_section() {
    const std::string_view word = take_word();
    if (!word.starts_with("$End") || word.substr(4) != section_) {
      fail(fmt::format("{} where $End{} belongs: the section has another length than its counts",
                       in_quotes(word.substr(0, 40)), shown(section_)));
    }
  }
  // Binary sections may contain any bytes; the end is looked for behind a line end.
  void skip_section() {
    const std::string end = fmt::format("$End{}", section_);
    std::size_t found = rest_.find(end);
    while (found != std::string_view::npos && found > 0 && rest_[found - 1] != '\n') found = rest_.find(end, found + 1);
    if (found == std::string_view::npos) fail_end();
    rest_.remove_prefix(found);
    end_section();
  }

  // The next value. Throws InputError at the end of the file and for anything else than a number.
  // int32 in binary
  std::int64_t small() { return is_binary_ ? number_at<std::int32_t>(take(4), swap_) : word(); }
  // int64 in binary
  std::int64_t large() { return is_binary_ ? number_at<std::int64_t>(take(8), swap_) : word(); }
  double real() {
    if (is_binary_) return number_at<double>(take(8), swap_);
    const std::string_view text = take_word();
    const std::optional<double> value = parse_any_number(text);
    if (!value) fail(fmt::format("${}: value {}: must be a number", shown(section_), in_quotes(text)));
    return *value;
  }
  // A count or number that is written as text in binary files of version 2, too.
  std::int64_t word() { return integer_of(take_word()); }
  // The rest of the line, as text in binary files too.
  std::string_view line() {
    if (rest_.empty()) fail_end();
    return next_line(rest_);
  }

  const char* at() const { return at_; }  // of the value that was read last
  std::string place(const char* at) const {
    return source_ ? source_->place({at, at}) : fmt::format("{}: byte {}", file_, at - bytes_.data());
  }
  // there
  [[noreturn]] void fail(const std::string& what) const { throw InputError(fmt::format("{}: {}", place(at_), what)); }
  bool is_binary() const { return is_binary_; }

 private:
  void read_format() {
    if (!next_section()) fail("is empty");
    if (section_ == "NOD") fail("version 1.0 of Gmsh's format is not read: save it as 2.2 or 4.1");
    if (section_ != "MeshFormat") fail("does not begin with $MeshFormat: is it a mesh of Gmsh?");
    const std::string_view version = take_word();
    if (version == "2.2" || version == "2.1" || version == "2.0" || version == "2")
      version_ = 2;
    else if (version == "4.1")
      version_ = 4;
    else
      fail(fmt::format("version {} of Gmsh's format is not read: save it as 2.2 or 4.1", shown(version, 20)));
    const std::int64_t kind = word(), size = word();
    if (kind != 0 && kind != 1) fail(fmt::format("file type {}: must be 0 or 1", kind));
    if (size != 8) fail(fmt::format("values of {} bytes: must be 8", size));
    if (is_binary_) {
      line();
      const char* bytes = take(4);
      swap_ = number_at<std::int32_t>(bytes, true) == 1;
      if (!swap_ && number_at<std::int32_t>(bytes, false) != 1) fail("the byte order is not that of a 1");
    }
    end_section();
  }
  std::string_view take_word() {
    const std::string_view word = next_word(rest_);
    if (word.empty()) fail_end();
    at_ = word.data();
    return word;
  }
  std::int64_t integer_of(std::string_view word) const {
    const std::optional<std::int64_t> value = parse_integer(word);
    if (!value) fail(fmt::format("${}: value {}: must be an integer", shown(section_), in_quotes(word)));
    return *value;
  }
  const char* take(std::size_t size) {
    if (rest_.size() < size) fail_end();
    at_ = rest_.data();
    rest_.remove_prefix(size);
    return at_;
  }
  [[noreturn]] void fail_end() const {
    throw InputError(fmt::format("{}: ends within {}: the file is cut off", file_,
                                 section_.empty() ? std::string("its header") : "$" + shown(section_)));
  }

  std::string file_;
  std::string bytes_;                 // of a binary file
  std::optional<TextSource> source_;  // of a text
  std::string_view rest_, section_;
  const char* at_ = nullptr;
  int version_ = 0;
  bool is_binary_ = false, swap_ = false;
};

// Gmsh reference manual, "MSH file format": kinds of elements and their numbers of nodes.
struct ElementKind {
  std::int64_t type;
  std::size_t nodes;
  int dimension;
  std::size_t corners;  // of two-dimensional ones
  bool is_linear;
};
constexpr std::array<ElementKind, 37> kKinds{
    {{1, 2, 1, 0, true},    {2, 3, 2, 3, true},    {3, 4, 2, 4, true},    {4, 4, 3, 0, true},    {5, 8, 3, 0, true},
     {6, 6, 3, 0, true},    {7, 5, 3, 0, true},    {8, 3, 1, 0, false},   {9, 6, 2, 3, false},   {10, 9, 2, 4, false},
     {11, 10, 3, 0, false}, {12, 27, 3, 0, false}, {13, 18, 3, 0, false}, {14, 14, 3, 0, false}, {15, 1, 0, 0, true},
     {16, 8, 2, 4, false},  {17, 20, 3, 0, false}, {18, 15, 3, 0, false}, {19, 13, 3, 0, false}, {20, 9, 2, 3, false},
     {21, 10, 2, 3, false}, {22, 12, 2, 3, false}, {23, 15, 2, 3, false}, {24, 15, 2, 3, false}, {25, 21, 2, 3, false},
     {26, 4, 1, 0, false},  {27, 5, 1, 0, false},  {28, 6, 1, 0, false},  {29, 20, 3, 0, false}, {30, 35, 3, 0, false},
     {31, 56, 3, 0, false}, {36, 16, 2, 4, false}, {37, 25, 2, 4, false}, {38, 36, 2, 4, false}, {39, 12, 2, 4, false},
     {92, 64, 3, 0, false}, {93, 125, 3, 0, false}}};

class GmshReader {
 public:
  GmshReader(std::string bytes, const std::string& file)
      : values_(std::move(bytes), file), model_(file, [this](const char* at) { return values_.place(at); }) {}
  GmshReader(const GmshReader&) = delete;
  GmshReader& operator=(const GmshReader&) = delete;

  TriangleMesh read() {
    bool has_elements = false;
    while (values_.next_section()) {
      const std::string_view section = values_.section();
      const bool is_new = values_.version() == 4;
      if (section == "PhysicalNames") {
        physical_names();
      } else if (section == "Entities" && is_new) {
        entities();
      } else if (section == "Nodes") {
        is_new ? node_blocks() : nodes();
      } else if (section == "Elements") {
        is_new ? element_blocks() : elements();
        has_elements = true;
      } else {
        values_.skip_section();
        continue;
      }
      values_.end_section();
    }
    if (!has_elements) values_.fail("ends without $Elements: the file is cut off");
    if (in_several_groups_ > 0) {
      model_.add_finding(fmt::format("{} surface{} in several physical groups: taken as of the first",
                                     in_several_groups_, in_several_groups_ == 1 ? "" : "s"));
    }
    return model_.mesh();
  }

 private:
  struct Surface {
    std::string part;
    bool is_reversed = false;
  };

  // Lines `dimension number "name"`, as text in binary files too.
  void physical_names() {
    const std::int64_t count = values_.word();
    values_.line();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::string_view line = values_.line();
      std::string_view rest = line;
      const auto dimension = parse_integer(next_word(rest)), number = parse_integer(next_word(rest));
      const std::size_t begin = line.find('"'), end = line.rfind('"');
      if (!dimension || !number || begin == end)
        values_.fail(fmt::format("$PhysicalNames: {}: must be dimension, number, \"name\"", in_quotes(line)));
      constexpr std::int64_t kSurface = 2;
      const std::string_view name = trimmed(line.substr(begin + 1, end - begin - 1));
      if (name.size() > kLongestName)
        values_.fail(fmt::format("$PhysicalNames: a name of more than {} bytes", kLongestName));
      if (*dimension == kSurface && !name.empty()) physical_[*number] = name;
    }
  }

  std::string physical_name(std::int64_t number) const {
    const auto found = physical_.find(number);
    return found == physical_.end() ? fmt::format("physical_{}", number) : found->second;
  }

  // Version 4.1: points, curves, surfaces and volumes with their physical groups.
  void entities() {
    std::array<std::int64_t, 4> counts{};
    for (std::int64_t& count : counts) count = values_.large();
    for (int dimension = 0; dimension < 4; ++dimension) {
      for (std::int64_t i = 0; i < counts[static_cast<std::size_t>(dimension)]; ++i) entity(dimension);
    }
  }

  void entity(int dimension) {
    const std::int64_t number = values_.small();
    for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) values_.real();  // position or bounding box
    const std::int64_t groups = values_.large();
    for (std::int64_t i = 0; i < groups; ++i) {
      const std::int64_t group = values_.small();
      if (dimension != 2) continue;
      if (group == std::numeric_limits<std::int64_t>::min())
        values_.fail("$Entities: a physical group beyond its type");
      if (i == 0) surfaces_[number] = {physical_name(std::abs(group)), group < 0};
      if (i == 1) ++in_several_groups_;
    }
    const std::int64_t boundaries = dimension == 0 ? 0 : values_.large();
    for (std::int64_t i = 0; i < boundaries; ++i) values_.small();
  }

  void node(std::int64_t number, const char* at) {
    Vec3 x;
    for (double& coordinate : x) coordinate = values_.real();
    model_.node(number, x, at);
  }

  void nodes() {
    const std::int64_t count = count_line();
    for (std::int64_t i = 0; i < count; ++i) {
      const std::int64_t number = values_.small();
      node(number, values_.at());
    }
  }

  // Version 2: a count in a line of its own, as text in binary files too.
  std::int64_t count_line() {
    const std::int64_t count = values_.word();
    if (values_.is_binary()) values_.line();
    return count;
  }

  // Version 4.1: for each entity the numbers of its nodes, then their coordinates, with parameters on request.
  void node_blocks() {
    const std::int64_t blocks = values_.large(), count = values_.large();
    values_.large(), values_.large();  // smallest and largest number
    std::int64_t sum = 0;
    std::vector<std::pair<std::int64_t, const char*>> numbers;
    for (std::int64_t b = 0; b < blocks; ++b) {
      const std::int64_t dimension = values_.small();
      values_.small();
      const bool has_parameters = values_.small() != 0;
      const std::int64_t here = values_.large();
      numbers.clear();
      for (std::int64_t i = 0; i < here; ++i) {
        const std::int64_t number = values_.large();
        numbers.emplace_back(number, values_.at());
      }
      for (const auto& [number, at] : numbers) {
        node(number, at);
        for (std::int64_t i = 0; has_parameters && i < std::min<std::int64_t>(dimension, 3); ++i) values_.real();
      }
      sum += static_cast<std::int64_t>(numbers.size());
    }
    if (sum != count) values_.fail(fmt::format("$Nodes has {} nodes: its header promises {}", sum, count));
  }

  const ElementKind& kind_of(std::int64_t type) const {
    const auto kind = std::find_if(kKinds.begin(), kKinds.end(), [&](const ElementKind& k) { return k.type == type; });
    if (kind == kKinds.end()) values_.fail(fmt::format("$Elements: elements of type {} are not read", type));
    return *kind;
  }

  // Corners come first among the nodes of an element, of which the number has been read.
  template <typename Read>
  void element(const ElementKind& kind, const Surface& surface, const char* at, const Read& read) {
    std::array<std::int64_t, 4> corners{};
    for (std::size_t i = 0; i < kind.nodes; ++i) {
      const std::int64_t node = read();
      if (i < kind.corners) corners[i] = node;
    }
    if (kind.dimension == 3) model_.solid(fmt::format("type {}", kind.type));
    if (kind.dimension != 2) return;
    const auto end = corners.begin() + static_cast<std::ptrdiff_t>(kind.corners);
    if (surface.is_reversed) std::reverse(corners.begin(), end);
    model_.shell(model_.part(surface.part, at), {corners.begin(), end}, !kind.is_linear, at);
  }

  // Version 2: number, type, count of tags, tags (physical and elementary surface, others), nodes. In binary, type and
  // counts precede the elements that have them.
  void elements() {
    const std::int64_t count = count_line();
    for (std::int64_t i = 0; i < count;) {
      if (!values_.is_binary()) values_.small();  // the number of the element
      const char* at = values_.at();
      const ElementKind& kind = kind_of(values_.small());
      const std::int64_t here = values_.is_binary() ? values_.small() : 1, tags = values_.small();
      if (here < 1 || here > count - i) values_.fail(fmt::format("$Elements: a block of {} of {}", here, count - i));
      for (std::int64_t k = 0; k < here; ++k, ++i) {
        if (values_.is_binary()) values_.small(), at = values_.at();
        std::int64_t physical = 0, elementary = 0;
        for (std::int64_t t = 0; t < tags; ++t) {
          const std::int64_t tag = values_.small();
          if (t < 2) (t == 0 ? physical : elementary) = tag;
        }
        const Surface surface{physical > 0 ? physical_name(physical) : fmt::format("surface_{}", elementary), false};
        element(kind, surface, at, [&] { return values_.small(); });
      }
    }
  }

  // Version 4.1: for each entity its dimension, number, type and count of elements; then number and nodes of each.
  void element_blocks() {
    const std::int64_t blocks = values_.large(), count = values_.large();
    values_.large(), values_.large();  // smallest and largest number
    std::int64_t sum = 0;
    for (std::int64_t b = 0; b < blocks; ++b) {
      values_.small();
      const std::int64_t entity = values_.small();
      const ElementKind& kind = kind_of(values_.small());
      const std::int64_t here = values_.large();
      const auto found = surfaces_.find(entity);
      const Surface surface = found != surfaces_.end() ? found->second : Surface{fmt::format("surface_{}", entity)};
      for (std::int64_t i = 0; i < here; ++i, ++sum) {
        values_.large();
        element(kind, surface, values_.at(), [&] { return values_.large(); });
      }
    }
    if (sum != count) values_.fail(fmt::format("$Elements has {} elements: its header promises {}", sum, count));
  }

  GmshValues values_;
  ShellModel model_;
  std::map<std::int64_t, std::string> physical_;  // names of physical surfaces
  std::map<std::int64_t, Surface> surfaces_;      // those with a physical group, by number
  std::size_t in_several_groups_ = 0;
};

}  // namespace

TriangleMesh read_gmsh(std::string bytes, const std::string& file) { return GmshReader(std::move(bytes), file).read(); }

}  // namespace seaglint
