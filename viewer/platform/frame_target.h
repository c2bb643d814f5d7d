// What a frame is drawn into: a multisampled framebuffer with depth, and the plain one it is resolved to.
#pragma once

#include <cstdint>

#include "viewer/platform/platform.h"

namespace patchlab::viewer {

class FrameTarget {
 public:
  FrameTarget() = default;
  FrameTarget(const FrameTarget&) = delete;
  FrameTarget& operator=(const FrameTarget&) = delete;
  ~FrameTarget();

  void begin(int width, int height);  // makes or remakes the buffers, clears and binds the multisampled one
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

  int width_ = 0, height_ = 0;
  Buffer drawn_, resolved_;
};

}  // namespace patchlab::viewer
