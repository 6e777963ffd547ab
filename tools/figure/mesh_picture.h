// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// Picture of a mesh: orthographic projection, flat Lambert shading, dark lines at discontinuities of depth or normal;
// its outline. The figure of a mesh with levels: facets coloured, points as balls, the largest with their names.

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "sim/geometry/mesh/triangle_mesh.h"
#include "tools/figure/figure.h"

namespace seaglint {

// View from infinity in the direction r^ of CONVENTIONS.md, "Frames".
struct PictureView {
  double azimuth_deg = 60;
  double elevation_deg = 15;
  int width = 1600;  // pixels, 16 <= x <= 8192
  int height = 0;    // pixels; 0 = height of the mesh at this width, at most the width
};

// Colours of a picture, and lines that what is nearer hides.
struct PicturePaint {
  std::span<const Rgb> triangles = {};  // one per triangle, shaded less than without; empty: all in one grey
  std::span<const std::array<Vec3, 2>> lines = {};
  Rgb line{};
};

struct Picture {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // row by row from the top
  Mat3 axes = Mat3::Identity();   // rows: right, up and towards the viewer, in the frame of the mesh
  double pixels_per_m = 1;
  std::array<double, 2> origin{};  // place of the mesh's origin, pixels from the top left corner

  // Place of a point, pixels from the top left corner.
  std::array<double, 2> place(const Vec3& p) const {
    const Vec3 q = axes * p;
    return {origin[0] + pixels_per_m * q.x(), origin[1] - pixels_per_m * q.y()};
  }
};

// The mesh fills the picture up to a margin of 3 %. Throws InputError for a size out of range or an empty mesh.
Picture picture_of(const TriangleMesh& mesh, const PictureView& view, const PicturePaint& paint = {});

// Outline of the mesh's projection: closed lines over the components along two perpendicular unit vectors, m, each
// ended by NaN; around holes too. From samples of sample_m; pieces of less than 20 samples are left out.
std::vector<std::array<double, 2>> outline_of(const TriangleMesh& mesh, const Vec3& right, const Vec3& up,
                                              double sample_m);

std::string png_bytes(const Picture& picture);

// A mesh seen from a direction, its triangles coloured by their levels.
struct MeshFigure {
  std::string title;
  TriangleMesh mesh;
  double azimuth_deg = 0, elevation_deg = 0;  // of the view
  std::vector<double> levels;                 // one per triangle; below the range of `colour`: grey
  FigureAxis colour;                          // with its range
  std::vector<std::array<Vec3, 2>> lines = {};
  std::string line_name = {};  // in the key
  // Points of the frame of the mesh, drawn as balls whose diameter is in proportion to the level in dB above the
  // lowest.
  struct Ball {
    Vec3 at;
    double level = 0;
    bool white = false;  // another kind than the red ones
  };
  std::vector<Ball> balls = {};
  AxisRange ball_range = {};  // levels of the smallest and the largest ball
  std::string ball_unit = {};
  std::array<std::string, 2> ball_names{};  // of the red and of the white balls, in the key
  struct Name {
    Vec3 at;
    std::vector<std::string> lines;
  };
  std::vector<Name> names = {};         // written above the mesh, from left to right, each with a line to its point
  std::vector<std::string> notes = {};  // lines of small print
};

// Throw as picture_of() and draw_by_gnuplot(); the second gives the bytes of a PNG.
void write_figure(const MeshFigure& figure, const std::filesystem::path& file);
std::string png_of(const MeshFigure& figure);

}  // namespace seaglint
