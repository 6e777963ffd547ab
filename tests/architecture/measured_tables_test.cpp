// SPDX-License-Identifier: BSD-3-Clause
// The measured tables of the documents show the records in tests/figures, which hold the figures that tests record.
#include <gmock/gmock.h>

#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/architecture/source_files.h"

namespace seaglint {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

using Faults = std::vector<std::string>;
using Tables = std::map<std::string, std::string>;  // text between the markers, by the table's name

struct Figure {
  std::string part;  // of the measurement
  std::string text;  // as the tables show it
};
using Record = std::map<std::string, Figure>;  // by identifier

std::string text_of(const std::string& path) {
  std::ifstream file(std::string(SEAGLINT_SOURCE_DIR "/") + path, std::ios::binary);
  EXPECT_TRUE(file) << path;
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// Lines of identifier, part and figure with tabulators between them; `#` starts a comment.
Record record_in(const std::string& text, Faults& faults) {
  Record record;
  for (const std::string& line : lines_of(text)) {
    if (line.starts_with("#")) continue;
    const std::vector<std::string> cells = split(line, '\t');
    if (cells.size() != 3)
      faults.push_back("no row of a record: " + line);
    else if (!record.emplace(cells[0], Figure{cells[1], cells[2]}).second)
      faults.push_back("recorded twice: " + cells[0]);
  }
  return record;
}

// Both records; an identifier stands in one of them only.
Record all_figures(Faults& faults) {
  Record all = record_in(text_of("tests/figures/accuracy.tsv"), faults);
  for (const auto& [identifier, figure] : record_in(text_of("tests/figures/speed.tsv"), faults))
    if (!all.emplace(identifier, figure).second) faults.push_back("in both records: " + identifier);
  return all;
}

Tables tables_in(const std::string& text) {
  static const std::regex start(R"(<!-- table ([a-z_]+), written by tools/measure -->)");
  Tables tables;
  std::string name;
  for (const std::string& line : lines_of(text)) {
    std::smatch match;
    if (std::regex_match(line, match, start))
      tables[name = match[1]];
    else if (line == "<!-- end of table -->")
      name.clear();
    else if (!name.empty())
      tables[name] += line + "\n";
  }
  return tables;
}

std::vector<std::string> identifiers_in(const std::string& text) {
  static const std::regex placeholder(R"(\{([a-z][a-z0-9_]*)\})");
  std::vector<std::string> identifiers;
  for (std::sregex_iterator match(text.begin(), text.end(), placeholder), end; match != end; ++match)
    identifiers.push_back((*match)[1]);
  return identifiers;
}

// A template with its figures; one that no record has stays in braces and shows as a difference.
std::string filled(std::string text, const Record& record) {
  for (const std::string& identifier : identifiers_in(text)) {
    const auto figure = record.find(identifier);
    const std::string placeholder = "{" + identifier + "}";
    if (figure != record.end()) text.replace(text.find(placeholder), placeholder.size(), figure->second.text);
  }
  return text;
}

// The rows of a table's template in which nothing is measured, its heading not counted.
Faults rows_without_figures(const std::string& table) {
  Faults found;
  const std::vector<std::string> lines = lines_of(table);
  for (std::size_t i = 2; i < lines.size(); ++i)
    if (identifiers_in(lines[i]).empty()) found.push_back(lines[i]);
  return found;
}

// The identifiers that calls of record_figure() give, each as an expression in which arguments are any letters.
std::vector<std::string> recorded_in(const std::string& source) {
  static const std::regex call(R"re(\brecord_figure\([^";]*"([^"]+)")re"), argument(R"(\{[^}]*\})");
  std::vector<std::string> expressions;
  for (std::sregex_iterator match(source.begin(), source.end(), call), end; match != end; ++match)
    expressions.push_back(std::regex_replace((*match)[1].str(), argument, "[a-z0-9_]+"));
  return expressions;
}

// Calls whose figure is in no record, and records of tests whose call is in no source.
Faults differences(const std::vector<std::string>& expressions, const Record& record) {
  Faults faults;
  std::set<std::string> unclaimed;
  for (const auto& [identifier, figure] : record)
    if (figure.part == "tests") unclaimed.insert(identifier);
  const std::set<std::string> recorded = unclaimed;
  for (const std::string& expression : expressions) {
    const std::regex pattern(expression);
    bool found = false;
    for (const std::string& identifier : recorded) {
      if (!std::regex_match(identifier, pattern)) continue;
      found = true;
      unclaimed.erase(identifier);
    }
    if (!found) faults.push_back("not in the record: " + expression);
  }
  for (const std::string& identifier : unclaimed) faults.push_back("in no source: " + identifier);
  return faults;
}

