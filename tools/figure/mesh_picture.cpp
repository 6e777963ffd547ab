// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/mesh_picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include "sim/core/numbers/constants.h"
#include "sim/core/process/error.h"

namespace seaglint {
namespace {

constexpr int kSamples = 3;  // per pixel and axis
constexpr double kMargin = 0.03;

// Directions of the picture: right, up and towards the viewer.
struct Camera {
  Vec3 right, up, eye;
};

Camera camera_of(const PictureView& view) {
  const double az = radians(view.azimuth_deg), el = radians(view.elevation_deg);
  Camera camera;
  camera.eye = {std::cos(el) * std::cos(az), std::cos(el) * std::sin(az), std::sin(el)};
  camera.right = {-std::sin(az), std::cos(az), 0};
  camera.up = camera.eye.cross(camera.right);
  return camera;
}

struct PixelSample {
  float depth = -std::numeric_limits<float>::infinity();
  float brightness = 0;
  float facing = 0;
  std::int32_t triangle = 0;  // kOfLine: a line
};
constexpr std::int32_t kOfLine = -1;

class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height), samples_(static_cast<std::size_t>(width) * height) {}

  // Rasterises a triangle with vertices in sample coordinates and depth; the nearest surface is kept.
  void fill(const std::array<Vec3, 3>& p, const PixelSample& surface) {
    const double area = (p[1] - p[0]).x() * (p[2] - p[0]).y() - (p[1] - p[0]).y() * (p[2] - p[0]).x();
    if (area == 0) return;
    const auto clamp_to = [](double v, int limit) {
      return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(limit)));
    };
    const auto [x0, x1] = std::minmax({p[0].x(), p[1].x(), p[2].x()});
    const auto [y0, y1] = std::minmax({p[0].y(), p[1].y(), p[2].y()});
    for (int y = clamp_to(std::floor(y0), height_); y < clamp_to(std::ceil(y1) + 1, height_); ++y) {
      for (int x = clamp_to(std::floor(x0), width_); x < clamp_to(std::ceil(x1) + 1, width_); ++x) {
        const Vec3 q(x + 0.5, y + 0.5, 0);
        double weight[3];
        for (int i = 0; i < 3; ++i) {
          const Vec3 a = p[(i + 1) % 3] - q, b = p[(i + 2) % 3] - q;
          weight[i] = (a.x() * b.y() - a.y() * b.x()) / area;
        }
        if (weight[0] < 0 || weight[1] < 0 || weight[2] < 0) continue;
        const auto depth = static_cast<float>(weight[0] * p[0].z() + weight[1] * p[1].z() + weight[2] * p[2].z());
        PixelSample& sample = samples_[static_cast<std::size_t>(y) * width_ + x];
        if (depth > sample.depth) sample = {depth, surface.brightness, surface.facing, surface.triangle};
      }
    }
  }

  // Draws a line of two pixels where no surface is nearer than it by more than `step`.
  void line(const Vec3& from, const Vec3& to, float step) {
    const Vec3 along = to - from;
    const int count = 1 + static_cast<int>(std::ceil(std::hypot(along.x(), along.y())));
    for (int i = 0; i <= count; ++i) {
      const Vec3 q = from + along * (static_cast<double>(i) / count);
      for (int y = static_cast<int>(q.y()) - kSamples; y < static_cast<int>(q.y()) + kSamples; ++y) {
        for (int x = static_cast<int>(q.x()) - kSamples; x < static_cast<int>(q.x()) + kSamples; ++x) {
          if (x < 0 || y < 0 || x >= width_ || y >= height_) continue;
          PixelSample& sample = samples_[static_cast<std::size_t>(y) * width_ + x];
          if (q.z() + step >= sample.depth) sample = {static_cast<float>(q.z()), 1, 0, kOfLine};
        }
      }
    }
  }

  const PixelSample& at(int x, int y) const {
    return samples_[static_cast<std::size_t>(std::clamp(y, 0, height_ - 1)) * width_ + std::clamp(x, 0, width_ - 1)];
  }

 private:
  int width_, height_;
  std::vector<PixelSample> samples_;
};

