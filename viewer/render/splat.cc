#include "viewer/render/splat.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "engine/base/parallel.h"
#include "viewer/render/disk_stamp.h"

namespace patchlab::viewer {
namespace {

constexpr std::size_t points_a_chunk = 16384;

std::uint8_t to_byte(float value) { return static_cast<std::uint8_t>(value + 0.5f); }

// A colour of three channels, 0..255.
using Shade = Eigen::Vector3f;

Shade shade_of(const Rgba8& colour) { return {float(colour[0]), float(colour[1]), float(colour[2])}; }
Rgba8 to_rgba8(const Shade& shade) {
  return {to_byte(shade.x()), to_byte(shade.y()), to_byte(shade.z()), 255};
}

// The 24 bits of a depth buffer, ndc in [-1, 1].
std::uint32_t to_depth(float ndc) { return static_cast<std::uint32_t>(8388607.5f * (ndc + 1.0f)) << 8; }

// Where the points of an item lie on a raster, and in which colour.
class Projection {
 public:
  Projection(const Raster& raster, const PointsItem& item, const View& view, const PointFade& fade)
      : item_(item),
        fade_(fade),
        clip_from_local_(view.clip_from_view * view.view_from_local),
        depth_row_(-view.view_from_local.row(2)),
        one_further_(-view.clip_from_view.block<2, 1>(2, 2)),
        background_(255.0f * fade.background),
        parts_x_(0.5f * DiskStamp::kParts * static_cast<float>(raster.width)),
        parts_y_(0.5f * DiskStamp::kParts * static_cast<float>(raster.height)) {}

  std::size_t count() const { return (item_.positions->size() + item_.step - 1) / item_.step; }

  // Of the drawn points number first to last; those that are seen, from `out` on. Returns their end.
  Raster::Splat* operator()(std::size_t first, std::size_t last, Raster::Splat* out) const {
    for (std::size_t i = first; i < last; ++i) out += project(i * item_.step, *out);
    return out;
  }

 private:
  bool project(std::size_t i, Raster::Splat& out) const {
    const Eigen::Vector4f local = (*item_.positions)[i].homogeneous();
    const Eigen::Vector4f clip = clip_from_local_ * local;
    const float w = clip.w();
    // Written so that NaN fails it.
    if (!(w > 0.0f && std::abs(clip.z()) <= w && std::abs(clip.x()) <= 1.1f * w &&
          std::abs(clip.y()) <= 1.1f * w))
      return false;
    const Rgba8& colour = (*item_.colours)[i];
    if (colour[3] == 0) return false;
    const float far_part = std::clamp((depth_row_.dot(local) - fade_.nearest) / fade_.depth, 0.0f, 1.0f);
    const float kept = static_cast<float>(colour[3]) / 255.0f * (1.0f - PointFade::kFarthest * far_part);
    const Eigen::Vector2f set_back = clip.tail<2>() + item_.set_back * one_further_;
    out = {static_cast<int>(std::floor(parts_x_ * (clip.x() / w + 1.0f))),
           static_cast<int>(std::floor(parts_y_ * (clip.y() / w + 1.0f))),
           to_depth(std::min(set_back.x() / set_back.y(), 1.0f)),
           to_rgba8(background_ + kept * (shade_of(colour) - background_))};
    return true;
  }

  const PointsItem& item_;
  const PointFade& fade_;
  Eigen::Matrix4f clip_from_local_;
  Eigen::RowVector4f depth_row_;
  Eigen::Vector2f one_further_;  // of clip z and w, a metre
  Shade background_;
  float parts_x_, parts_y_;  // half a raster, in parts of a pixel
};

// (1 - c) behind + c front, c in 255ths, two channels at a time.
std::uint32_t mixed(std::uint32_t behind, std::uint32_t front, std::uint32_t c) {
  constexpr std::uint32_t every_other = 0x00ff00ff, half = 0x00800080;
  const auto channels = [&](std::uint32_t b, std::uint32_t f) {
    const std::uint32_t sum = b * (255 - c) + f * c + half;
    return ((sum + ((sum >> 8) & every_other)) >> 8) & every_other;
  };
  return channels(behind & every_other, front & every_other) |
         channels((behind >> 8) & every_other, (front >> 8) & every_other) << 8;
}

// Lays disks on the rows [first, last) of a raster.
class Band {
 public:
  Band(Raster& raster, const DiskStamp& stamp, int first, int last)
      : raster_(raster), stamp_(stamp), first_(first), last_(last) {}

