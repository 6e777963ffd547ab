// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Text of a user's files as part of a table or a document, in which it must not be taken for structure or a command.

#include <string>
#include <string_view>

namespace seaglint {

// A cell of a CSV table (RFC 4180): quoted where it contains a comma, a quote or outer blanks. Text that a spreadsheet
// would take for a formula (=, +, -, @ at its beginning) gets an apostrophe in front; control characters are escaped.
std::string csv_cell(std::string_view text);

// Markdown that shows the text on one line, in a paragraph or a table's cell: no HTML, link, code or cell of its own.
std::string markdown_text(std::string_view text);

// The text as inline code of Markdown; not for a table's cell.
std::string markdown_code(std::string_view text);

}  // namespace seaglint
