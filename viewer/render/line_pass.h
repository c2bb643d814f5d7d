// Draws lines of a width in pixels, antialiased, with round joints and ends.
#pragma once

#include "viewer/render/scene.h"
#include "viewer/render/view.h"

namespace patchlab::viewer {

class LinePass {
 public:
  static Result<LinePass> create();

  static void grow(Box& box, const std::vector<LineItem>& items);
  void draw(const std::vector<LineItem>& items, const View& view);

 private:
  explicit LinePass(Program program) : program_(std::move(program)) {}
  struct Vertex {
    Eigen::Vector3f position;
    Rgba8 colour;  // of the segment that starts here
    float width;   // px; 0: no segment starts here
  };
  static void append(std::vector<Vertex>& strip, const LineItem& item, float alpha);
  void draw_strip(const std::vector<Vertex>& strip, GLenum depth_test);

  Program program_;
  GlVertexArray arrays_;
  GlBuffer buffer_;
};

}  // namespace patchlab::viewer