  void draw(std::span<const Raster::Splat> splats) {
    const int reach = stamp_.reach();
    for (const Raster::Splat& splat : splats) {
      const int x = splat.x_parts >> 3, y = splat.y_parts >> 3;
      if (y + reach < first_ || y - reach >= last_) continue;
      const bool is_whole =
          y - reach >= first_ && y + reach < last_ && x - reach >= 0 && x + reach < raster_.width;
      const auto pixels = stamp_.pixels(splat.x_parts & 7, splat.y_parts & 7);
      if (is_whole)
        for (const StampPixel& pixel : pixels) put(x + pixel.dx, y + pixel.dy, pixel.coverage, splat);
      else
        draw_part(splat, x, y, pixels);
    }
  }

 private:
  void draw_part(const Raster::Splat& splat, int x, int y, std::span<const StampPixel> pixels) {
    for (const StampPixel& pixel : pixels) {
      const int px = x + pixel.dx, py = y + pixel.dy;
      if (px >= 0 && px < raster_.width && py >= first_ && py < last_) put(px, py, pixel.coverage, splat);
    }
  }

  void put(int x, int y, std::uint8_t coverage, const Raster::Splat& splat) {
    const std::size_t i =
        static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.width) + static_cast<std::size_t>(x);
    if (splat.depth > raster_.depths[i]) return;
    if (coverage >= 128) raster_.depths[i] = splat.depth;
    raster_.colours[i] =
        coverage == 255 ? splat.colour
                        : std::bit_cast<Rgba8>(mixed(std::bit_cast<std::uint32_t>(raster_.colours[i]),
                                                     std::bit_cast<std::uint32_t>(splat.colour), coverage));
  }

  Raster& raster_;
  const DiskStamp& stamp_;
  int first_, last_;
};

}  // namespace

void Raster::clear(int w, int h, const Rgba& bottom, const Rgba& top) {
  width = w;
  height = h;
  const std::size_t row = static_cast<std::size_t>(w);
  colours.resize(row * static_cast<std::size_t>(h));
  depths.assign(colours.size(), std::numeric_limits<std::uint32_t>::max());
  for (int y = 0; y < h; ++y) {
    const float up = (static_cast<float>(y) + 0.5f) / static_cast<float>(h);
    Shade shade;
    for (std::size_t k = 0; k < 3; ++k)
      shade[static_cast<int>(k)] = 255.0f * (bottom[k] + up * (top[k] - bottom[k]));
    std::fill_n(colours.begin() + static_cast<std::ptrdiff_t>(row) * y, row, to_rgba8(shade));
  }
}

void splat(Raster& raster, const PointsItem& item, const View& view, const PointFade& fade) {
  const Projection projection(raster, item, view, fade);
  const std::size_t count = projection.count();
  raster.splats.resize(std::max(raster.splats.size(), count));
  std::vector<std::size_t> seen(chunk_count(count, points_a_chunk));
  for_each_chunk(count, points_a_chunk, [&](const Chunk& chunk) {
    Raster::Splat* const first = raster.splats.data() + chunk.first;
    seen[chunk.number] = static_cast<std::size_t>(projection(chunk.first, chunk.last, first) - first);
  });
  const DiskStamp stamp(std::max(item.size, 1.0f));
  const auto rows = static_cast<std::size_t>(raster.height);
  const std::size_t rows_a_band = std::max<std::size_t>(rows / (2 * thread_count()), 1);
  for_each_chunk(rows, rows_a_band, [&](const Chunk& of_rows) {
    Band band(raster, stamp, static_cast<int>(of_rows.first), static_cast<int>(of_rows.last));
    for (std::size_t k = 0; k < seen.size(); ++k)
      band.draw(std::span(raster.splats).subspan(k * points_a_chunk, seen[k]));
  });
}

}  // namespace patchlab::viewer
