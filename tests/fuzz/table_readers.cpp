// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <vector>

#include "sim/core/text/words.h"
#include "sim/motion/recorded/attitude_series.h"
#include "sim/motion/ship/rao_files.h"
#include "sim/motion/strip_theory/hull_sections.h"
#include "sim/scenario/files/tables.h"
#include "tests/fuzz/readers.h"

namespace seaglint {
namespace {

bool ascends(const std::vector<double>& values) {
  return std::adjacent_find(values.begin(), values.end(), [](double a, double b) { return !(a < b); }) == values.end();
}

bool is_finite(const MotionRao& rao) {
  return std::isfinite(std::abs(rao.surge + rao.sway + rao.heave + rao.roll + rao.pitch + rao.yaw));
}

}  // namespace

void fuzz_numbers(const std::string& bytes) {
  parse_number(bytes);
  parse_any_number(bytes);
  parse_written_number(bytes);
  parse_integer(bytes);
  parse_natural(bytes);
  is_refused([&] {
    const std::vector<double> range = parse_range(bytes, 10000);
    SEAGLINT_CHECK(range.size() <= 10000, bytes);
  });
}

void fuzz_spectrum(const std::string& bytes) {
  is_refused([&] {
    const SpectrumTable table = read_spectrum_table({"spectrum.csv", bytes});
    SEAGLINT_CHECK(ascends(table.omega) && table.omega.size() == table.density.size(), "no spectrum");
    table.energy();
    table.peak_omega();
  });
  is_refused([&] { read_spectrum_table({"spectrum.csv", bytes}, "2018-01-01 01:40"); });
}

void fuzz_hop_code(const std::string& bytes) {
  is_refused([&] {
    constexpr int kCarriers = 16;
    for (const int carrier : read_hop_code({"code.txt", bytes}, 4, kCarriers))
      SEAGLINT_CHECK(carrier >= 0 && carrier < kCarriers, "a carrier that is none");
  });
}

void fuzz_scatter(const std::string& bytes) {
  is_refused([&] {
    const ScatterDiagram diagram = read_scatter_diagram({"seas.csv", bytes});
    Random random({1, Stream::kTest, 1});
    const SeaPair pair = diagram.draw(random), likeliest = diagram.likeliest();
    SEAGLINT_CHECK(pair.significant_wave_height_m > 0 && pair.period_s >= 0 && likeliest.period_s >= 0 &&
                       std::isfinite(pair.significant_wave_height_m + pair.period_s + likeliest.period_s),
                   "no sea");
  });
}

void fuzz_series(const std::string& bytes) {
  is_refused([&] {
    const AttitudeSeries series = read_attitude_series(file_of(bytes, "series.csv"));
    SEAGLINT_CHECK(ascends(series.time) && series.time.size() == series.samples.size(), "no series");
    const double duration = series.time.back() - series.time.front();
    trajectory_of(series, series.time.front(), duration, true, Vec3::Zero(), Vec3::Zero());
    read_attitude_series(file_of(bytes, "series.csv"), {true, MeanRule::kRemove, MeanRule::kRemove});
  });
}

void fuzz_sections(const std::string& bytes) {
  is_refused([&] {
    constexpr int kCount = 20;
    const HullSections hull = read_sections(file_of(bytes, "sections.csv"), kCount);
    SEAGLINT_CHECK(hull.sections.size() == kCount, "another number of sections");
  });
}

void fuzz_veres(const std::string& bytes) {
  is_refused([&] {
    const RaoTable table = read_veres_rao(file_of(bytes, "rao.re1"), 10);
    SEAGLINT_CHECK(ascends(table.headings()) && ascends(table.omegas()), "no grid");
    is_refused([&] { SEAGLINT_CHECK(is_finite(table.at(table.omegas()[0], 0.1, table.headings()[0])), "NaN"); });
  });
}

void fuzz_wamit(const std::string& bytes) {
  is_refused([&] {
    const MotionSpec other{.rao_phase_deg = 90,
                           .rao_rotations = RaoRotations::kSlopeDegrees,
                           .rao_follows_long_waves = false,
                           .wamit_body = 2,
                           .wamit_xbody_m = {1, 2, 3},
                           .wamit_first_column = WamitFirstColumn::kOmega};
    read_wamit_rao(file_of(bytes, "rao.4"), other);
  });
  is_refused([&] {
    const RaoTable table = read_wamit_rao(file_of(bytes, "rao.4"), {});
    SEAGLINT_CHECK(ascends(table.headings()) && ascends(table.omegas()), "no grid");
    is_refused([&] { SEAGLINT_CHECK(is_finite(table.at(table.omegas()[0], 0.1, table.headings()[0])), "NaN"); });
  });
}

}  // namespace seaglint
