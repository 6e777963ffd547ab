// SPDX-License-Identifier: BSD-3-Clause
#include "sim/scenario/files/document.h"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <map>
#include <sstream>
#include <unordered_set>
#include <utility>

#include "sim/core/process/error.h"
#include "sim/core/process/printable.h"
#include "sim/core/text/text_source.h"
#include "sim/core/text/words.h"

namespace seaglint {

const YamlNode* YamlNode::find(std::string_view key) const {
  for (const YamlEntry& entry : entries) {
    if (entry.key == key) return &entry.value;
  }
  return nullptr;
}

YamlNode* YamlNode::find(std::string_view key) { return const_cast<YamlNode*>(std::as_const(*this).find(key)); }

namespace {

[[noreturn]] void fail(const std::string& name, const Location& location, const std::string& reason) {
  throw InputError(fmt::format("{}:{}:{}: {}", name, location.line, location.column, reason));
}

// yaml-cpp counts from 0; -1 means unknown.
Location location_of(const YAML::Mark& mark) {
  return {mark.line < 0 ? 1 : mark.line + 1, mark.column < 0 ? 1 : mark.column + 1};
}

YamlNode node_of(YamlNode::Kind kind, const YAML::Mark& mark) {
  YamlNode node;
  node.kind = kind;
  node.location = location_of(mark);
  return node;
}

std::size_t node_count(const YamlNode& node) {
  std::size_t count = 1;
  for (const YamlNode& item : node.items) count += node_count(item);
  for (const YamlEntry& entry : node.entries) count += 1 + node_count(entry.value);
  return count;
}

// Builds the tree from the parser's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  explicit TreeBuilder(const std::string& name) : name_(name) {}

  YamlNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    add(node_of(YamlNode::Kind::kNull, mark), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    check_tag(mark, tag);
    YamlNode node = node_of(YamlNode::Kind::kScalar, mark);
    node.text = value;
    node.quoted = tag == "!";
    add(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto named = anchors_.find(anchor);
    if (named == anchors_.end()) fail(name_, location_of(mark), "an alias inside the value it names");
    count(node_count(named->second), location_of(mark));
    add(named->second, 0);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::kList, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(YamlNode::Kind::kMap, mark, tag, anchor);
  }
  void OnMapEnd() override { close(); }

 private:
  // An unfinished list or map.
  struct Open {
    YamlNode node;
    YAML::anchor_t anchor = 0;
    bool has_key = false;  // of a map: the next value belongs to `key`
    bool key_quoted = false;
    std::string key{};
    Location key_location{};
    std::vector<YamlNode> merged{};  // of a map: those of its key <<
  };

  void check_tag(const YAML::Mark& mark, const std::string& tag) const {
    if (!tag.empty() && tag != "?" && tag != "!")
      fail(name_, location_of(mark), fmt::format("tag '{}': tags are not used here", tag));
  }

  void count(std::size_t nodes, const Location& location) {
    nodes_ += nodes;
    if (nodes_ > kMaxYamlNodes) fail(name_, location, fmt::format("more than {} values", kMaxYamlNodes));
  }

  void open(YamlNode::Kind kind, const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor) {
    check_tag(mark, tag);
    if (open_.size() >= static_cast<std::size_t>(kMaxYamlDepth)) {
      fail(name_, location_of(mark), fmt::format("nested deeper than {} levels", kMaxYamlDepth));
    }
    open_.push_back({node_of(kind, mark), anchor});
  }

  // The maps of a merge key (yaml.org/type/merge.html).
  void merge_later(Open& map, YamlNode value) {
    if (!map.merged.empty()) fail(name_, map.key_location, "the key << appears twice");
    if (value.kind != YamlNode::Kind::kList) {
      map.merged.push_back(std::move(value));
    } else {
      map.merged = std::move(value.items);
    }
    const bool maps = std::all_of(map.merged.begin(), map.merged.end(),
                                  [](const YamlNode& node) { return node.kind == YamlNode::Kind::kMap; });
    if (map.merged.empty() || !maps) fail(name_, map.key_location, "the value of << must be a map or a list of maps");
  }

  // Adds the entries of merged maps whose keys the map lacks; of several maps the first has precedence.
  static void merge(Open& map) {
    if (map.merged.empty()) return;
    std::unordered_set<std::string> keys;
    for (const YamlEntry& entry : map.node.entries) keys.insert(entry.key);
    for (YamlNode& other : map.merged) {
      for (YamlEntry& entry : other.entries) {
        if (keys.insert(entry.key).second) map.node.entries.push_back(std::move(entry));
      }
    }
  }

  void close() {
    Open finished = std::move(open_.back());
    open_.pop_back();
    merge(finished);
    add(std::move(finished.node), finished.anchor);
  }

  // Inserts a finished node into its parent.
  void add(YamlNode node, YAML::anchor_t anchor) {
    count(1, node.location);
    if (anchor != 0) {
      count(node_count(node), node.location);
      anchors_[anchor] = node;
    }
    if (open_.empty()) {
      root_ = std::move(node);
      return;
    }
    Open& parent = open_.back();
    if (parent.node.kind == YamlNode::Kind::kList) {
      parent.node.items.push_back(std::move(node));
    } else if (!parent.has_key) {
      if (node.kind != YamlNode::Kind::kScalar) fail(name_, node.location, "a key must be plain text");
      parent.has_key = true;
      parent.key_quoted = node.quoted;
      parent.key = std::move(node.text);
      parent.key_location = node.location;
    } else {
      parent.has_key = false;
      // yaml-cpp reports a missing value at the position of the next token.
      if (node.kind == YamlNode::Kind::kNull) node.location = parent.key_location;
      if (parent.key == "<<" && !parent.key_quoted) {
        merge_later(parent, std::move(node));
      } else {
        parent.node.entries.push_back({std::move(parent.key), parent.key_location, std::move(node)});
      }
    }
  }

  const std::string& name_;
  YamlNode root_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, YamlNode> anchors_;  // finished nodes only
  std::size_t nodes_ = 0;
};

constexpr std::string_view kIndicators = ",:[]{}&*!\"'";

// Rejects control characters (not a text file), encodings other than UTF-8, which JSON cannot represent, and more
// indicators than yaml-cpp has memory for.
void check_text(const std::string& text, const std::string& name) {
  const std::string_view kind = foreign_kind(text);
  if (!kind.empty()) throw InputError(fmt::format("{}: no plain text: it is {}", name, kind));
  Location location;
  const std::size_t utf8 = utf8_prefix(text);
  std::size_t indicators = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (i == utf8) fail(name, location, fmt::format("byte 0x{:02x}: not a text in UTF-8", c));
    if ((c < 0x20 && c != '\n' && c != '\r' && c != '\t') || c == 0x7f) {
      fail(name, location, fmt::format("byte 0x{:02x}: not a text file", c));
    }
    if (kIndicators.find(text[i]) != std::string_view::npos && ++indicators > kMaxYamlIndicators)
      fail(name, location, fmt::format("more than {} of the characters {}", kMaxYamlIndicators, kIndicators));
    if (c == '\n') {
      ++location.line;
      location.column = 1;
    } else {
      ++location.column;
    }
  }
}

}  // namespace

YamlNode parse_yaml(const std::string& text, const std::string& name) {
  if (text.size() > kMaxYamlBytes)
    throw InputError(fmt::format("{}: has {} bytes, more than the limit of {}", name, text.size(), kMaxYamlBytes));
  check_text(text, name);
  TreeBuilder builder(name);
  try {
    std::istringstream stream(text);
    YAML::Parser parser(stream);
    if (!parser.HandleNextDocument(builder)) return {};
    YamlNode root = builder.take_root();
    if (parser.HandleNextDocument(builder)) {
      fail(name, builder.take_root().location, "a second document: only one is allowed");
    }
    return root;
  } catch (const YAML::Exception& error) {
    const Location location = location_of(error.mark);
    std::string_view rest = text, line;
    for (int n = 0; n < location.line; ++n) line = next_line(rest);
    fail(name, location, "not valid YAML: " + error.msg + lookalike_note(line));
  }
}

}  // namespace seaglint
