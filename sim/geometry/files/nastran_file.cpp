// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/mesh_formats.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/core/numbers/constants.h"
#include "sim/core/numbers/linear.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/shell_model.h"

namespace seaglint {

namespace {

constexpr std::size_t kSmall = 8, kLarge = 16;  // columns

std::string upper(std::string_view text) {
  std::string result(text);
  std::transform(result.begin(), result.end(), result.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return result;
}

bool is_label(std::string_view field) { return field.starts_with('+') || field.starts_with('*'); }

// The part of a line in front of column `end`, removed from the front of `rest`, which begins at `column`. A tab leads
// to the next multiple of eight.
std::string_view columns(std::string_view& rest, std::size_t& column, std::size_t end) {
  std::size_t length = 0;
  for (; length < rest.size() && column < end; ++length)
    column = rest[length] == '\t' ? (column / 8 + 1) * 8 : column + 1;
  const std::string_view part = rest.substr(0, length);
  rest.remove_prefix(length);
  return trimmed(part);
}

// A number as NASTRAN writes it: "1.5", "1.5E-3", "1.5D-3", "1.5-3".
std::optional<double> parse_nastran_real(std::string_view text) {
  if (text.find_first_not_of("0123456789+-.eEdD") != std::string_view::npos) return std::nullopt;
  // A sign behind a digit or the point begins an exponent.
  const std::size_t sign = text.find_last_of("+-");
  const bool is_exponent = sign != std::string_view::npos && sign > 0 && !std::isalpha(text[sign - 1]);
  return is_exponent ? parse_number(fmt::format("{}e{}", text.substr(0, sign), text.substr(sign)))
                     : parse_written_number(text);
}

// Cards in small (8 columns), large (16 columns) and free field, with their continuation lines (MSC Nastran Quick
// Reference Guide, "Bulk Data Entries").
class NastranCards {
 public:
  // Begins behind BEGIN BULK, or with the first line where there is none. Throws InputError for BEGIN SUPER.
  explicit NastranCards(TextSource source) : source_(std::move(source)), rest_(source_.text()) { begin(); }

  // Moves to the next card; false at its end, which is ENDDATA or the end of the text. Throws InputError for a
  // continuation line without a card, one with the label of another card, and more fields than a line can have.
  bool next() {
    comments_ = std::exchange(comments_after_, {});
    std::string_view text;
    const bool has_line = next_content(text);
    comments_.insert(comments_.end(), comments_after_.begin(), comments_after_.end());
    comments_after_.clear();
    fields_.clear();
    name_.clear();
    if (!has_line) return false;

    line_ = trimmed(text);
    Line line = split(text);
    if (line.first.empty() || is_label(line.first))
      source_.fail(line_, "a continuation line without a card before it: no NASTRAN bulk data?");
    name_ = upper(line.first);
    // Free field without commas: a name alone, or blanks between name and value as in INCLUDE 'file'.
    const std::size_t blank = name_.find_first_of(" \t");
    if (blank != std::string::npos) name_.resize(blank);
    if (name_ == "ENDDATA") return false;
    if (name_.ends_with('*')) name_.pop_back();
    fields_.push_back(line.first);
    add(line);

    while (next_content(text)) {
      const Line more = split(text);
      const std::string_view first = more.first;
      if (!first.empty() && !is_label(first)) {
        rest_ = source_.text().substr(static_cast<std::size_t>(text.data() - source_.text().data()));
        break;
      }
      if (is_label(line.label) && line.label.size() > 1 && first.size() > 1 &&
          line.label.substr(1) != first.substr(1)) {
        source_.fail(first, fmt::format("continuation {} where {} should follow: sort the cards", in_quotes(first),
                                        in_quotes(line.label)));
      }
      add(more);
      line = more;
    }
    return true;
  }

  const std::string& name() const { return name_; }  // upper case, without the * of large fields
  const char* at() const { return line_.data(); }    // first line of the card
  const std::vector<std::string_view>& comments() const { return comments_; }  // in front of the card, from their $

  // Field i of the card, its name being field 1, without blanks; fields 10, 20, ... (labels) are not counted: the first
  // field of the second line is 10. Empty beyond the last and beyond field kMostFields.
  std::string_view field(std::size_t i) const {
    return i >= 1 && i <= fields_.size() ? fields_[i - 1] : std::string_view();
  }
  bool has(std::size_t i) const { return !field(i).empty(); }
  // Throws InputError for anything but an integer or, where there is a fallback, nothing.
  std::int64_t integer(std::size_t i, std::optional<std::int64_t> fallback = std::nullopt) const {
    const std::string_view text = field(i);
    if (text.empty()) {
      if (fallback) return *fallback;
      source_.fail(line_, fmt::format("{}: field {} is empty: must be an integer", name_, i));
    }
    const std::optional<std::int64_t> value = parse_integer(text);
    if (!value) source_.fail(text, fmt::format("{}: value {}: must be an integer", name_, in_quotes(text)));
    return *value;
  }
  // A real, also as "1.5-3"; 0 of an empty field. Throws InputError for anything else.
  double real(std::size_t i) const {
    const std::string_view text = field(i);
    if (text.empty()) return 0;
    const std::optional<double> value = parse_nastran_real(text);
    if (!value) source_.fail(text, fmt::format("{}: value {}: must be a number", name_, in_quotes(text)));
    return *value;
  }

  bool has_begin() const { return has_begin_; }
  bool has_end() const { return name_ == "ENDDATA"; }
  const TextSource& source() const { return source_; }

 private:
  struct Line {
    std::string_view first, label;  // field 1 and field 10
    std::vector<std::string_view> fields;
  };
  Line split(std::string_view line) const {
    Line parts;
    const bool is_free = line.find(',') != std::string_view::npos;
    if (!is_free) {
      std::size_t column = 0;
      std::string_view rest = line;
      parts.first = columns(rest, column, kSmall);
      const std::size_t width = parts.first.ends_with('*') || parts.first.starts_with('*') ? kLarge : kSmall;
      for (std::size_t end = kSmall + width; end <= 72; end += width)
        parts.fields.push_back(columns(rest, column, end));
      parts.label = columns(rest, column, 80);
      return parts;
    }
    std::vector<std::string_view> fields;
    for (std::string_view rest = line;;) {
      const std::size_t comma = rest.find(',');
      fields.push_back(trimmed(rest.substr(0, comma)));
      if (comma == std::string_view::npos) break;
      rest.remove_prefix(comma + 1);
    }
    parts.first = fields[0];
    const std::size_t count = parts.first.ends_with('*') || parts.first.starts_with('*') ? 4 : 8;
    for (std::size_t i = 1; i <= count; ++i) parts.fields.push_back(i < fields.size() ? fields[i] : std::string_view());
    if (fields.size() > count + 1) parts.label = fields[count + 1];
    for (std::size_t i = count + 2; i < fields.size(); ++i) {
      if (!fields[i].empty()) source_.fail(fields[i], fmt::format("more than {} fields in one line", count + 2));
    }
    return parts;
  }
  void begin() {
    for (std::string_view text = rest_; !text.empty();) {
      std::string_view line = next_line(text);
      const std::string word = upper(next_word(line));
      if (word != "BEGIN") continue;
      const std::string_view what = next_word(line);
      if (upper(what) != "BULK") source_.fail(what, fmt::format("BEGIN {}: superelements are not read", shown(what)));
      if (has_begin_) source_.fail(what, "a second BEGIN BULK: superelements are not read");
      has_begin_ = true;
      rest_ = text;
    }
  }
  // The next line that is neither blank nor a comment, without a comment at its end.
  bool next_content(std::string_view& line) {
    while (!rest_.empty()) {
      std::string_view text = next_line(rest_);
      const std::size_t dollar = text.find('$');
      if (dollar != std::string_view::npos && trimmed(text.substr(0, dollar)).empty())
        comments_after_.push_back(text.substr(dollar));
      line = text.substr(0, dollar);
      if (!trimmed(line).empty()) return true;
    }
    return false;
  }
  void add(const Line& line) {
    for (std::size_t i = 0; i < line.fields.size() && fields_.size() < kMostFields; ++i)
      fields_.push_back(line.fields[i]);
  }

  static constexpr std::size_t kMostFields = 33;  // of four lines

  TextSource source_;
  std::string_view rest_;
  std::string_view line_;
  std::string name_;
  std::vector<std::string_view> fields_;  // the name, then the others
  std::vector<std::string_view> comments_, comments_after_;
  bool has_begin_ = false;
};

// Coordinate systems CORD2R, CORD2C and CORD2S. Systems may be given behind the nodes and the systems that refer to
// them.
class NastranFrames {
 public:
  // Reads a card CORD...; throws InputError for a number that is not positive, given twice, or three points on a line.
  void add(const NastranCards& card) {
    const std::int64_t number = card.integer(2);
    const TextSource& source = card.source();
    if (number <= 0) source.fail(card.field(2), fmt::format("{} {}: must be greater than 0", card.name(), number));
    const bool is_known = card.name() == "CORD2R" || card.name() == "CORD2C" || card.name() == "CORD2S";
    if (!is_known) {
      others_.insert(number);
      return;
    }
    Frame frame;
    frame.kind = card.name() == "CORD2C"   ? Kind::kCylindrical
                 : card.name() == "CORD2S" ? Kind::kSpherical
                                           : Kind::kRectangular;
    frame.reference = card.integer(3, 0);
    frame.at = card.at();
    for (int i = 0; i < 3; ++i) {
      const auto field = static_cast<std::size_t>(4 + i);
      frame.a[i] = card.real(field);
      frame.b[i] = card.real(field + 3);
      frame.c[i] = card.real(field + 6);
    }
    if (!frames_.try_emplace(number, frame).second)
      source.fail(card.field(2), fmt::format("{} {} is given twice", card.name(), number));
  }

  // Replaces references by the base system; throws InputError for one that refers to itself or to a missing system.
  void resolve(const TextSource& source) {
    for (auto& [number, first] : frames_) {
      std::vector<Frame*> chain;
      for (Frame* frame = &first; !frame->is_resolved;) {
        chain.push_back(frame);
        const auto next = frames_.find(frame->reference);
        if (next == frames_.end()) break;
        frame = &next->second;
        if (chain.size() > frames_.size())
          source.fail(std::string_view(first.at, first.at),
                      fmt::format("coordinate system {} refers to itself", number));
      }
      for (; !chain.empty(); chain.pop_back()) place(*chain.back(), source);
    }
  }

  // A point (x, y, z; r, theta in deg, z; or r, theta, phi in deg) in the base system; nullopt for an unknown system.
  // System 0 is the base system.
  std::optional<Vec3> in_base(std::int64_t system, const Vec3& point) const {
    if (system == 0) return point;
    const auto found = frames_.find(system);
    if (found == frames_.end()) return std::nullopt;
    const Frame& frame = found->second;
    return Vec3(frame.a + frame.R * cartesian(frame.kind, point));
  }

  // Whether a card CORD1R, CORD1C, CORD1S, CORD3G with this number has been added: these are not read.
  bool is_of_other_kind(std::int64_t system) const { return others_.contains(system); }

 private:
  enum class Kind { kRectangular, kCylindrical, kSpherical };
  struct Frame {
    Kind kind = Kind::kRectangular;
    std::int64_t reference = 0;
    Vec3 a, b, c;  // origin, point on the z axis, point in the half-plane of x and z
    const char* at = nullptr;
    Mat3 R = Mat3::Identity();  // axes in the base system, columns
    bool is_resolved = false;
  };
  static Vec3 cartesian(Kind kind, const Vec3& point) {
    if (kind == Kind::kRectangular) return point;
    const double r = point.x(), theta = radians(point.y());
    if (kind == Kind::kCylindrical) return {r * std::cos(theta), r * std::sin(theta), point.z()};
    // theta from the z axis, phi about it (MSC Nastran Quick Reference Guide, CORD2S).
    const double phi = radians(point.z());
    return {r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi), r * std::cos(theta)};
  }
  // The axes of a system whose reference is resolved.
  void place(Frame& frame, const TextSource& source) const {
    for (Vec3* point : {&frame.a, &frame.b, &frame.c}) {
      const std::optional<Vec3> base = in_base(frame.reference, *point);
      if (!base) {
        source.fail(std::string_view(frame.at, frame.at),
                    fmt::format("coordinate system {}, which it refers to, is not given", frame.reference));
      }
      *point = *base;
    }
    const Vec3 z = frame.b - frame.a, y = z.cross(frame.c - frame.a);
    if (!(y.norm() > 1e-9 * z.norm() * (frame.c - frame.a).norm()))
      source.fail(std::string_view(frame.at, frame.at), "the three points of the coordinate system are on one line");
    frame.R.col(2) = z.normalized();
    frame.R.col(1) = y.normalized();
    frame.R.col(0) = frame.R.col(1).cross(frame.R.col(2));
    frame.is_resolved = true;
  }

  std::map<std::int64_t, Frame> frames_;
  std::set<std::int64_t> others_;
};

// The whole number at the front of a text, removed from it.
std::optional<std::int64_t> leading_number(std::string_view& text) {
  while (text.starts_with(' ') || text.starts_with('\t')) text.remove_prefix(1);
  std::int64_t number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  return number;
}

// The text between the next two double quotes, removed with them from the front of `text`; empty without them.
std::string_view quoted(std::string_view& text) {
  const std::size_t begin = text.find('"');
  if (begin == std::string_view::npos) return {};
  const std::size_t end = text.find('"', begin + 1);
  if (end == std::string_view::npos) return {};
  const std::string_view name = text.substr(begin + 1, end - begin - 1);
  text.remove_prefix(end + 1);
  return name;
}

// Names of properties, which pre-processors write into comments of NASTRAN bulk data.
class NastranNames {
 public:
  // Takes the name from a comment, which begins with its $:
  //   $HMNAME PROP 7"hull" 4, $HMNAME COMP 7"hull" 7 "shell" 4                  HyperMesh
  //   $ANSA_NAME_COMMENT;7;PSHELL;hull;...                                      ANSA
  //   $ Femap Property 7 : hull, $ Femap with NX Nastran Property 7 : hull      Femap
  //   $ Elements and Element Properties for region : hull                      Patran, for the next property card
  void comment(std::string_view line) {
    std::string_view text = line;
    const std::string_view word = next_word(text);
    if (word == "$HMNAME") {
      const std::string_view kind = next_word(text);
      if (kind != "PROP" && kind != "COMP") return;
      const std::optional<std::int64_t> number = leading_number(text);
      const std::string_view name = quoted(text);
      // A component names the property of its elements behind its own name.
      const std::optional<std::int64_t> property = kind == "COMP" ? leading_number(text) : std::nullopt;
      if (number) add(property.value_or(*number), name, kind == "PROP");
      return;
    }
    constexpr std::string_view kAnsa = "$ANSA_NAME_COMMENT;", kRegion = "Elements and Element Properties for region";
    if (line.starts_with(kAnsa)) {
      text = line.substr(kAnsa.size());
      const std::optional<std::int64_t> number = leading_number(text);
      constexpr std::string_view kShell = ";PSHELL;";
      if (!number || !text.starts_with(kShell)) return;
      text.remove_prefix(kShell.size());
      add(*number, text.substr(0, text.find(';')), true);
      return;
    }
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos) return;
    const std::string_view name = trimmed(line.substr(colon + 1));
    if (line.find(kRegion) != std::string_view::npos) region_ = name;
    constexpr std::string_view kFemap = "Property ";
    const std::size_t property = line.find(kFemap);
    if (line.find("Femap") < property && property < colon) {
      text = line.substr(property + kFemap.size(), colon - property - kFemap.size());
      if (const std::optional<std::int64_t> number = parse_integer(trimmed(text))) add(*number, name, true);
    }
  }
  // A property card, which a comment of Patran may precede.
  void property(std::int64_t number) {
    if (region_) add(number, *region_, false);
    region_.reset();
  }

