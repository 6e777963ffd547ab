// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Drawing by gnuplot: format by the file's name (.png, .svg or .pdf), size and text of a style, complete files only.

#include <filesystem>
#include <string>

namespace seaglint {

// kScreen: of the size given. kPaper, kPaperWide: one or two columns of a journal, 88 or 180 mm wide with the height in
// proportion, text of 7 or 8 points; .png with 300 dots per inch.
enum class FigureStyle { kScreen, kPaper, kPaperWide };

// The style of a name, "screen", "paper" or "paper-wide"; any other is kScreen.
FigureStyle figure_style(const std::string& name);

struct FigureSize {
  int width = 900;  // pixels of 1/96 inch
  int height = 560;
  FigureStyle style = FigureStyle::kScreen;
};

// Area of a figure and size of its text, pixels of 1/96 inch.
struct FigureArea {
  double width = 0, height = 0, em = 0;
};
FigureArea figure_area(FigureSize size);

// Throws WorkError where gnuplot is missing, as draw_by_gnuplot() would, so that it is reported before any work.
void require_gnuplot();

// Throws, as draw_by_gnuplot() would but before any work, where the name ends in none of .png, .svg and .pdf, the
// directory is not writable or gnuplot is missing. An empty name passes.
void require_figure(const std::filesystem::path& file);

// gnuplot's name of the data of draw_by_gnuplot().
inline constexpr const char* kGnuplotData = "data";

// gnuplot's name of the font of small print, 0.8 of the text.
inline constexpr const char* kSmallFont = "small";

// gnuplot's names of what makes the formats alike: characters by which a label moves towards its axis, factor of marks.
inline constexpr const char* kLabelShift = "label_shift";
inline constexpr const char* kMarkSize = "mark_size";

// A string in gnuplot's single quotes; line breaks, which would end the command, are blanks.
std::string gnuplot_text(const std::string& text);

// A number of a command or of data; NaN is a gap.
std::string gnuplot_number(double value);

// Writes the figure of gnuplot's commands completely or not at all. Text is literal (no markup), and every name is that
// of a file: none is a pipe to gnuplot, which draws in memory. Throws InputError for a file of another format,
// WorkError when gnuplot is missing or fails (with its message) or the file cannot be written. Ctrl-C ends gnuplot and
// takes effect after it; if the process continues, Interrupted is thrown. The same commands and data give the same
// bytes.
void draw_by_gnuplot(const std::filesystem::path& file, FigureSize size, const std::string& data,
                     const std::string& commands);

// The bytes of that figure, in the format by which the name ends; no file is written.
std::string figure_bytes(const std::filesystem::path& name, FigureSize size, const std::string& data,
                         const std::string& commands);

}  // namespace seaglint
