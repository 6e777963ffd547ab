// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The types of a function's parameters as normalised text, so that two parameter lists can be compared.

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/cpp_tokens.h"

namespace seaglint {

// The type of one parameter without its name. The const of a parameter passed by value and the size of an array are not
// part of a function's type.
inline std::string parameter_type(std::vector<std::string> words) {
  static const std::set<std::string> kKeywords = {"int",   "double", "float", "bool",     "char", "void",
                                                  "short", "long",   "auto",  "unsigned", "const"};
  const auto has = [&](const char* word) { return std::find(words.begin(), words.end(), word) != words.end(); };
  std::string array;
  if (words.back() == "]") {
    array = "[]";
    words.erase(std::find(words.begin(), words.end(), "["), words.end());
  }
  const std::string before = words.size() > 1 ? words[words.size() - 2] : "::";
  const bool named = Token{words.back()}.is_name() && !kKeywords.contains(words.back()) && before != "::" &&
                     before != "const" && before != "typename";
  if (named) words.pop_back();
  if (!has("&") && !has("*") && words.front() == "const") words.erase(words.begin());
  std::string type;
  for (const std::string& word : words) {
    const bool spaced = !type.empty() && Token{word}.is_name() && std::isalnum(static_cast<unsigned char>(type.back()));
    type += (spaced ? " " : "") + (word == "fs" ? "std::filesystem" : word);
  }
  return type + array;
}

// Of the parameters between two round brackets: `open` is the first one, `close` past the second. Defaults are left
// out.
inline std::string parameter_types(const std::vector<Token>& tokens, std::size_t open, std::size_t close) {
  std::string list;
  std::vector<std::string> words;
  bool in_default = false;
  for (std::size_t i = open + 1; i < close;) {
    const std::string& token = tokens[i].text;
    if (token == "," || i + 1 == close) {
      if (!words.empty()) list += (list.empty() ? "" : ", ") + parameter_type(words);
      words.clear();
      in_default = false;
      ++i;
      continue;
    }
    if (token == "=") in_default = true;
    const bool bracket = token == "(" || token == "{" || (token == "<" && !in_default);
    for (const std::size_t end = bracket ? past_bracket(tokens, i) : i + 1; i < end; ++i) {
      if (!in_default) words.push_back(tokens[i].text);
    }
  }
  return list;
}

}  // namespace seaglint
