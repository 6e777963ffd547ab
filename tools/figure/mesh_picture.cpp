// SPDX-License-Identifier: BSD-3-Clause
#include "tools/figure/mesh_picture.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

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
};

class Canvas {
 public:
  Canvas(int width, int height) : width_(width), height_(height), samples_(static_cast<std::size_t>(width) * height) {}

  // Rasterises a triangle with vertices in sample coordinates and depth; the nearest surface is kept.
  void fill(const std::array<Vec3, 3>& p, float brightness, float facing) {
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
        if (depth > sample.depth) sample = {depth, brightness, facing};
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

Picture picture_of(const TriangleMesh& mesh, const PictureView& view) {
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

  // Light source above and to the left of the viewer; sheets are shaded from both sides.
  const Vec3 light = (camera.eye + 0.55 * Vec3::UnitZ() - 0.6 * camera.right).normalized();
  Canvas canvas(kSamples * picture.width, kSamples * picture.height);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 area = area_vector(mesh, t);
    if (area.norm() == 0) continue;
    Vec3 normal = area.normalized();
    if (normal.dot(camera.eye) < 0) normal = -normal;
    const double shade = 0.30 + 0.70 * std::max(0.0, normal.dot(light));
    std::array<Vec3, 3> corners;
    for (int i = 0; i < 3; ++i) {
      const Vec3 p = in_camera_axes(mesh.vertices[mesh.triangles[t][i]]);
      corners[i] = {x0 + scale * p.x(), y0 - scale * p.y(), p.z()};
    }
    canvas.fill(corners, static_cast<float>(shade), static_cast<float>(normal.dot(camera.up)));
  }

  const auto step = static_cast<float>(kSamples / scale);
  constexpr double kPaint[3] = {186, 196, 204}, kPaper[3] = {255, 255, 255};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      double colour[3] = {0, 0, 0};
      for (int k = 0; k < kSamples * kSamples; ++k) {
        const int sx = kSamples * x + k % kSamples, sy = kSamples * y + k / kSamples;
        const PixelSample& sample = canvas.at(sx, sy);
        const double ink = 1.0 - line_at(canvas, sx, sy, step);
        for (int c = 0; c < 3; ++c)
          colour[c] += ink * (std::isinf(sample.depth) ? kPaper[c] : kPaint[c] * sample.brightness);
      }
      for (double c : colour)
        picture.rgb.push_back(
            static_cast<std::uint8_t>(std::lround(std::clamp(c / (kSamples * kSamples), 0.0, 255.0))));
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
    canvas.fill(corners, 0, 0);
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

}  // namespace seaglint