// Darkness of the line at a sample: on the silhouette, where depth departs from the plane through the two neighbours by
// more than `step`, or where the shade changes.
double line_at(const Canvas& canvas, int x, int y, float step) {
  const PixelSample& here = canvas.at(x, y);
  double line = 0;
  for (const auto& [dx, dy] : {std::pair{1, 0}, std::pair{0, 1}}) {
    const PixelSample &before = canvas.at(x - dx, y - dy), &after = canvas.at(x + dx, y + dy);
    if (std::isinf(here.depth) && std::isinf(after.depth)) continue;
    if (std::isinf(here.depth) != std::isinf(after.depth)) return 0.55;
    if (!std::isinf(before.depth) && std::abs(after.depth - 2 * here.depth + before.depth) > step) line = 0.4;
    if (std::abs(here.brightness - after.brightness) > 0.02F || std::abs(here.facing - after.facing) > 0.1F) {
      line = std::max(line, 0.2);
    }
  }
  return line;
}

}  // namespace

Picture picture_of(const TriangleMesh& mesh, const PictureView& view, const PicturePaint& paint) {
  if (mesh.triangles.empty()) throw InputError("a mesh without triangles has no picture");
  if (view.width < 16 || view.width > 8192 || view.height < 0 || view.height > 8192) {
    throw InputError(fmt::format("a picture of {} by {} pixels is outside 16..8192", view.width, view.height));
  }
  const Camera camera = camera_of(view);
  const auto in_camera_axes = [&](const Vec3& p) {
    return Vec3(camera.right.dot(p), camera.up.dot(p), camera.eye.dot(p));
  };

  Vec3 low = in_camera_axes(mesh.vertices[mesh.triangles[0][0]]), high = low;
  for (const auto& triangle : mesh.triangles) {
    for (std::uint32_t v : triangle) {
      low = low.cwiseMin(in_camera_axes(mesh.vertices[v]));
      high = high.cwiseMax(in_camera_axes(mesh.vertices[v]));
    }
  }
  const Vec3 size = (high - low).cwiseMax(Vec3::Constant(1e-9));
  const double margin = kMargin * std::max(size.x(), size.y());
  const double span_x = size.x() + 2 * margin, span_y = size.y() + 2 * margin;
  Picture picture;
  picture.width = view.width;
  picture.height = view.height > 0
                       ? view.height
                       : std::clamp(static_cast<int>(std::ceil(view.width * span_y / span_x)), 16, view.width);
  const double scale = kSamples * std::min(picture.width / span_x, picture.height / span_y);
  const double x0 = 0.5 * kSamples * picture.width - scale * 0.5 * (low.x() + high.x());
  const double y0 = 0.5 * kSamples * picture.height + scale * 0.5 * (low.y() + high.y());
  const auto in_samples = [&](const Vec3& point) {
    const Vec3 p = in_camera_axes(point);
    return Vec3(x0 + scale * p.x(), y0 - scale * p.y(), p.z());
  };
  picture.axes = Mat3(camera.right, camera.up, camera.eye).transpose();
  picture.pixels_per_m = scale / kSamples;
  picture.origin = {x0 / kSamples, y0 / kSamples};

  // Light source above and to the left of the viewer; sheets are shaded from both sides.
  const Vec3 light = (camera.eye + 0.55 * Vec3::UnitZ() - 0.6 * camera.right).normalized();
  Canvas canvas(kSamples * picture.width, kSamples * picture.height);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    if (area.norm() == 0) continue;
    Vec3 normal = area.normalized();
    if (normal.dot(camera.eye) < 0) normal = -normal;
    // Colours keep what a scale of colours needs.
    const double lightest = paint.triangles.empty() ? 0.70 : 0.20;
    const double shade = 1 - lightest + lightest * std::max(0.0, normal.dot(light));
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i) corners[i] = in_samples(mesh.vertices[mesh.triangles[t][i]]);
    canvas.fill(corners, {0, static_cast<float>(shade), static_cast<float>(normal.dot(camera.up)),
                          static_cast<std::int32_t>(t)});
  }

  const auto step = static_cast<float>(kSamples / scale);
  for (const auto& [from, to] : paint.lines) canvas.line(in_samples(from), in_samples(to), 2 * step);
  constexpr Rgb kGrey{186 / 255.0, 196 / 255.0, 204 / 255.0}, kPaper{1, 1, 1};
  const auto colour_of = [&](const PixelSample& sample) {
    if (std::isinf(sample.depth)) return kPaper;
    if (sample.triangle == kOfLine) return paint.line;
    return paint.triangles.empty() ? kGrey : paint.triangles[static_cast<std::size_t>(sample.triangle)];
  };
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      double colour[3] = {0, 0, 0};
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int sx = kSamples * x + k % kSamples, sy = kSamples * y + k / kSamples;
        const PixelSample& sample = canvas.at(sx, sy);
        const double ink = 1.0 - line_at(canvas, sx, sy, step);
        const double light_there = std::isinf(sample.depth) ? 1 : sample.brightness;
        const Rgb of_sample = colour_of(sample);
        for (std::size_t c = 0; c < 3; ++c) colour[c] += ink * of_sample[c] * light_there;
      }
      for (double c : colour)
        picture.rgb.push_back(
            static_cast<std::uint8_t>(std::lround(std::clamp(255 * c / (kSamples * kSamples), 0.0, 255.0))));
    }
  }
  return picture;
}

