// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The formats of field tables, behind read_field_table(): is_...() recognises one by its content, read_...() adds its
// values and notes to a table, by the settings where the file does not state them.

#include <filesystem>
#include <string_view>
#include <vector>

#include "sim/core/text/text_source.h"
#include "sim/field_tables/field_table.h"

namespace seaglint {

// CST farfield tables over theta and phi, and 1D curves over frequency, theta or phi: radar cross section, or the
// electric field at 1 m under a plane wave of 1 V/m.

// Whether one of the first lines has the names of the columns.
bool is_cst_table(const TextSource& source);

// The wanted elements of a farfield table: columns by their squeezed names, `Theta[deg.] Phi[deg.]
// Abs(Theta)[unit] Phase(Theta)[deg.] Abs(Phi)[unit] Phase(Phi)[deg.]`, or in Ludwig's third definition `Horiz(Abs)
// Horiz(Phase) Vert(Abs) Vert(Phase)`; units: LevelUnit. Theta below 0 is folded (|theta|, phi + 180). The table has
// neither frequency nor polarisation transmitted. `Abs(RCS)` or `Abs(E)` is read where there is no component: the sum
// over both received. Throws InputError with file, line and column.
void read_cst_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Whether one of the first lines has the names of the columns of a curve.
bool is_cst_curves(const TextSource& source);

// All blocks of a file, of both styles:
//   #Parameters = {theta=90; phi=10}                    (if any)
//   #"Frequency / GHz"<TAB>"RCS ... [Magnitude]"        two columns, or three: real and imaginary part, magnitude and
//   phase
//   #----
//   Frequency / GHz      RCS/abs,dBsm                   or older, the block ending with an empty line
//   ----
// What is not on the abscissa - frequency, theta, phi - comes from the parameters, the curve's name or the file's name,
// as `theta = 90`; the element from the settings or VV, HH, VH, HV in a name, or with `abs` in the curve's name and
// both received polarisations wanted their sum. CST prints [Magnitude] for decibels too: the unit is that of the name
// (m^2, dBsm, dB(m^2), V/m, dB(V/m)), else dBsm where a value is negative; else the file is refused. Throws InputError
// with file, line and column.
void read_cst_curves(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Complex far fields in blocks: FEKO far fields (.ffe) of the radar cross section by frequency and incident wave, and
// CST farfield sources (.ffs, version 3.0) over phi and theta at one or several frequencies.

bool is_feko_table(const TextSource& source);

// Every block of `#Result Type: RCS`. A block with one direction, that of its incident wave, is monostatic; blocks of
// one incident wave with several directions are bistatic, a cut per element and incident wave. E is S in metres
// (checked against the block's RCS); the incident wave at polarisation angle 0, which files do not state, is along
// -theta^ = v, at 90 deg along phi^ = h: without wanted elements v is taken. Throws InputError with file, line and
// column.
void read_feko_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

bool is_cst_source(const TextSource& source);

// The wanted elements of the scattered field at 1 m under a plane wave of 1 V/m, about the position in the file. The
// file has neither the incident wave nor its polarisation. Throws InputError with file, line and column for another
// version or data type, rotated axes, and blocks that are not as long as announced.
void read_cst_source(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// HFSS reports of the monostatic or bistatic radar cross section as csv, and PyAEDT's exports of the monostatic one: a
// JSON with the units beside an HDF5 table.

bool is_hfss_table(const TextSource& source);

// Columns by name, in the unit of their brackets: `IWavePhi [deg]`, `IWaveTheta [deg]`, `Freq [GHz]`, of a bistatic
// table also `Phi [deg]`, `Theta [deg]` of the receiver, and of the component received
//   MonostaticRCSTheta [m^2]         none or mag(): any unit of LevelUnit; [] is m^2, [dB] is dBsm
//   dB(MonostaticRCSTheta) []        dB(), dB10(), and dB20() of Complex: dBsm
//   re(), im() or mag(), ang_deg() of ComplexMonostaticRCSTheta [meter]      sqrt(sigma) e^{j phase}, a length
// or the same of ...Phi, of ...Total and of Bistatic. A value that is no column of its own stands in the name of the
// result, `dB(MonostaticRCSPhi) [] - Freq='10GHz' IWaveTheta='90deg'`, of which there may be many, or is the settings'
// frequency or incident wave. The incident wave is along theta^ or phi^; which of them the file does not say. ...Total
// is read where there is no component: the sum over both received. Throws InputError with file, line and column, also
// for a unit that is not read.
void read_hfss_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Whether a text is the JSON of such a pair: an object with the key monostatic_file.
bool is_pyaedt_json(std::string_view text);

// Reads either file of the pair; the other one is beside it: the JSON names the table, and a table is read with the
// unit of the JSON that names it. A value is sqrt(sigma) e^{j phase} in metres, e^{+jwt}, for a radar at IWaveTheta,
// IWavePhi; S = value / sqrt(4 pi). The element - received, transmitted - is a word VV, HV, VH or HH in the name of
// either file or else the only one wanted. The meshes of model_info, [file, colour, opacity, unit] each, become the
// table's geometry where all of them are in the folder `geometry` beside the JSON, or beside it. Throws InputError
// naming the file.
void read_pyaedt_file(const std::filesystem::path& file, const FieldTableSettings& settings, FieldTable& table);

// The HDF5 table that pandas writes of a monostatic sweep, DataFrame.to_hdf(FILE, key="df", format="table") with the
// index levels Freq, IWavePhi and IWaveTheta and one column of complex values. Only one thread at a time may use HDF5.
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

// Tables in columns: those of `seaglint rcs` with the keys of the transmitter in their head, levels with or without
// phases in named columns, and four columns without names.

// Whether a text is a table of `seaglint rcs`: one of the first lines has frequency_hz, azimuth_deg and elevation_deg
// and no phases; below a head of `seaglint rcs` one of the angles is enough.
bool is_own_table(const TextSource& source);

// Columns by name: xx_re and xx_im, or xx_dbsm alone; without wanted elements, all that the table has. Its head gives
// the transmitter. Throws InputError with file, line and column, and for a head of `seaglint rcs`
// without a transmitter.
void read_own_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Whether one of the first lines has numbers only, 3 to 5 of them.
bool is_four_columns(const TextSource& source);
bool has_four_columns(const TextSource& source);  // exactly 4 of them
// Whether one of the first lines, or a comment among them, has names of columns theta_deg and phi_deg, or of an azimuth
// and an element or level.
bool is_named_table(const TextSource& source);

// Frequency in Hz, theta, phi in degrees and level in dBsm in this order (Austin RCS Benchmark Suite). One element,
// which the name or the settings give.
void read_four_columns(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

// Columns by name and unit, in any order: azimuth (also az, aspect, angle, phi) in deg or rad, elevation
// or theta, frequency in Hz, kHz, MHz, GHz; of each element, HH, HV, VH, VV (received, transmitted), the level in dBsm
// or m^2, `HH (dBsm)`, `rcs_hh_dbsm`, and its phase, `HH phase (deg)`, e^{+jwt}; or one level of the element that the
// name or the settings give. What is missing is of the settings: the frequency, and the elevation, else 0. A table by
// azimuth is monostatic unless the settings say otherwise. Throws InputError with file, line and column, also for a
// column of these quantities without a unit.
void read_named_table(const TextSource& source, const FieldTableSettings& settings, FieldTable& table);

}  // namespace seaglint
