// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The HDF5 table that pandas writes of a monostatic sweep, DataFrame.to_hdf(FILE, key="df", format="table") with the
// index levels Freq, IWavePhi and IWaveTheta and one column of complex values. Only one thread at a time may use HDF5.

#include <filesystem>
#include <string>
#include <vector>

#include "sim/core/numbers/linear.h"

namespace seaglint {

struct PandasRow {
  double frequency = 0;  // in a unit that the file does not state
  double theta_deg = 0, phi_deg = 0;
  Complex value;
};

// Whether a file begins as HDF5 does; false too if it cannot be read.
bool is_hdf5_file(const std::filesystem::path& file);

// The rows of /df/table, all of them finite. The file may be damaged in any way or made to deceive: the table is
// reached by hard links and stored uncompressed in this file, in no more bytes than the file has. Throws InputError
// naming the file and what is missing or wrong.
std::vector<PandasRow> read_pandas_table(const std::filesystem::path& file);

// Whether the free list of every local heap in the file, where names of groups' members lie, ends within its heap and
// the heap within the file: HDF5 1.10 follows the list without end if it is a circle (section III.D).
bool has_sound_heaps(const std::filesystem::path& file);

}  // namespace seaglint
