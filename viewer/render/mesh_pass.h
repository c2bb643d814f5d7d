// Draws triangle meshes: the opaque ones, then the translucent ones from the back to the front.
#pragma once

#include "viewer/render/resident_cache.h"
#include "viewer/render/scene.h"
#include "viewer/render/view.h"

namespace patchlab::viewer {

class MeshPass {
 public:
  static Result<MeshPass> create();

  // Grows `box` by the items; what they need is on the GPU then.
  void prepare(const std::vector<MeshItem>& items, Box& box);
  void draw(const std::vector<MeshItem>& items, const View& view);
  void draw_depth_of_translucent(const std::vector<MeshItem>& items, const View& view);

 private:
  struct Vertices {
    GlBuffer buffer;
    Box box;
    bool translucent = false;
  };
  explicit MeshPass(Program program) : program_(std::move(program)) {}
  static bool complete(const MeshItem& item);
  static Vertices upload(const std::vector<MeshVertex>& vertices);
  const Vertices& resident(const MeshItem& item);
  std::vector<const MeshItem*> back_to_front(const std::vector<MeshItem>& items, const View& view,
                                             bool translucent);
  void use(const View& view) const;
  void draw_one(const MeshItem& item);

  Program program_;
  GlVertexArray arrays_;
  ResidentCache<Vertices> vertices_;
  ResidentCache<GlBuffer> triangles_;
};

}  // namespace patchlab::viewer