namespace {

// Sides of filled samples towards empty ones, each from its start corner in one of four directions with the filled
// sample at its left: bit d of a corner is a side in direction d.
class OutlineSides {
 public:
  OutlineSides(const Canvas& canvas, int width, int height)
      : columns_(width + 1), sides_(static_cast<std::size_t>(width + 1) * (height + 1)) {
    const auto filled = [&](int x, int y) {
      return x >= 0 && y >= 0 && x < width && y < height && !std::isinf(canvas.at(x, y).depth);
    };
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        if (!filled(x, y)) continue;
        if (!filled(x, y - 1)) at(x, y) |= 1;
        if (!filled(x + 1, y)) at(x + 1, y) |= 2;
        if (!filled(x, y + 1)) at(x + 1, y + 1) |= 4;
        if (!filled(x - 1, y)) at(x, y + 1) |= 8;
      }
    }
  }

  std::size_t corners() const { return sides_.size(); }
  bool has_side(std::size_t corner) const { return sides_[corner] != 0; }

  // Middles of the sides of one closed line from this corner on, which are removed.
  std::vector<std::array<double, 2>> take_line(std::size_t corner) {
    constexpr std::array<std::array<int, 2>, 4> kStep{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    std::vector<std::array<double, 2>> line;
    int x = static_cast<int>(corner % static_cast<std::size_t>(columns_)),
        y = static_cast<int>(corner / static_cast<std::size_t>(columns_)), direction = 0;
    while (at(x, y) != 0) {
      // Where two lines touch, the one that turns left.
      for (const int turn : {1, 0, 3, 2}) {
        const int next = (direction + turn) % 4;
        if (!(at(x, y) >> next & 1)) continue;
        direction = next;
        break;
      }
      at(x, y) = static_cast<std::uint8_t>(at(x, y) & ~(1 << direction));
      const auto& [dx, dy] = kStep[static_cast<std::size_t>(direction)];
      line.push_back({x + 0.5 * dx, y + 0.5 * dy});
      x += dx;
      y += dy;
    }
    return line;
  }

 private:
  std::uint8_t& at(int x, int y) { return sides_[static_cast<std::size_t>(y) * columns_ + x]; }

  int columns_;
  std::vector<std::uint8_t> sides_;
};

}  // namespace

