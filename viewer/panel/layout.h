// The fixed shell: where each panel lies. Framebuffer pixels, y down from the upper left corner.
#pragma once

namespace patchlab::viewer {

struct Rect {
  float x = 0, y = 0, width = 0, height = 0;
  float right() const { return x + width; }
  float bottom() const { return y + height; }
  bool contains(float px, float py) const { return px >= x && py >= y && px < right() && py < bottom(); }
};

struct Layout {
  Rect menu, tools, tree, inspector, status, view;
};

// What is shown around the view, and how wide (px at scale 1).
struct Shell {
  float tree = 250.0f, inspector = 364.0f;
  bool side_panels = true;
  bool bars = true;
};
// The side panels give way where the window is small: the view keeps at least a third of it.
Layout make_layout(float width, float height, float scale, const Shell& shell = {});

}  // namespace patchlab::viewer
