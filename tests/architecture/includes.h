// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Which files include which, and the circles among them.

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_files.h"

namespace seaglint {

struct Include {
  std::string file;    // relative to the root
  std::string header;  // as written
  bool system = false;

  bool is_generated() const { return header.starts_with("seaglint_"); }  // below build/
};

inline std::vector<Include> includes_of(const std::vector<SourceFile>& files) {
  static const std::regex pattern(R"re(^\s*#\s*include\s*([<"])([^">]+)[">])re");
  std::vector<Include> found;
  for (const SourceFile& file : files) {
    for (const std::string& line : lines_of(file.text)) {
      std::smatch match;
      if (line.find('#') != std::string::npos && std::regex_search(line, match, pattern))
        found.push_back({file.path, match[2], match[1] == "<"});
    }
  }
  return found;
}

// A header with the source of the same name.
inline std::string module_of(const std::string& file) { return file.substr(0, file.rfind('.')); }

using Circle = std::set<std::string>;  // modules that all reach one another

// Strongly connected sets of two and more modules (Tarjan, SIAM J. Comput. 1 (1972) 146).
inline std::set<Circle> circles_of(const std::vector<Include>& includes) {
  std::map<std::string, std::set<std::string>> graph;
  for (const Include& include : includes) {
    if (!include.system && module_of(include.file) != module_of(include.header))
      graph[module_of(include.file)].insert(module_of(include.header));
  }
  std::map<std::string, std::size_t> index, lowest;
  std::vector<std::string> stack;
  std::set<Circle> circles;
  const std::function<void(const std::string&)> visit = [&](const std::string& module) {
    index[module] = lowest[module] = index.size();
    stack.push_back(module);
    for (const std::string& next : graph[module]) {
      if (!index.contains(next)) {
        visit(next);
        lowest[module] = std::min(lowest[module], lowest[next]);
      } else if (std::find(stack.begin(), stack.end(), next) != stack.end()) {
        lowest[module] = std::min(lowest[module], index[next]);
      }
    }
    if (lowest[module] != index[module]) return;
    Circle circle;
    for (bool whole = false; !whole; stack.pop_back()) {
      circle.insert(stack.back());
      whole = stack.back() == module;
    }
    if (circle.size() > 1) circles.insert(circle);
  };
  std::vector<std::string> modules;
  for (const auto& [module, headers] : graph) modules.push_back(module);
  for (const std::string& module : modules) {
    if (!index.contains(module)) visit(module);
  }
  return circles;
}

}  // namespace seaglint