std::vector<std::array<double, 2>> outline_of(const TriangleMesh& mesh, const Vec3& right, const Vec3& up,
                                              double sample_m) {
  constexpr double kLeastArea = 20;
  Vec2 low = Vec2::Constant(1e300), high = Vec2::Constant(-1e300);
  const auto projected = [&](std::uint32_t v) { return Vec2(right.dot(mesh.vertices[v]), up.dot(mesh.vertices[v])); };
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t v : triangle) {
      low = low.cwiseMin(projected(v));
      high = high.cwiseMax(projected(v));
    }
  }
  if (mesh.triangles.empty()) return {};
  const double scale = 1 / sample_m;
  const auto samples = [&](double length) { return static_cast<int>(std::ceil(length * scale)) + 2; };
  const int width = samples(high.x() - low.x()), height = samples(high.y() - low.y());
  Canvas canvas(width, height);
  for (const auto& triangle : mesh.triangles) {
    std::array<Vec3, 3> corners;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec2 p = scale * (projected(triangle[i]) - low);
      corners[i] = {p.x() + 1, p.y() + 1, 0};
    }
    canvas.fill(corners, {});
  }
  OutlineSides sides(canvas, width, height);
  std::vector<std::array<double, 2>> outline;
  for (std::size_t corner = 0; corner < sides.corners(); ++corner) {
    while (sides.has_side(corner)) {
      std::vector<std::array<double, 2>> line = sides.take_line(corner);
      double area = 0;
      for (std::size_t i = 0; i < line.size(); ++i) {
        const auto &a = line[i], &b = line[(i + 1) % line.size()];
        area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
      }
      if (std::abs(area) < kLeastArea) continue;
      line.push_back(line.front());
      for (const auto& [x, y] : line) outline.push_back({low.x() + (x - 1) / scale, low.y() + (y - 1) / scale});
      outline.push_back({std::nan(""), std::nan("")});
    }
  }
  return outline;
}

std::string png_bytes(const Picture& picture) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(picture.width);
  image.height = static_cast<png_uint_32>(picture.height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.rgb.data(), 0, nullptr) == 0) {
    throw WorkError(fmt::format("cannot encode a PNG: {}", image.message));
  }
  bytes.resize(size);
  return bytes;
}

namespace {

constexpr Rgb kBelowScale{0.80, 0.81, 0.83}, kLine{0, 0.447, 0.698};
constexpr double kSmallestBall = 4, kLargestBall = 20;  // diameters, pixels
constexpr double kColourSteps = 60;                     // of the scale

std::string hex(const Rgb& colour) {
  std::string text = "#";
  for (const double c : colour) text += fmt::format("{:02x}", std::lround(255 * c));
  return text;
}

Rgb colour_at(double level, const AxisRange& range) {
  return level < range.first ? kBelowScale : viridis((level - range.first) / (range.second - range.first));
}

// A length of 1, 2 or 5 times a power of ten, at most `most`.
double round_length(double most) {
  const double power = std::pow(10, std::floor(std::log10(most)));
  return power * (most >= 5 * power ? 5 : most >= 2 * power ? 2 : 1);
}

// Commands of a figure whose coordinates are pixels from its lower left corner.
struct PixelFigure {
  std::string commands;

  void label(double x, double y, const std::string& text, const char* more) {
    commands += fmt::format("set label {} at {:.1f},{:.1f} {}\n", gnuplot_text(text), x, y, more);
  }
  void line(double x0, double y0, double x1, double y1, const char* more) {
    commands += fmt::format("set arrow from {:.1f},{:.1f} to {:.1f},{:.1f} {}\n", x0, y0, x1, y1, more);
  }
  void rectangle(double x0, double y0, double x1, double y1, const std::string& style) {
    commands += fmt::format("set object rectangle from {:.2f},{:.2f} to {:.2f},{:.2f} {}\n", x0, y0, x1, y1, style);
  }
  void ball(double x, double y, double diameter, bool white) {
    commands += fmt::format(
        "set object circle at {:.1f},{:.1f} size {:.2f} front noclip fs solid border lc rgb '#202020' fc rgb '{}' lw "
        "0.6\n",
        x, y, diameter / 2, white ? "#ffffff" : kMarks);
  }
};

double ball_diameter(double level, const AxisRange& range) {
  const double share = std::clamp((level - range.first) / (range.second - range.first), 0.0, 1.0);
  return kSmallestBall + share * (kLargestBall - kSmallestBall);
}

// The scale of colours, from the level `range.first` at y0 to `range.second` at y1.
void add_scale(PixelFigure& out, const FigureAxis& colour, double x, double y0, double y1) {
  const AxisRange range = *colour.range;
  const auto y = [&](double level) { return y0 + (level - range.first) / (range.second - range.first) * (y1 - y0); };
  for (double i = 0; i < kColourSteps; ++i)  // each up to the top, so that no seam remains
    out.rectangle(x, y0 + i / kColourSteps * (y1 - y0), x + 16, y1,
                  fmt::format("fs solid noborder fc rgb '{}'", hex(viridis((i + 0.5) / kColourSteps))));
  out.rectangle(x, y0, x + 16, y1, "fs empty border lc rgb '#404040' lw 0.6");
  const double step = round_length((range.second - range.first) / 4);
  for (double level = std::ceil(range.first / step) * step; level <= range.second + 1e-9; level += step) {
    out.line(x + 16, y(level), x + 20, y(level), "nohead lw 0.6");
    out.label(x + 24, y(level), fmt::format("{:g}", level), "left font small");
  }
  out.label(x + 62, 0.5 * (y0 + y1), colour.label, "center rotate font small");
}

// At most `most` bytes of a text in UTF-8, whole characters.
std::string shortened(const std::string& text, std::size_t most) {
  if (text.size() <= most) return text;
  std::size_t end = most - 3;
  while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xc0u) == 0x80u) --end;
  return text.substr(0, end) + "...";
}

