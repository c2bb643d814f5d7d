#include "viewer/panel/layout.h"

#include <algorithm>
#include <cmath>

namespace patchlab::viewer {

Layout make_layout(float width, float height, float scale) {
  const float menu = std::round(32 * scale), tools = std::round(44 * scale), status = std::round(30 * scale);
  const float top = menu + tools;
  const float middle = std::max(0.0f, height - top - status);
  const float tree = std::round(std::min(250 * scale, width * 0.25f));
  const float inspector = std::round(std::min(364 * scale, width * 0.40f));
  Layout layout;
  layout.menu = {0, 0, width, menu};
  layout.tools = {0, menu, width, tools};
  layout.tree = {0, top, tree, middle};
  layout.inspector = {width - inspector, top, inspector, middle};
  layout.status = {0, top + middle, width, status};
  layout.view = {tree, top, width - tree - inspector, middle};
  return layout;
}

}  // namespace patchlab::viewer
