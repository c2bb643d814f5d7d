// Draws the background and the points of a scene by the processor, into a framebuffer of RGBA8 and 24 bits of
// depth. What has not changed since it was last drawn is only copied.
#pragma once

#include <optional>
#include <vector>

#include "viewer/render/resident_cache.h"
#include "viewer/render/splat.h"

namespace patchlab::viewer {

class SplatPass {
 public:
  void prepare(const std::vector<PointsItem>& items, Box& box);  // grows `box` by the items
  // Replaces all that is in the viewport, depth included.
  void draw(const Scene& scene, const View& view, const PointFade& fade);

 private:
  // All that the raster is made of.
  struct Made {
    std::vector<PointsItem> items;
    Eigen::Matrix4f clip_from_view, view_from_local;
    PointFade fade;
    Rgba top, bottom;
    int width, height;
    bool operator==(const Made&) const = default;
  };
  void make(const Scene& scene, const View& view, const PointFade& fade);
  // With the framebuffer bound for reading.
  void resize(int width, int height);
  void upload();

  ResidentCache<Box> boxes_;
  Raster raster_;
  std::optional<Made> made_;
  int width_ = 0, height_ = 0;  // px, of the textures
  GlObject<TextureKind> colours_, depths_;
  GlObject<FramebufferKind> framebuffer_;
};

}  // namespace patchlab::viewer
