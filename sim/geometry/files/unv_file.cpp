// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/shell_model.h"

namespace seaglint {

namespace {

bool is_mark(std::string_view line) { return trimmed(line) == "-1"; }

// "2411", or "58b" with further fields for binary records.
std::optional<std::int64_t> dataset_number(std::string_view line) {
  std::string_view word = next_word(line);
  if (word.ends_with('b')) word.remove_suffix(1);
  return parse_integer(word);
}

// Datasets of I-DEAS universal files: a line with -1, one with the number, the records, a line with -1.
class UnvDatasets {
 public:
  explicit UnvDatasets(TextSource source) : source_(std::move(source)), rest_(source_.text()) {}

  // Moves to the next dataset; false at the end of the file. Throws InputError for text between datasets and a dataset
  // that is cut off.
  bool next() {
    std::string_view line;
    do {
      if (rest_.empty()) return false;
      line = next_line(rest_);
    } while (trimmed(line).empty());
    if (!is_mark(line))
      source_.fail(trimmed(line), fmt::format("{} where -1 begins a dataset", in_quotes(trimmed(line))));
    line_ = rest_.empty() ? line : next_line(rest_);
    const std::optional<std::int64_t> number = dataset_number(line_);
    if (!number || *number <= 0 || *number > 1000000)
      source_.fail(trimmed(line_), fmt::format("{} where the number of a dataset belongs", in_quotes(trimmed(line_))));
    number_ = static_cast<int>(*number);
    body_ = rest_;
    while (!rest_.empty()) {
      const char* begin = rest_.data();
      if (!is_mark(next_line(rest_))) continue;
      body_ = body_.substr(0, static_cast<std::size_t>(begin - body_.data()));
      return true;
    }
    fail("ends without -1: the file is cut off");
  }

  int number() const { return number_; }
  bool is_done() const { return body_.empty(); }  // no record is left
  // the next record
  std::string_view line() {
    if (body_.empty()) fail("ends within a record");
    return line_ = next_line(body_);
  }
  const char* at() const { return line_.data(); }

  // The next record of at least `count` integers or numbers: the first `count`.
  std::vector<std::int64_t> integers(std::size_t count, const char* what) {
    return fields<std::int64_t>(count, what, &UnvDatasets::integer);
  }
  std::vector<double> numbers(std::size_t count, const char* what) {
    return fields<double>(count, what, &UnvDatasets::number);
  }
  // The next `count` integers of any number of records.
  std::vector<std::int64_t> wrapped_integers(std::size_t count, const char* what) {
    std::vector<std::int64_t> values;
    while (values.size() < count) {
      for (const std::string_view word : words_of(line())) {
        if (values.size() == count) fail(fmt::format("{}: more than {} fields", what, count));
        values.push_back(integer(word, what));
      }
    }
    return values;
  }

  // at the record that was read last
  [[noreturn]] void fail(const std::string& what) const {
    source_.fail(trimmed(line_), fmt::format("dataset {}: {}", number_, what));
  }
  const TextSource& source() const { return source_; }

 private:
  template <typename T>
  std::vector<T> fields(std::size_t count, const char* what,
                        T (UnvDatasets::*read)(std::string_view, const char*) const) {
    std::string_view text = line();
    std::vector<T> values;
    while (values.size() < count) {
      const std::string_view word = next_word(text);
      if (word.empty()) fail(fmt::format("{}: {} fields: must be {}", what, values.size(), count));
      values.push_back((this->*read)(word, what));
    }
    return values;
  }
  std::int64_t integer(std::string_view word, const char* what) const {
    const std::optional<std::int64_t> value = parse_integer(word);
    if (!value) source_.fail(word, fmt::format("{}: value {}: must be an integer", what, in_quotes(word)));
    return *value;
  }
  double number(std::string_view word, const char* what) const {
    const std::optional<double> value =
        word.find(',') == std::string_view::npos ? parse_written_number(word) : std::nullopt;
    if (!value || !std::isfinite(*value))
      source_.fail(word, fmt::format("{}: value {}: must be a number", what, in_quotes(word)));
    return *value;
  }