  const std::map<std::int64_t, std::string>& all() const { return names_; }

 private:
  void add(std::int64_t number, std::string_view name, bool overwrite) {
    name = trimmed(name);
    if (name.empty() || name.size() > kLongestName) return;
    if (overwrite)
      names_[number] = name;
    else
      names_.try_emplace(number, name);
  }

  std::map<std::int64_t, std::string> names_;
  std::optional<std::string> region_;
};

struct ShellCard {
  std::string_view name;
  std::size_t corners;
  bool quadratic;
  std::size_t offset_field;  // of ZOFFS; 0: none
};

// MSC Nastran Quick Reference Guide; corners are fields 4 and following.
constexpr std::array<ShellCard, 9> kShells{{{"CTRIA3", 3, false, 8},
                                            {"CTRIAR", 3, false, 8},
                                            {"CTRIA6", 3, true, 11},
                                            {"CQUAD4", 4, false, 9},
                                            {"CQUADR", 4, false, 9},
                                            {"CQUAD8", 4, true, 17},
                                            {"CQUAD", 4, true, 0},
                                            {"CQUAD9", 4, true, 0},
                                            {"CSHEAR", 4, false, 0}}};

// Solids; cards that begin with C and are no surfaces. Any other card with C may be a surface or a misspelt one.
constexpr std::array<std::string_view, 4> kSolids{"CTETRA", "CHEXA", "CPENTA", "CPYRAM"};
constexpr std::array<std::string_view, 25> kOthers{"CBAR",  "CBEAM", "CBEND",  "CROD", "CONROD", "CTUBE", "CBUSH",
                                                   "CELAS", "CDAMP", "CMASS",  "CONM", "CGAP",   "CWELD", "CFAST",
                                                   "CSEAM", "CVISC", "CHBDY",  "CONV", "CHAC",   "CAERO", "CLOAD",
                                                   "CSET",  "CSUP",  "CYJOIN", "CREEP"};

bool has_prefix(std::string_view name, std::span<const std::string_view> prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(), [&](std::string_view p) { return name.starts_with(p); });
}

