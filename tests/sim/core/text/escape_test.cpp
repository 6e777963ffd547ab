// SPDX-License-Identifier: BSD-3-Clause
#include "sim/core/process/printable.h"

#include <gtest/gtest.h>

namespace seaglint {
namespace {

TEST(Escape, CellsOfCsvAreQuotedByRfc4180AndNoFormulas) {
  EXPECT_EQ(csv_cell("deck house 2"), "deck house 2");
  EXPECT_EQ(csv_cell("a,b"), "\"a,b\"");
  EXPECT_EQ(csv_cell("a \"b\""), "\"a \"\"b\"\"\"");
  EXPECT_EQ(csv_cell("=cmd|calc,\"x"), "\"'=cmd|calc,\"\"x\"");
  for (const char* formula : {"=1", "+1", "-1", "@SUM(A1)"}) EXPECT_EQ(csv_cell(formula)[0], '\'') << formula;
  EXPECT_EQ(csv_cell(" =1"), "' =1");
  EXPECT_EQ(csv_cell(" 1"), "\" 1\"");
  EXPECT_EQ(csv_cell("\t=1\nnext row"), "\\x09=1\\nnext row");
  EXPECT_EQ(csv_cell(""), "");
}

TEST(Escape, MarkdownHasNoStructureOfTheText) {
  EXPECT_EQ(markdown_text("fast-craft_1 (new).glb"), "fast-craft_1 (new).glb");
  EXPECT_EQ(markdown_text("a|b <script> [x](y) `c` &amp;"), "a\\|b \\<script\\> \\[x\\](y) \\`c\\` \\&amp;");
  EXPECT_EQ(markdown_text("a\n# b"), "a\\\\n\\# b");
}

TEST(Escape, InlineCodeOfMarkdownEndsBehindTheText) {
  EXPECT_EQ(markdown_code("quick"), "`quick`");
  EXPECT_EQ(markdown_code("a`b``c"), "``` a`b``c ```");
  EXPECT_EQ(markdown_code("a\nb"), "`a\\nb`");
}

}  // namespace
}  // namespace seaglint
