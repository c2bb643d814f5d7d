// Draws points as disks by OpenGL, antialiased where the framebuffer is multisampled.
#pragma once

#include "viewer/render/resident_cache.h"
#include "viewer/render/scene.h"
#include "viewer/render/view.h"

namespace patchlab::viewer {

class PointPass {
 public:
  static Result<PointPass> create();

  // Grows `box` by the items; what they need is on the GPU then.
  void prepare(const std::vector<PointsItem>& items, Box& box);
  void draw(const std::vector<PointsItem>& items, const View& view, const PointFade& fade);

 private:
  struct Positions {
    GlBuffer buffer;
    Box box;
  };
  explicit PointPass(Program program) : program_(std::move(program)) {}
  static Positions upload(const std::vector<Eigen::Vector3f>& positions);
  const Positions& resident(const PointsItem& item);
  void bind(const PointsItem& item);

  Program program_;
  GlVertexArray arrays_;
  ResidentCache<Positions> positions_;
  ResidentCache<GlBuffer> colours_;
};

}  // namespace patchlab::viewer
