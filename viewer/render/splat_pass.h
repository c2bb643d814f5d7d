// Draws the background and the points of a scene by the processor, into a framebuffer of RGBA8 and 24 bits of
// depth.
#pragma once

#include "viewer/render/resident_cache.h"
#include "viewer/render/splat.h"

namespace patchlab::viewer {

class SplatPass {
 public:
  void prepare(const std::vector<PointsItem>& items, Box& box);  // grows `box` by the items
  // Replaces all that is in the viewport, depth included.
  void draw(const Scene& scene, const View& view, const PointFade& fade);

 private:
  // With the framebuffer bound for reading.
  void resize(int width, int height);
  void upload();

  ResidentCache<Box> boxes_;
  Raster raster_;
  int width_ = 0, height_ = 0;  // px, of the textures
  GlObject<TextureKind> colours_, depths_;
  GlObject<FramebufferKind> framebuffer_;
};

}  // namespace patchlab::viewer
