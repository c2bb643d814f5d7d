// Draws lines of a width in pixels, antialiased, with round joints and ends.
//
//   load, draw_veiled, then the depth of the translucent meshes is laid down, draw_unveiled
//
// so that lines are dimmed where they are seen through a translucent mesh, and whole elsewhere.
#pragma once

#include "viewer/render/scene.h"
#include "viewer/render/view.h"

namespace patchlab::viewer {

class LinePass {
 public:
  static Result<LinePass> create();

  static void grow(Box& box, const std::vector<LineItem>& items);
  void load(const std::vector<LineItem>& items);
  void draw_veiled(const View& view) const;    // all but those on top, dimmed
  void draw_unveiled(const View& view) const;  // what nothing hides; then those on top

 private:
  struct Vertex {
    Eigen::Vector3f position;
    Rgba8 colour;  // of the segment that starts here
    float width;   // px; 0: no segment starts here
  };
  struct Range {
    std::size_t begin, end;  // of vertices
  };
  explicit LinePass(Program program) : program_(std::move(program)) {}
  static void append(std::vector<Vertex>& strip, const LineItem& item, float alpha);
  void use(const View& view, float opacity, float already) const;
  void draw_range(const Range& range, GLenum depth_test) const;

  Program program_;
  GlVertexArray arrays_;
  GlBuffer buffer_;
  Range in_depth_{}, hidden_{}, on_top_{};
};

}  // namespace patchlab::viewer
