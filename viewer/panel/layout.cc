#include "viewer/panel/layout.h"

#include <algorithm>
#include <cmath>

namespace patchlab::viewer {

Layout make_layout(float width, float height, float scale, const Shell& shell) {
  const auto bar = [&](float unscaled) { return shell.bars ? std::round(unscaled * scale) : 0.0f; };
  const auto side = [&](float unscaled, float part) {
    return shell.side_panels ? std::round(std::min(unscaled * scale, width * part)) : 0.0f;
  };
  const float menu = bar(32), tools = bar(44), status = bar(30);
  const float top = menu + tools;
  const float middle = std::max(0.0f, height - top - status);
  const float tree = side(shell.tree, 0.25f), inspector = side(shell.inspector, 0.40f);
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
