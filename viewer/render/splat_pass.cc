#include "viewer/render/splat_pass.h"

#include <utility>

namespace patchlab::viewer {
namespace {

Box box_of(const std::vector<Eigen::Vector3f>& positions) {
  Box box;
  for (const Eigen::Vector3f& position : positions)
    if (position.allFinite()) box.extend(position);
  return box;
}

}  // namespace

void SplatPass::prepare(const std::vector<PointsItem>& items, Box& box) {
  for (const PointsItem& item : items)
    if (complete(item)) box.extend(boxes_.get(item.positions, box_of));
}

void SplatPass::resize(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  glBindTexture(GL_TEXTURE_2D, colours_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, colours_.name(), 0);
  glBindTexture(GL_TEXTURE_2D, depths_.name());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT24, width, height, 0, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
               nullptr);
  glFramebufferTexture2D(GL_READ_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, depths_.name(), 0);
}

void SplatPass::upload() {
  resize(raster_.width, raster_.height);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
  glBindTexture(GL_TEXTURE_2D, colours_.name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_RGBA, GL_UNSIGNED_BYTE, raster_.colours.data());
  glBindTexture(GL_TEXTURE_2D, depths_.name());
  glTexSubImage2D(GL_TEXTURE_2D, 0, 0, 0, width_, height_, GL_DEPTH_COMPONENT, GL_UNSIGNED_INT,
                  raster_.depths.data());
  glBindTexture(GL_TEXTURE_2D, 0);
}

void SplatPass::make(const Scene& scene, const View& view, const PointFade& fade) {
  Made wanted{scene.points,         view.clip_from_view,     view.view_from_local, fade,
              scene.background_top, scene.background_bottom, view.viewport.width,  view.viewport.height};
  if (made_ == wanted) return;
  raster_.clear(view.viewport.width, view.viewport.height, scene.background_bottom, scene.background_top);
  for (const PointsItem& item : scene.points)
    if (complete(item)) splat(raster_, item, view, fade);
  upload();
  made_ = std::move(wanted);
}

void SplatPass::draw(const Scene& scene, const View& view, const PointFade& fade) {
  GLint bound = 0;
  glGetIntegerv(GL_READ_FRAMEBUFFER_BINDING, &bound);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, framebuffer_.name());
  make(scene, view, fade);
  const Viewport& viewport = view.viewport;
  glBlitFramebuffer(0, 0, viewport.width, viewport.height, viewport.x, viewport.y,
                    viewport.x + viewport.width, viewport.y + viewport.height,
                    GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, static_cast<GLuint>(bound));
  boxes_.drop_unheld();
}

}  // namespace patchlab::viewer
