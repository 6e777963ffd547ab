// SPDX-License-Identifier: BSD-3-Clause
#include "sim/geometry/files/exchange/nastran_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "sim/core/process/printable.h"
#include "sim/core/text/words.h"
#include "sim/geometry/files/exchange/nastran_cards.h"
#include "sim/geometry/files/exchange/shell_model.h"

namespace seaglint {

namespace {

// Names of properties, which pre-processors write into comments of NASTRAN bulk data.
class NastranNames {
 public:
  // Takes the name from a comment, which begins with its $:
  //   $HMNAME PROP 7"hull" 4, $HMNAME COMP 7"hull" 7 "shell" 4                  HyperMesh
  //   $ANSA_NAME_COMMENT;7;PSHELL;hull;...                                      ANSA
  //   $ Femap Property 7 : hull, $ Femap with NX Nastran Property 7 : hull      Femap
  //   $ Elements and Element Properties for region : hull                      Patran, for the next property card
  void comment(std::string_view line);
  // A property card, which a comment of Patran may precede.
  void property(std::int64_t number);

  const std::map<std::int64_t, std::string>& all() const { return names_; }

 private:
  void add(std::int64_t number, std::string_view name, bool overwrite);

  std::map<std::int64_t, std::string> names_;
  std::optional<std::string> region_;
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

void NastranNames::add(std::int64_t number, std::string_view name, bool overwrite) {
  name = trimmed(name);
  if (name.empty() || name.size() > kLongestName) return;
  if (overwrite)
    names_[number] = name;
  else
    names_.try_emplace(number, name);
}

void NastranNames::comment(std::string_view line) {
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

void NastranNames::property(std::int64_t number) {
  if (region_) add(number, *region_, false);
  region_.reset();
}

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
