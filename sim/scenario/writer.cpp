// SPDX-License-Identifier: BSD-3-Clause
// Writes the effective scenario: every field with its value, defaults included.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
#include "sim/core/text/words.h"
#include "sim/scenario/fields.h"

namespace seaglint {

namespace {

// Plain where YAML reads it back unchanged, else in double quotes.
std::string text_as_yaml(const std::string& text) {
  const auto simple = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '/' ||
           c == '.';
  };
  const bool starts_plain = !text.empty() && simple(text[0]) && text[0] != '.';
  const bool is_null = text == "null" || text == "Null" || text == "NULL";
  const auto inside = [&](char c) { return simple(c) || c == '-'; };
  if (starts_plain && !is_null && std::all_of(text.begin(), text.end(), inside)) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + '"';
}

std::string list_as_yaml(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(text_as_yaml(text));
  return fmt::format("[{}]", fmt::join(items, ", "));
}

// The smallest whole numbers a:b with a/(a+b) equal to the fraction to the last bit; otherwise fraction:(1-fraction).
std::string ratio_as_yaml(double fraction) {
  for (int whole = 2; whole <= 100; ++whole) {
    const int a = static_cast<int>(std::lround(fraction * whole));
    if (a > 0 && a < whole && static_cast<double>(a) / whole == fraction) return fmt::format("{}:{}", a, whole - a);
  }
  return fmt::format("{}:{}", fraction, 1 - fraction);
}

// Writes a value as YAML; doubles have the fewest digits that read back to the same bits (fmt).
struct ValueWriter {
  template <typename Field>
  std::string operator()(
      const Field& field) const requires std::is_arithmetic_v<std::remove_reference_t<decltype(field.value)>> {
    return fmt::format("{}", field.value);
  }
  std::string operator()(const NumberOrAutoField& field) const {
    return field.value ? fmt::format("{}", *field.value) : "auto";
  }
  std::string operator()(const TextField& field) const { return text_as_yaml(field.value); }
  std::string operator()(const ChoiceField& field) const {
    SEAGLINT_CHECK(field.index < field.words.size(), fmt::format("{} of {}", field.index, field.words.size()));
    return field.words[field.index];
  }
  std::string operator()(const TripleField& field) const { return fmt::format("[{}]", fmt::join(field.values, ", ")); }
  std::string operator()(const RatioField& field) const { return ratio_as_yaml(field.fraction); }
  std::string operator()(const SweepField& field) const {
    if (field.word > 0) return field.words[field.word - 1];
    return fmt::format(fmt::runtime(field.values.size() == 1 ? "{}" : "[{}]"), fmt::join(field.values, ", "));
  }
  std::string operator()(const HoldOutsField& field) const {
    std::vector<std::string> entries;
    for (const HoldOutSpec& column : field.columns)
      entries.push_back(fmt::format("{}: {}", text_as_yaml(column.column), list_as_yaml(column.values)));
    return fmt::format("{{{}}}", fmt::join(entries, ", "));
  }
  std::string operator()(const NamesField& field) const { return list_as_yaml(field.values); }
};

// Passes on each value as YAML: the distribution of a key that is drawn.
class ValueVisitor : public PathVisitor {
 public:
  explicit ValueVisitor(const std::vector<Variation>& variations) : variations_(variations) {}

  void value(const char* key, const KeyField& value, const char*) override {
    const Variation* drawn = variation_of(key);
    write(key, drawn == nullptr ? std::visit(ValueWriter(), value) : drawn->text());
  }
  // A key that is drawn, or a section with one, is written even where the middle of its distribution is the default.
  bool optional(const char* key, bool present) override {
    const std::string section = path_of(key) + ".";
    return present || variation_of(key) != nullptr ||
           std::ranges::any_of(variations_, [&](const Variation& v) { return v.key_path.starts_with(section); });
  }

 protected:
  virtual void write(const char* key, const std::string& value) = 0;

 private:
  // Null for a key that is not drawn.
  const Variation* variation_of(const char* key) const {
    const auto drawn = std::ranges::find(variations_, path_of(key), &Variation::key_path);
    return drawn == variations_.end() || !drawn->is_written() ? nullptr : &*drawn;
  }

