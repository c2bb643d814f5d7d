#include "viewer/render/splat.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <span>

#include "engine/base/parallel.h"
#include "viewer/render/disk_stamp.h"

namespace patchlab::viewer {
namespace {

constexpr std::size_t points_a_chunk = 16384, points_a_batch = 16 * points_a_chunk;

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

// Four pixels at once; GCC and Clang make each operation an instruction or two of any processor.
using Words = std::uint32_t __attribute__((vector_size(16)));
using Bytes = std::uint8_t __attribute__((vector_size(16)));
using Shorts = std::uint16_t __attribute__((vector_size(32)));

template <class Vector, class T>
Vector load(const T* from) {
  Vector vector;
  std::memcpy(&vector, from, sizeof vector);
  return vector;
}
template <class Vector, class T>
void store(const Vector& vector, T* to) {
  std::memcpy(to, &vector, sizeof vector);
}

// The same depth and colour four times.
struct Front {
  explicit Front(const Raster::Splat& splat)
      : depth(Words{} + splat.depth),
        colour(__builtin_convertvector(Bytes(Words{} + std::bit_cast<std::uint32_t>(splat.colour)), Shorts)) {
  }
  Words depth;
  Shorts colour;
};

// A disk's share of four pixels: those behind it take its colour as far as it covers them, and its depth
// where that is half of them or more.
void lay(const StampRun& run, const Front& front, std::uint32_t* depths, Rgba8* colours) {
  const auto behind = load<Words>(depths);
  const Words covered = load<Words>(run.coverage.data()) & Words(front.depth <= behind);
  store((covered & 0x80u) != 0u ? front.depth : behind, depths);
  const Shorts share = __builtin_convertvector(Bytes(covered), Shorts);
  const Shorts colour = __builtin_convertvector(load<Bytes>(colours), Shorts);
  const Shorts sum = colour * (255 - share) + front.colour * share + 128;
  store(__builtin_convertvector((sum + (sum >> 8)) >> 8, Bytes), colours);
}

// Bands of rows, so small that the pixels of one stay near the processor, and no disk reaches over more than
// two.
class Bands {
 public:
  Bands(int rows, int reach)
      : rows_(rows), reach_(reach), shift_(std::bit_width(static_cast<unsigned>(std::max(31, 2 * reach)))) {}

  std::size_t count() const { return static_cast<std::size_t>(((rows_ - 1) >> shift_) + 1); }
  int first_row(std::size_t band) const { return static_cast<int>(band) << shift_; }
  int last_row(std::size_t band) const { return std::min(first_row(band + 1), rows_); }

  // Calls `use(band)` for each that the disk reaches.
  template <class Use>
  void reached(const Raster::Splat& splat, const Use& use) const {
    const int y = splat.y_parts >> 3, first = std::max(y - reach_, 0), last = std::min(y + reach_, rows_ - 1);
    if (first > last) return;
    const int one = first >> shift_, other = last >> shift_;
    use(static_cast<std::size_t>(one));
    if (other != one) use(static_cast<std::size_t>(other));
  }

 private:
  int rows_, reach_;
  int shift_;  // 2^shift_ rows a band
};

// Splats by the band that they reach, in their order. `starts`: count() + 1 places in `sorted`.
void sort_by_band(std::span<const Raster::Splat> splats, const Bands& bands, std::span<std::uint32_t> starts,
                  std::span<Raster::Splat> sorted) {
  std::ranges::fill(starts, 0u);
  for (const Raster::Splat& splat : splats)
    bands.reached(splat, [&](std::size_t band) { ++starts[band + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<std::uint32_t> next(starts.begin(), starts.end());
  for (const Raster::Splat& splat : splats)
    bands.reached(splat, [&](std::size_t band) { sorted[next[band]++] = splat; });
}

// Lays disks on the rows of a band.
class Band {
 public:
  Band(Raster& raster, const DiskStamp& stamp, int first_row, int last_row)
      : raster_(raster), stamp_(stamp), first_(first_row), last_(last_row) {}

  void draw(std::span<const Raster::Splat> splats) {
    const int reach = stamp_.reach();
    for (const Raster::Splat& splat : splats) {
      const int x = splat.x_parts >> 3, y = splat.y_parts >> 3;
      const bool within_rows = x - reach >= 0 && x + reach + StampRun::kPixels <= raster_.width;
      const Front front(splat);
      for (const StampRun& run : stamp_.runs(splat.x_parts & 7, splat.y_parts & 7)) {
        const int run_x = x + run.dx, run_y = y + run.dy;
        if (run_y < first_ || run_y >= last_) continue;
        if (within_rows)
          lay(run, front, depths(run_x, run_y), colours(run_x, run_y));
        else
          lay_part(run, front, run_x, run_y);
      }
    }
  }

 private:
  // By way of a run of its own.
  void lay_part(const StampRun& run, const Front& front, int x, int y) {
    const int first = std::clamp(x, 0, raster_.width),
              end = std::clamp(x + StampRun::kPixels, 0, raster_.width);
    std::array<std::uint32_t, StampRun::kPixels> some_depths{};
    std::array<Rgba8, StampRun::kPixels> some_colours{};
    std::copy(depths(first, y), depths(end, y), some_depths.data() + (first - x));
    std::copy(colours(first, y), colours(end, y), some_colours.data() + (first - x));
    lay(run, front, some_depths.data(), some_colours.data());
    std::copy_n(some_depths.data() + (first - x), end - first, depths(first, y));
    std::copy_n(some_colours.data() + (first - x), end - first, colours(first, y));
  }

  std::uint32_t* depths(int x, int y) { return raster_.depths.data() + at(x, y); }
  Rgba8* colours(int x, int y) { return raster_.colours.data() + at(x, y); }
  std::ptrdiff_t at(int x, int y) const { return static_cast<std::ptrdiff_t>(y) * raster_.width + x; }

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
  const DiskStamp stamp(std::max(item.size, 1.0f));
  const Bands bands(raster.height, stamp.reach());
  raster.splats.resize(points_a_batch);
  raster.by_band.resize(2 * points_a_batch);
  const std::size_t starts_a_chunk = bands.count() + 1;
  std::vector<std::uint32_t> starts(points_a_batch / points_a_chunk * starts_a_chunk);
  for (std::size_t first = 0; first < projection.count(); first += points_a_batch) {
    const std::size_t count = std::min(projection.count() - first, points_a_batch);
    for_each_chunk(count, points_a_chunk, [&](const Chunk& chunk) {
      Raster::Splat* const seen = raster.splats.data() + chunk.first;
      Raster::Splat* const end = projection(first + chunk.first, first + chunk.last, seen);
      sort_by_band({seen, end}, bands,
                   std::span(starts).subspan(chunk.number * starts_a_chunk, starts_a_chunk),
                   std::span(raster.by_band).subspan(2 * chunk.first));
    });
    for_each_chunk(bands.count(), 1, [&](const Chunk& one) {
      Band band(raster, stamp, bands.first_row(one.number), bands.last_row(one.number));
      for (std::size_t chunk = 0; chunk < chunk_count(count, points_a_chunk); ++chunk) {
        const std::uint32_t* const start = starts.data() + chunk * starts_a_chunk + one.number;
        band.draw(
            std::span(raster.by_band).subspan(2 * chunk * points_a_chunk + start[0], start[1] - start[0]));
      }
    });
  }
}

}  // namespace patchlab::viewer