  TextSource source_;
  std::string_view rest_, body_, line_;
  int number_ = 0;
};

// FE descriptor of dataset 2412, a family (tens) with six shapes (units): linear, parabolic and cubic triangles, the
// same of quadrilaterals. Families 4 to 7 and 9 to 10: plane stress, plane strain, plates, membranes, thin and thick
// shells.
struct Descriptor {
  std::int64_t family, shape;
  explicit Descriptor(std::int64_t id) : family(id / 10), shape(id % 10) {}
  bool is_shell() const { return shape >= 1 && shape <= 6 && family >= 4 && family <= 10 && family != 8; }
  bool is_axisymmetric() const { return family == 8; }
  bool is_solid() const { return family == 11; }
  std::size_t corners() const { return shape <= 3 ? 3 : 4; }
  std::size_t order() const { return static_cast<std::size_t>((shape - 1) % 3 + 1); }
};

// Beams have a record of their orientation in front of their nodes.
bool is_beam(std::int64_t id) { return id == 11 || (id >= 21 && id <= 24) || id == 31 || id == 32; }

class UnvReader {
 public:
  explicit UnvReader(const TextSource& source)
      : sets_(source), model_(source.name(), [source](const char* at) {
          return source.place({at, at});
        }) {}

  UnvMesh read() {
    while (sets_.next()) {
      switch (sets_.number()) {
        case 15: old_nodes(); break;
        case 781:
        case 2411: nodes(); break;
        case 780: elements(8, 3); break;
        case 2412: elements(6, 2); break;
        case 2420: coordinate_systems(); break;
        case 164: units(); break;
        case 2435:
        case 2452:
        case 2467:
        case 2477: groups(); break;
        default: break;
      }
    }
    check_systems();
    apply_groups();
    if (in_several_groups_ > 0) {
      model_.add_finding(fmt::format("{} element{} in several groups: taken as of the first", in_several_groups_,
                                     in_several_groups_ == 1 ? "" : "s"));
    }
    return {model_.mesh(), unit_m_};
  }

 private:
  struct Element {
    std::int64_t number;
    std::size_t shell;
    bool has_group;
  };
  struct Group {
    std::string name;
    const char* at;
    std::size_t first;  // of its members
  };

  void node(std::int64_t number, std::int64_t system, const char* at, const std::vector<double>& x, std::size_t first) {
    systems_.try_emplace(system, at);
    model_.node(number, {x[first], x[first + 1], x[first + 2]}, at);
  }

  // Records: label, export and displacement coordinate system, colour; the coordinates.
  void nodes() {
    while (!sets_.is_done()) {
      const std::vector<std::int64_t> head = sets_.integers(4, "node");
      const char* at = sets_.at();
      node(head[0], head[1], at, sets_.numbers(3, "coordinates"), 0);
    }
  }

  // The same in one record.
  void old_nodes() {
    while (!sets_.is_done()) {
      const std::vector<double> x = sets_.numbers(7, "node");
      constexpr double kMost = 2147483647;
      if (!(x[0] >= 0 && x[0] <= kMost && x[0] == std::floor(x[0]) && std::abs(x[1]) <= kMost))
        sets_.fail(fmt::format("node {} is no whole number", x[0]));
      node(static_cast<std::int64_t>(x[0]), static_cast<std::int64_t>(x[1]), sets_.at(), x, 4);
    }
  }

  // Records: label, FE descriptor, ..., number of nodes as the last of `fields`; the nodes, eight per line. `property`:
  // place of the physical property among the fields.
  void elements(std::size_t fields, std::size_t property) {
    while (!sets_.is_done()) {
      const std::vector<std::int64_t> head = sets_.integers(fields, "element");
      const char* at = sets_.at();
      const std::int64_t count = head.back();
      if (count < 1 || count > 1000) sets_.fail(fmt::format("element of {} nodes: must be within 1 and 1000", count));
      if (is_beam(head[1])) sets_.line();
      const std::vector<std::int64_t> corners =
          sets_.wrapped_integers(static_cast<std::size_t>(count), "nodes of the element");
      const Descriptor kind(head[1]);
      const std::string name = fmt::format("descriptor {}", head[1]);
      if (kind.is_solid()) model_.solid(name);
      if (kind.is_axisymmetric()) model_.other_shell(name);
      if (kind.is_shell()) element(head[0], head[property], kind, corners, at);
    }
  }

  // Nodes of sides follow their corner (parabolic: one, cubic: two).
  void element(std::int64_t number, std::int64_t property, const Descriptor& kind,
               const std::vector<std::int64_t>& nodes, const char* at) {
    if (nodes.size() < kind.corners() * kind.order()) {
      sets_.fail(fmt::format("element {} has {} nodes: its descriptor has {}", number, nodes.size(),
                             kind.corners() * kind.order()));
    }
    std::array<std::int64_t, 4> corners{};
    for (std::size_t i = 0; i < kind.corners(); ++i) corners[i] = nodes[i * kind.order()];
    const auto [part, is_new] = properties_.try_emplace(property, 0);
    if (is_new) part->second = model_.part(fmt::format("property_{}", property), at);
    const std::size_t shell =
        model_.shell(part->second, {corners.data(), kind.corners()}, nodes.size() > kind.corners(), at);
    elements_.push_back({number, shell, false});
  }

