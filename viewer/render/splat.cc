#include "viewer/render/splat.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace patchlab::viewer {
namespace {

std::uint8_t to_byte(float value) { return static_cast<std::uint8_t>(value + 0.5f); }

// A colour of three channels, 0..255.
using Shade = Eigen::Vector3f;

Shade shade_of(const Rgba8& colour) { return {float(colour[0]), float(colour[1]), float(colour[2])}; }
Rgba8 to_rgba8(const Shade& shade) {
  return {to_byte(shade.x()), to_byte(shade.y()), to_byte(shade.z()), 255};
}

struct Disk {
  float x, y;  // px
  std::uint32_t depth;
  Shade shade;
};

// The 24 bits of a depth buffer, ndc in [-1, 1].
std::uint32_t to_depth(float ndc) { return static_cast<std::uint32_t>(8388607.5f * (ndc + 1.0f)) << 8; }

class Splatter {
 public:
  Splatter(Canvas& canvas, float size) : canvas_(canvas), radius_(0.5f * std::max(size, 1.0f)) {}

  void draw(const Disk& disk) {
    const float reach = radius_ + 0.5f;
    const int x0 = std::max(static_cast<int>(std::ceil(disk.x - 0.5f - reach)), 0);
    const int x1 = std::min(static_cast<int>(std::floor(disk.x - 0.5f + reach)), canvas_.width - 1);
    const int y0 = std::max(static_cast<int>(std::ceil(disk.y - 0.5f - reach)), 0);
    const int y1 = std::min(static_cast<int>(std::floor(disk.y - 0.5f + reach)), canvas_.height - 1);
    const Rgba8 solid = to_rgba8(disk.shade);
    for (int y = y0; y <= y1; ++y)
      for (int x = x0; x <= x1; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas_.width) +
                              static_cast<std::size_t>(x);
        if (disk.depth > canvas_.depths[i]) continue;
        put(i, disk, solid,
            coverage(static_cast<float>(x) + 0.5f - disk.x, static_cast<float>(y) + 0.5f - disk.y));
      }
  }

 private:
  float coverage(float dx, float dy) const {
    const float squared = dx * dx + dy * dy, inner = radius_ - 0.5f;
    if (squared <= inner * inner) return 1.0f;
    return radius_ + 0.5f - std::sqrt(squared);
  }

  void put(std::size_t i, const Disk& disk, const Rgba8& solid, float coverage) {
    if (coverage <= 0.0f) return;
    if (coverage >= 0.5f) canvas_.depths[i] = disk.depth;
    if (coverage >= 1.0f) {
      canvas_.colours[i] = solid;
    } else {
      const Shade behind = shade_of(canvas_.colours[i]);
      canvas_.colours[i] = to_rgba8(behind + coverage * (disk.shade - behind));
    }
  }

  Canvas& canvas_;
  float radius_;  // px
};

}  // namespace

void Canvas::clear(int w, int h, const Rgba& bottom, const Rgba& top) {
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

void splat(Canvas& canvas, const PointsItem& item, const View& view, const PointFade& fade) {
  const Eigen::Matrix4f clip_from_local = view.clip_from_view * view.view_from_local;
  const Eigen::RowVector4f depth_row = -view.view_from_local.row(2);
  const Eigen::Vector2f one_further = -view.clip_from_view.block<2, 1>(2, 2);  // of clip z and w, a metre
  const float half_width = 0.5f * static_cast<float>(canvas.width),
              half_height = 0.5f * static_cast<float>(canvas.height);
  const Shade background = 255.0f * fade.background;
  Splatter splatter(canvas, item.size);
  for (std::size_t i = 0; i < item.positions->size(); i += item.step) {
    const Eigen::Vector4f local = (*item.positions)[i].homogeneous();
    const Eigen::Vector4f clip = clip_from_local * local;
    const float w = clip.w();
    // Written so that NaN fails it.
    if (!(w > 0.0f && std::abs(clip.z()) <= w && std::abs(clip.x()) <= 1.1f * w &&
          std::abs(clip.y()) <= 1.1f * w))
      continue;
    const Rgba8& colour = (*item.colours)[i];
    if (colour[3] == 0) continue;
    const float far_part = std::clamp((depth_row.dot(local) - fade.nearest) / fade.depth, 0.0f, 1.0f);
    const float kept = static_cast<float>(colour[3]) / 255.0f * (1.0f - PointFade::kFarthest * far_part);
    const Eigen::Vector2f set_back = clip.tail<2>() + item.set_back * one_further;
    splatter.draw({half_width * (clip.x() / w + 1.0f), half_height * (clip.y() / w + 1.0f),
                   to_depth(std::min(set_back.x() / set_back.y(), 1.0f)),
                   background + kept * (shade_of(colour) - background)});
  }
}

}  // namespace patchlab::viewer