class NastranReader {
 public:
  explicit NastranReader(const TextSource& source)
      : cards_(source), model_(source.name(), [source](const char* at) {
          return source.place({at, at});
        }) {}

  TriangleMesh read() {
    while (cards_.next()) {
      comments();
      card();
    }
    comments();
    const TextSource& source = cards_.source();
    if (cards_.has_begin() && !cards_.has_end())
      source.fail(source.text().substr(source.text().size()), "ends without ENDDATA: the file is cut off");
    if (grids_.empty()) source.fail(source.text(), "no card GRID: NASTRAN bulk data have their nodes there");
    if (!cards_.has_end()) model_.add_finding("ends without ENDDATA: a file that is cut off would do so too");
    if (with_offset_ > 0) {
      model_.add_finding(fmt::format("{} shell{} with an offset from the nodes (ZOFFS): read at the nodes",
                                     with_offset_, with_offset_ == 1 ? "" : "s"));
    }
    frames_.resolve(source);
    for (const Grid& grid : grids_) place(grid);
    for (const auto& [number, name] : names_.all()) {
      const auto part = parts_.find(number);
      if (part != parts_.end()) model_.rename(part->second, name);
    }
    return model_.mesh();
  }

 private:
  struct Grid {
    std::int64_t number;
    std::optional<std::int64_t> system;
    Vec3 point;
    std::string_view at;  // its number
  };

