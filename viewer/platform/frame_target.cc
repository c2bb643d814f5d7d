#include "viewer/platform/frame_target.h"

#include <epoxy/gl.h>

namespace patchlab::viewer {
namespace {

GLuint renderbuffer(GLenum format, GLenum attachment, int width, int height, int samples) {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  glBindRenderbuffer(GL_RENDERBUFFER, name);
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, name);
  return name;
}

void copy(GLuint from, GLuint to, int width, int height) {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, from);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, to);
  glDisable(GL_SCISSOR_TEST);
  glBlitFramebuffer(0, 0, width, height, 0, 0, width, height, GL_COLOR_BUFFER_BIT, GL_NEAREST);
}

}  // namespace

FrameTarget::~FrameTarget() {
  release(drawn_);
  release(resolved_);
}

FrameTarget::Buffer FrameTarget::make(int width, int height, int samples) {
  Buffer buffer;
  glGenFramebuffers(1, &buffer.framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, buffer.framebuffer);
  buffer.colour = renderbuffer(GL_RGBA8, GL_COLOR_ATTACHMENT0, width, height, samples);
  buffer.depth = renderbuffer(GL_DEPTH_COMPONENT24, GL_DEPTH_ATTACHMENT, width, height, samples);
  return buffer;
}

void FrameTarget::release(Buffer& buffer) {
  if (buffer.framebuffer == 0) return;
  glDeleteFramebuffers(1, &buffer.framebuffer);
  glDeleteRenderbuffers(1, &buffer.colour);
  glDeleteRenderbuffers(1, &buffer.depth);
  buffer = {};
}

void FrameTarget::allocate() {
  release(drawn_);
  release(resolved_);
  drawn_ = make(width_, height_, samples_);
  if (samples_ > 0) resolved_ = make(width_, height_, 0);
}

void FrameTarget::begin(int width, int height) {
  if (width != width_ || height != height_) {
    width_ = width;
    height_ = height;
    allocate();
  }
  glBindFramebuffer(GL_FRAMEBUFFER, drawn_.framebuffer);
  glViewport(0, 0, width_, height_);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glClearColor(0.0f, 0.0f, 0.0f, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void FrameTarget::resolve() {
  if (samples_ > 0) copy(drawn_.framebuffer, resolved_.framebuffer, width_, height_);
  glBindFramebuffer(GL_FRAMEBUFFER, plain().framebuffer);
}

void FrameTarget::present() const { copy(plain().framebuffer, 0, width_, height_); }

Image FrameTarget::read() const {
  Image image{width_, height_, {}};
  const std::size_t row = 3 * static_cast<std::size_t>(width_);
  std::vector<std::uint8_t> upwards(row * static_cast<std::size_t>(height_));
  glBindFramebuffer(GL_READ_FRAMEBUFFER, plain().framebuffer);
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width_, height_, GL_RGB, GL_UNSIGNED_BYTE, upwards.data());
  image.rgb.reserve(upwards.size());
  for (int y = height_ - 1; y >= 0; --y) {
    const auto begin = upwards.begin() + static_cast<std::ptrdiff_t>(row) * y;
    image.rgb.insert(image.rgb.end(), begin, begin + static_cast<std::ptrdiff_t>(row));
  }
  return image;
}

}  // namespace patchlab::viewer
