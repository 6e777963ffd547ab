// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "sim/core/process/error.h"
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

// The smallest whole numbers a:b with a/(a+b) equal to the fraction to the last bit; otherwise fraction:(1-fraction).
std::string ratio_as_yaml(double fraction) {
  for (int whole = 2; whole <= 100; ++whole) {
    const int a = static_cast<int>(std::lround(fraction * whole));
    if (a > 0 && a < whole && static_cast<double>(a) / whole == fraction) return fmt::format("{}:{}", a, whole - a);
  }
  return fmt::format("{}:{}", fraction, 1 - fraction);
}

// Writes values as YAML: the distribution of a key that is drawn; doubles have the fewest digits that read back to the
// same bits (fmt).
class ValueVisitor : public FieldVisitor {
 public:
  ValueVisitor(const std::vector<Variation>& variations, std::string path)
      : variations_(variations), path_(std::move(path)) {}

  void number(const char* key, double& value, const Bound&) override { line(key, fmt::format("{}", value)); }
  void number_or_auto(const char* key, std::optional<double>& value, const Bound&) override {
    line(key, value ? fmt::format("{}", *value) : "auto");
  }
  void integer(const char* key, int& value, const Bound&) override { line(key, fmt::format("{}", value)); }
  void natural(const char* key, std::uint64_t& value) override { line(key, fmt::format("{}", value)); }
  void flag(const char* key, bool& value) override { line(key, value ? "true" : "false"); }
  void text(const char* key, std::string& value) override { line(key, text_as_yaml(value)); }
  void choice(const char* key, std::size_t& index, Names names) override {
    SEAGLINT_CHECK(index < names.size(), fmt::format("{}: choice {} of {}", key, index, names.size()));
    line(key, names[index]);
  }
  void triple(const char* key, std::array<double, 3>& values, const Bound&) override {
    line(key, fmt::format("[{}]", fmt::join(values, ", ")));
  }
  void ratio(const char* key, double& fraction) override { line(key, ratio_as_yaml(fraction)); }
  void sweep(const char* key, Sweep& values, const Bound&, Names words, std::size_t* word) override {
    if (word != nullptr && *word > 0) {
      line(key, words[*word - 1]);
    } else if (values.size() == 1) {
      line(key, fmt::format("{}", values[0]));
    } else {
      line(key, fmt::format("[{}]", fmt::join(values, ", ")));
    }
  }
  void hold_outs(const char* key, std::vector<HoldOutSpec>& columns) override {
    std::vector<std::string> entries;
    for (const HoldOutSpec& column : columns) {
      std::vector<std::string> values;
      for (const std::string& value : column.values) values.push_back(text_as_yaml(value));
      entries.push_back(fmt::format("{}: [{}]", text_as_yaml(column.column), fmt::join(values, ", ")));
    }
    line(key, fmt::format("{{{}}}", fmt::join(entries, ", ")));
  }
  void words(const char* key, std::vector<std::string>& values, std::size_t, std::size_t) override {
    std::vector<std::string> as_yaml;
    for (const std::string& value : values) as_yaml.push_back(text_as_yaml(value));
    line(key, fmt::format("[{}]", fmt::join(as_yaml, ", ")));
  }
  void require(const char*) override {}
  // A key that is drawn, or a section with one, is written even where the middle of its distribution is the default.
  bool optional(const char* key, bool present) override {
    const std::string section = path_of(key) + ".";
    return present || variation_of(key) != nullptr ||
           std::ranges::any_of(variations_, [&](const Variation& v) { return v.key_path.starts_with(section); });
  }

 protected:
  std::string path_of(const std::string& key) const { return path_.empty() ? key : path_ + "." + key; }
  const std::vector<Variation>& variations() const { return variations_; }
  virtual void write(const char* key, const std::string& value) = 0;

 private:
  void line(const char* key, const std::string& value) {
    const Variation* drawn = variation_of(key);
    write(key, drawn == nullptr ? value : drawn->text());
  }

  // Null for a key that is not drawn.
  const Variation* variation_of(const char* key) const {
    const auto drawn = std::ranges::find(variations_, path_of(key), &Variation::key_path);
    return drawn == variations_.end() || !drawn->is_written() ? nullptr : &*drawn;
  }

  const std::vector<Variation>& variations_;
  std::string path_;
};

class Writer : public ValueVisitor {
 public:
  Writer(const std::vector<Variation>& variations, std::string& out, std::string path = {}, int depth = 0)
      : ValueVisitor(variations, std::move(path)), out_(out), depth_(depth) {}

  void section(const char* key, const Fields& fields) override {
    write(key, "");
    Writer nested(variations(), out_, path_of(key), depth_ + 1);
    fields(nested);
  }
  void list(const char* key, std::size_t size, std::size_t, const std::function<void(std::size_t)>&,
            const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    write(key, "");
    for (std::size_t i = 0; i < size; ++i) {
      out_ += indent(depth_ + 1) + "-\n";
      Writer nested(variations(), out_, path_of(fmt::format("{}.{}", key, i)), depth_ + 2);
      item(i, nested);
    }
  }
  void dictionary(const char* key, const std::vector<std::string>& names, std::size_t,
                  const std::function<void(const std::vector<std::string>&)>&,
                  const std::function<void(std::size_t, FieldVisitor&)>& item) override {
    write(key, "");
    for (std::size_t i = 0; i < names.size(); ++i) {
      out_ += indent(depth_ + 1) + text_as_yaml(names[i]) + ":\n";
      Writer nested(variations(), out_, path_of(fmt::format("{}.{}", key, names[i])), depth_ + 2);
      item(i, nested);
    }
  }

 private:
  static std::string indent(int depth) { return std::string(2 * static_cast<std::size_t>(depth), ' '); }
  void write(const char* key, const std::string& value) override {
    out_ += indent(depth_) + key + (value.empty() ? ":" : ": ") + value + "\n";
  }

  std::string& out_;
  int depth_;
};

// The values of one section by their keys; those of a section within it as "split.by".
class SectionValues : public ValueVisitor {
 public:
  SectionValues(const std::vector<Variation>& variations, const std::string& section)
      : ValueVisitor(variations, section), section_(section) {}

  void section(const char* key, const Fields& fields) override {
    if (!inside_ && key != section_) return;
    const bool is_outer = !inside_;
    const std::string before = prefix_;
    if (!is_outer) prefix_ += std::string(key) + ".";
    inside_ = true;
    fields(*this);
    inside_ = !is_outer;
    prefix_ = before;
  }
  void list(const char*, std::size_t, std::size_t, const std::function<void(std::size_t)>&,
            const std::function<void(std::size_t, FieldVisitor&)>&) override {}
  void dictionary(const char*, const std::vector<std::string>&, std::size_t,
                  const std::function<void(const std::vector<std::string>&)>&,
                  const std::function<void(std::size_t, FieldVisitor&)>&) override {}

  std::vector<std::pair<std::string, std::string>> values;

 private:
  void write(const char* key, const std::string& value) override {
    if (inside_) values.emplace_back(prefix_ + key, value);
  }

  std::string section_;
  std::string prefix_;  // of the keys, within the section
  bool inside_ = false;
};

}  // namespace

std::string effective_yaml(const Scenario& scenario) {
  Scenario copy = scenario;
  std::string out;
  Writer writer(scenario.variations, out);
  visit_fields(copy, writer);
  return out;
}

std::vector<std::pair<std::string, std::string>> section_values(const Scenario& scenario, const std::string& section) {
  Scenario copy = scenario;
  SectionValues values(scenario.variations, section);
  visit_fields(copy, values);
  return std::move(values.values);
}

}  // namespace seaglint