using PlacedName = std::pair<std::array<double, 2>, std::vector<std::string>>;

// Names above the mesh, each as near above its point as the others leave.
void add_names(PixelFigure& out, std::vector<PlacedName> names, double width, double top) {
  constexpr double kLineHeight = 15, kCharacter = 6.8, kGap = 16;
  constexpr std::size_t kMostCharacters = 28;
  std::ranges::stable_sort(names, {}, [](const PlacedName& name) { return name.first[0]; });
  std::size_t longest = 0;
  std::vector<double> columns;
  for (auto& [place, lines] : names) {
    columns.push_back(place[0]);
    for (std::string& line : lines) {
      line = shortened(line, kMostCharacters);
      longest = std::max(longest, line.size());
    }
  }
  const double distance = kGap + kCharacter * static_cast<double>(longest);
  columns = apart(std::move(columns), distance, {distance / 2, width - distance / 2});
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto& [place, lines] = names[i];
    for (std::size_t l = 0; l < lines.size(); ++l)
      out.label(columns[i], top - kLineHeight * static_cast<double>(l), lines[l], "center font small");
    out.line(columns[i], top - kLineHeight * (static_cast<double>(lines.size()) - 0.4), place[0], place[1],
             "nohead front lc rgb '#202020' lw 0.7");
  }
}

// The directions of the mesh's axes, as they are seen.
void add_axes(PixelFigure& out, const Picture& picture, double x, double y) {
  constexpr double kLength = 30;
  constexpr const char* kNames[] = {"x", "y", "z"};
  for (int i = 0; i < 3; ++i) {
    const double dx = kLength * picture.axes(0, i), dy = kLength * picture.axes(1, i);
    out.line(x, y, x + dx, y + dy, "head size 6,20 lc rgb '#404040' lw 1");
    const double length = std::hypot(dx, dy), beyond = 9;
    if (length > 3)
      out.label(x + dx * (1 + beyond / length), y + dy * (1 + beyond / length), kNames[i],
                "center font small tc rgb '#404040'");
  }
}

struct DrawnFigure {
  FigureSize size;
  std::string data, commands;
};