TEST(MeasuredTables, ShowTheRecords) {
  Faults faults;
  const Record record = all_figures(faults);
  const Tables templates = tables_in(text_of("tests/figures/tables.md"));
  EXPECT_GT(templates.size(), 10u) << "the test finds no templates";
  std::set<std::string> missing;
  for (const auto& [name, text] : templates) missing.insert(name);
  for (const char* document :
       {"README.md", "tests/accuracy.md", "tests/bench/README.md", "sim/scattering/radiation/README.md"}) {
    for (const auto& [name, shown] : tables_in(text_of(document))) {
      EXPECT_EQ(missing.erase(name), 1u) << document << ": table " << name << " has no template, or stands twice";
      const auto text = templates.find(name);
      if (text == templates.end()) continue;
      EXPECT_EQ(shown, filled(text->second, record)) << document << ", table " << name << ": run tools/measure tables";
    }
  }
  EXPECT_THAT(missing, IsEmpty()) << "tables of no document";
  EXPECT_THAT(faults, IsEmpty());
}

TEST(MeasuredTables, HaveAFigureInEveryRowAndShowEveryFigure) {
  Faults faults;
  const Record record = all_figures(faults);
  std::set<std::string> of_no_table, of_no_record;
  for (const auto& [identifier, figure] : record) of_no_table.insert(identifier);
  for (const auto& [name, text] : tables_in(text_of("tests/figures/tables.md"))) {
    EXPECT_THAT(rows_without_figures(text), IsEmpty()) << name;
    for (const std::string& identifier : identifiers_in(text)) {
      of_no_table.erase(identifier);
      if (!record.contains(identifier)) of_no_record.insert(identifier);
    }
  }
  EXPECT_THAT(of_no_table, IsEmpty());
  EXPECT_THAT(of_no_record, IsEmpty());
  EXPECT_THAT(faults, IsEmpty());
}

TEST(MeasuredTables, HoldTheFiguresThatTestsRecord) {
  std::vector<std::string> expressions;
  for (const SourceFile& file : code_files()) {
    if (!file.path.ends_with("_test.cpp") || file.is_below("tests/architecture")) continue;
    for (std::string& expression : recorded_in(file.text)) expressions.push_back(std::move(expression));
  }
  EXPECT_GT(expressions.size(), 50u) << "the test finds no calls";
  Faults faults;
  EXPECT_THAT(differences(expressions, all_figures(faults)), IsEmpty()) << "run tools/measure accuracy";
}

TEST(MeasuredTables, ThatAreWrongAreFound) {
  const std::string table = "| case | figure |\n|---|---|\n| sphere | {a_db} / {b} dB |\n| plate | 3 dB |\n";
  const Record record{{"a_db", {"tests", "0.10"}}, {"c_10", {"tests", "1"}}, {"d", {"build", "2"}}};
  EXPECT_THAT(rows_without_figures(table), ElementsAre("| plate | 3 dB |"));
  EXPECT_EQ(filled("{a_db} / {b}", record), "0.10 / {b}");
  EXPECT_EQ(tables_in("x\n<!-- table t, written by tools/measure -->\n" + table + "<!-- end of table -->\ny\n"),
            (Tables{{"t", table}}));
  const std::vector<std::string> calls = recorded_in(
      "record_figure(max(a, b), 2, \"a_db\");\n  record_figure(2,\n 3, \"c_{:.0f}\", x); record_figure(1, 1, \"e\");");
  EXPECT_THAT(differences(calls, record), ElementsAre("not in the record: e"));
  EXPECT_THAT(differences({"a_db", "e"}, record), UnorderedElementsAre("not in the record: e", "in no source: c_10"));
  Faults faults;
  record_in("# x\na\ttests\t1\na\ttests\t2\nb\n", faults);
  EXPECT_THAT(faults, ElementsAre("recorded twice: a", "no row of a record: b"));
}

}  // namespace
}  // namespace seaglint