  const std::vector<Variation>& variations_;
};

// `given`: only the keys of this document, each under a comment; null: all keys.
class Writer : public ValueVisitor {
 public:
  Writer(const std::vector<Variation>& variations, const ScenarioDocument* given = nullptr)
      : ValueVisitor(variations), given_(given) {}

  void value(const char* key, const KeyField& value, const char* meaning) override {
    const std::optional<DrawnPer> drawn = drawn_per(path_of(key));
    const std::string end = drawn ? fmt::format("; may be drawn, once per {}", name(*drawn)) : "";
    if (comment(key, fmt::format("{} [{}{}]", meaning, allowed_text(value, unit_of(key)), end)))
      ValueVisitor::value(key, value, meaning);
  }
  void section(const char* key, const Fields& fields, const char* meaning) override {
    if (!comment(key, meaning)) return;
    write(key, "");
    indented(key, [&] { fields(*this); });
  }
  void items(const char* key, const FieldItems& items, const char* meaning) override {
    if (!comment(key, meaning)) return;
    write(key, items.names.empty() ? "{}" : "");
    for (std::size_t i = 0; i < items.names.size(); ++i) {
      out += std::string(indent_ + 2, ' ') + (items.is_list ? "-" : text_as_yaml(items.names[i]) + ":") + "\n";
      indent_ += 2;
      indented(std::string(key) + "." + items.names[i], [&] { items.item(i, *this); });
      indent_ -= 2;
    }
  }

  std::string out;

 private:
  void write(const char* key, const std::string& value) override {
    out += std::string(indent_, ' ') + key + (value.empty() ? ":" : ": ") + value + "\n";
  }
  // Writes the comment of a key that is given; false for a key that is not.
  bool comment(const char* key, const std::string& text) {
    if (given_ == nullptr) return true;
    if (!given_->has(path_of(key))) return false;
    constexpr std::size_t kWidth = 110;
    std::string line;
    const auto end_line = [&] { out += std::string(indent_, ' ') + "#" + std::exchange(line, "") + "\n"; };
    for (const std::string_view word : words_of(text)) {
      if (indent_ + line.size() + word.size() > kWidth) end_line();
      line += fmt::format(" {}", word);
    }
    end_line();
    return true;
  }
  template <typename Write>
  void indented(const std::string& key, const Write& write_below) {
    indent_ += 2;
    below(key, [&](FieldVisitor&) { write_below(); });
    indent_ -= 2;
  }

  const ScenarioDocument* given_;
  std::size_t indent_ = 0;
};

// The values of one section by their keys; those of a section within it as "split.by".
class SectionValues : public ValueVisitor {
 public:
  SectionValues(const std::vector<Variation>& variations, const std::string& section)
      : ValueVisitor(variations), prefix_(section + ".") {}

  void items(const char*, const FieldItems&, const char*) override {}

  std::vector<std::pair<std::string, std::string>> values;

 private:
  void write(const char* key, const std::string& value) override {
    const std::string path = path_of(key);
    if (path.starts_with(prefix_)) values.emplace_back(path.substr(prefix_.size()), value);
  }

  std::string prefix_;
};

}  // namespace

std::string value_as_yaml(const KeyField& value) { return std::visit(ValueWriter(), value); }

std::string effective_yaml(const Scenario& scenario) {
  Scenario copy = scenario;
  Writer writer(scenario.variations);
  visit_fields(copy, writer);
  return std::move(writer.out);
}

std::string commented_yaml(const Scenario& scenario, const std::string& head) {
  Scenario copy = scenario;
  Writer writer(scenario.variations, scenario.document.get());
  writer.out = head;
  visit_fields(copy, writer);
  return std::move(writer.out);
}

std::vector<std::pair<std::string, std::string>> section_values(const Scenario& scenario, const std::string& section) {
  Scenario copy = scenario;
  SectionValues values(scenario.variations, section);
  visit_fields(copy, values);
  return std::move(values.values);
}

}  // namespace seaglint