  void comments() {
    for (const std::string_view comment : cards_.comments()) names_.comment(comment);
  }

  void card() {
    const std::string& name = cards_.name();
    if (name == "GRID") return grid();
    if (name == "GRDSET") {
      default_system_ = cards_.integer(3, 0);
      return;
    }
    if (name.starts_with("CORD")) return frames_.add(cards_);
    if (name == "INCLUDE")
      cards_.source().fail({cards_.at(), cards_.at()}, "INCLUDE: other files are not read: export one file");
    if (name.starts_with('='))
      cards_.source().fail({cards_.at(), cards_.at()}, "replicated cards are not read: write them out");
    if (name.starts_with("PSHELL") || name.starts_with("PCOMP")) names_.property(cards_.integer(2));
    if (name.starts_with('C')) element(name);
  }

  void grid() {
    Grid grid{cards_.integer(2), std::nullopt, {}, cards_.field(2)};
    if (grid.number <= 0) cards_.source().fail(grid.at, fmt::format("GRID {}: must be greater than 0", grid.number));
    if (cards_.has(3)) grid.system = cards_.integer(3);
    for (int axis = 0; axis < 3; ++axis) grid.point[axis] = cards_.real(static_cast<std::size_t>(4 + axis));
    grids_.push_back(grid);
  }

