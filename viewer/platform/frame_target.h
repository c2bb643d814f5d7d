// What a frame is drawn into: a framebuffer with depth, and where it is multisampled the plain one it is
// resolved to.
#pragma once

#include <cstdint>

#include "viewer/platform/platform.h"

namespace patchlab::viewer {

class FrameTarget {
 public:
  explicit FrameTarget(int samples) : samples_(samples) {}
  FrameTarget(const FrameTarget&) = delete;
  FrameTarget& operator=(const FrameTarget&) = delete;
  ~FrameTarget();

  void begin(int width, int height);  // makes or remakes the buffers, clears and binds the one to draw into
  void resolve();                     // binds the plain one, holding what was drawn
  void present() const;               // copies it to the window's framebuffer
  Image read() const;

 private:
  struct Buffer {
    std::uint32_t framebuffer = 0, colour = 0, depth = 0;
  };
  void allocate();
  static Buffer make(int width, int height, int samples);
  static void release(Buffer& buffer);

  const Buffer& plain() const { return samples_ > 0 ? resolved_ : drawn_; }

  int samples_;
  int width_ = 0, height_ = 0;
  Buffer drawn_, resolved_;
};

}  // namespace patchlab::viewer