  // Records: number, ..., count of entities as the eighth; name; entities, two per line, each with its kind and number.
  void groups() {
    while (!sets_.is_done()) {
      const std::vector<std::int64_t> head = sets_.integers(8, "group");
      const char* at = sets_.at();
      if (head[7] < 0 || head[7] > 0x7fffffff) sets_.fail(fmt::format("a group of {} entities", head[7]));
      const std::string_view name = trimmed(sets_.line());
      groups_.push_back({name.empty() ? fmt::format("group_{}", head[0]) : std::string(name), at, members_.size()});
      for (std::int64_t left = head[7]; left > 0; left -= 2) {
        const std::size_t here = left == 1 ? 1 : 2;
        const std::vector<std::int64_t> record = sets_.integers(4 * here, "entities of a group");
        for (std::size_t i = 0; i < here; ++i) {
          constexpr std::int64_t kElement = 8;
          if (record[4 * i] == kElement) members_.push_back(record[4 * i + 1]);
        }
      }
    }
  }

  // Groups without shells make no parts.
  void apply_groups() {
    std::stable_sort(elements_.begin(), elements_.end(),
                     [](const Element& a, const Element& b) { return a.number < b.number; });
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const std::size_t end = g + 1 < groups_.size() ? groups_[g + 1].first : members_.size();
      std::optional<std::uint32_t> part;
      for (std::size_t i = groups_[g].first; i < end; ++i) {
        const auto found = std::lower_bound(elements_.begin(), elements_.end(), members_[i],
                                            [](const Element& e, std::int64_t value) { return e.number < value; });
        if (found == elements_.end() || found->number != members_[i]) continue;
        in_several_groups_ += found->has_group ? 1 : 0;
        if (std::exchange(found->has_group, true)) continue;
        if (!part) part = model_.part(groups_[g].name, groups_[g].at);
        model_.move_to_part(found->shell, *part);
      }
    }
  }

  // Records: number of the part, its name; then label, type and colour, name, four records of a 4 x 3 matrix.
  void coordinate_systems() {
    sets_.integers(1, "part");
    sets_.line();
    constexpr double kIdentity[4][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}};
    while (!sets_.is_done()) {
      const std::vector<std::int64_t> head = sets_.integers(3, "coordinate system");
      sets_.line();
      bool is_global = head[1] == 0;  // Cartesian
      for (const auto& expected : kIdentity) {
        const std::vector<double> row = sets_.numbers(3, "matrix");
        for (std::size_t i = 0; i < 3; ++i) is_global = is_global && std::abs(row[i] - expected[i]) < 1e-12;
      }
      (is_global ? global_ : other_).insert(head[0]);
    }
  }

  // 0 and 1 are the global system unless the file gives them otherwise.
  void check_systems() const {
    for (const auto& [system, at] : systems_) {
      const bool is_global = (system == 0 || system == 1 || global_.contains(system)) && !other_.contains(system);
      if (!is_global) {
        model_.fail(at,
                    fmt::format("the node is in coordinate system {}, which is not the global one: export in global "
                                "coordinates",
                                system));
      }
    }
  }

  // Records: code, name, kind of temperatures; factors of length, force and temperature by which SI units are
  // multiplied.
  void units() {
    sets_.line();
    const double length = sets_.numbers(1, "factor of length")[0];
    if (!(length > 0)) sets_.fail(fmt::format("factor of length {}: must be greater than 0", length));
    unit_m_ = 1 / length;
  }

  UnvDatasets sets_;
  ShellModel model_;
  std::vector<Element> elements_;  // shells
  std::vector<Group> groups_;
  std::vector<std::int64_t> members_;                           // elements of all groups
  std::unordered_map<std::int64_t, std::uint32_t> properties_;  // their parts
  std::map<std::int64_t, const char*> systems_;                 // of nodes, with the first of them
  std::set<std::int64_t> global_, other_;                       // coordinate systems of dataset 2420
  std::size_t in_several_groups_ = 0;
  std::optional<double> unit_m_;
};

}  // namespace

UnvMesh read_unv(std::string bytes, const std::string& file) {
  return UnvReader(TextSource(file, std::move(bytes))).read();
}

}  // namespace seaglint