  void place(const Grid& grid) {
    const std::int64_t system = grid.system.value_or(default_system_);
    const std::optional<Vec3> position = frames_.in_base(system, grid.point);
    if (!position) {
      cards_.source().fail(grid.at, fmt::format("GRID {}: coordinate system {} {}", grid.number, system,
                                                frames_.is_of_other_kind(system)
                                                    ? "is not CORD2R, CORD2C or CORD2S: export in the base system"
                                                    : "is not given"));
    }
    model_.node(grid.number, *position, grid.at.data());
  }

  void element(const std::string& name) {
    const auto kind = std::find_if(kShells.begin(), kShells.end(), [&](const ShellCard& s) { return s.name == name; });
    if (kind == kShells.end()) {
      if (has_prefix(name, kSolids)) model_.solid(shown(name, 16));
      if (!has_prefix(name, kSolids) && !has_prefix(name, kOthers)) model_.other_shell(shown(name, 16));
      return;
    }
    cards_.integer(2);
    const std::int64_t property = cards_.integer(3, 0);
    std::array<std::int64_t, 4> corners{};
    for (std::size_t i = 0; i < kind->corners; ++i) corners[i] = cards_.integer(4 + i);
    if (kind->offset_field > 0 && has_offset(kind->offset_field)) ++with_offset_;
    model_.shell(part_of(property), {corners.data(), kind->corners}, kind->quadratic, cards_.at());
  }

  // ZOFFS: a length or, of OptiStruct, a face of the shell.
  bool has_offset(std::size_t field) const {
    const std::string_view text = cards_.field(field);
    return !text.empty() && (text == "TOP" || text == "BOTTOM" || cards_.real(field) != 0);
  }

  std::uint32_t part_of(std::int64_t property) {
    const auto found = parts_.find(property);
    if (found != parts_.end()) return found->second;
    const std::string name = property == 0 ? "body" : fmt::format("property_{}", property);
    return parts_[property] = model_.part(name, cards_.at());
  }

  NastranCards cards_;
  ShellModel model_;
  NastranFrames frames_;
  NastranNames names_;
  std::vector<Grid> grids_;
  std::int64_t default_system_ = 0;                        // GRDSET
  std::unordered_map<std::int64_t, std::uint32_t> parts_;  // by property
  std::size_t with_offset_ = 0;
};

}  // namespace

TriangleMesh read_nastran(std::string bytes, const std::string& file) {
  return NastranReader(TextSource(file, std::move(bytes))).read();
}

}  // namespace seaglint