DrawnFigure drawn(const MeshFigure& figure) {
  constexpr int kWidth = 1100, kLeft = 30, kRight = 110, kMostHeight = 620;
  const AxisRange scale = *figure.colour.range;
  std::vector<Rgb> colours;
  for (const double level : figure.levels) colours.push_back(colour_at(level, scale));
  const int across = kWidth - kLeft - kRight;
  PictureView view{figure.azimuth_deg, figure.elevation_deg, across, 0};
  const PicturePaint paint{colours, figure.lines, kLine};
  Picture picture = picture_of(figure.mesh, view, paint);
  if (picture.height > kMostHeight) {
    view.height = kMostHeight;
    picture = picture_of(figure.mesh, view, paint);
  }
  std::size_t lines = 0;
  for (const MeshFigure::Name& name : figure.names) lines = std::max(lines, name.lines.size());
  const double notes = 16 * static_cast<double>(figure.notes.size()), below = 96 + notes;
  const double above = 40 + (lines > 0 ? 50 + 15 * static_cast<double>(lines) : 0);
  const double height = below + picture.height + above;
  const auto place = [&](const Vec3& p) {
    const auto [x, y] = picture.place(p);
    return std::array{kLeft + x, below + picture.height - y};
  };

  PixelFigure out;
  out.commands = fmt::format(
      "set lmargin at screen 0\nset rmargin at screen 1\nset bmargin at screen 0\nset tmargin at screen 1\nunset "
      "border\nunset tics\nunset key\nset xrange [0:{}]\nset yrange [0:{:.0f}]\n",
      kWidth, height);
  out.label(0.5 * kWidth, height - 18, figure.title, "center");
  add_scale(out, figure.colour, kWidth - kRight + 14, below + 6, below + picture.height - 6.0);
  std::vector<MeshFigure::Ball> balls = figure.balls;
  std::ranges::stable_sort(balls, std::ranges::greater{}, &MeshFigure::Ball::level);  // small ones in front
  for (const MeshFigure::Ball& ball : balls) {
    const auto [x, y] = place(ball.at);
    out.ball(x, y, ball_diameter(ball.level, figure.ball_range), ball.white);
  }
  std::vector<PlacedName> names;
  for (const MeshFigure::Name& name : figure.names) names.emplace_back(place(name.at), name.lines);
  add_names(out, std::move(names), kWidth, height - 46);

  // Below: the axes, a length, the key of balls and line, the small print.
  const double y = notes + 46;
  add_axes(out, picture, 60, y - 4);
  const double length_m = round_length(160 / picture.pixels_per_m), length = length_m * picture.pixels_per_m;
  for (const auto& [x0, y0, x1, y1] : {std::array{130.0, y, 130 + length, y}, std::array{130.0, y - 4, 130.0, y + 4},
                                       std::array{130 + length, y - 4, 130 + length, y + 4}})
    out.line(x0, y0, x1, y1, "nohead lw 1");
  out.label(130 + length / 2, y + 14, fmt::format("{:g} m", length_m), "center font small");
  double x = 330;
  for (const std::size_t kind : {0u, 1u}) {
    if (std::ranges::none_of(balls, [&](const MeshFigure::Ball& ball) { return ball.white == (kind == 1); })) continue;
    out.ball(x, y, 12, kind == 1);
    out.label(x + 12, y, figure.ball_names[kind], "left font small");
    x += 34 + 6.8 * static_cast<double>(figure.ball_names[kind].size());
  }
  if (!balls.empty()) {
    for (const double share : {1.0, 0.5, 0.0}) {
      const auto [low, high] = figure.ball_range;
      const double level = low + share * (high - low);
      out.ball(x, y, ball_diameter(level, figure.ball_range), false);
      out.label(x + 14, y, fmt::format("{:.1f} {}", level, share > 0 ? "" : figure.ball_unit), "left font small");
      x += 70;
    }
    x += 50;
  }
  if (!figure.lines.empty()) {
    out.line(x, y, x + 24, y, fmt::format("nohead lc rgb '{}' lw 2", hex(kLine)).c_str());
    out.label(x + 32, y, figure.line_name, "left font small");
  }
  for (std::size_t i = 0; i < figure.notes.size(); ++i)
    out.label(kLeft, notes - 6 - 16 * static_cast<double>(i), figure.notes[i], "left font small tc rgb '#404040'");
  out.commands += fmt::format(
      "plot {} binary array=({},{}) flipy origin=({}.5,{:.1f}) format='%uchar%uchar%uchar' using 1:2:3 with rgbimage\n",
      kGnuplotData, picture.width, picture.height, kLeft, below + 0.5);
  return {{kWidth, static_cast<int>(std::lround(height))},
          std::string(picture.rgb.begin(), picture.rgb.end()),
          std::move(out.commands)};
}

}  // namespace

void write_figure(const MeshFigure& figure, const std::filesystem::path& file) {
  const DrawnFigure made = drawn(figure);
  draw_by_gnuplot(file, made.size, made.data, made.commands);
}

std::string png_of(const MeshFigure& figure) {
  const DrawnFigure made = drawn(figure);
  return figure_bytes("figure.png", made.size, made.data, made.commands);
}

}  // namespace seaglint
