#include "viewer/render/line_pass.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace patchlab::viewer {
namespace {

// How much nearer lines are drawn than they are, so that a curve on a surface is not torn by it.
constexpr float kPull = 0.002f;  // of the depth, or of the viewport's height where orthographic

// Opacity of lines that are seen through a translucent mesh.
constexpr float kVeiled = 0.35f;

void leave() {
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
}

Rgba8 to_bytes(const Rgba& colour, float alpha) {
  const auto byte = [](float v) {
    return static_cast<std::uint8_t>(std::lround(255.0f * std::clamp(v, 0.0f, 1.0f)));
  };
  return {byte(colour[0]), byte(colour[1]), byte(colour[2]), byte(alpha * colour[3])};
}

}  // namespace

Result<LinePass> LinePass::create() {
  Result<Program> program = Program::link(shaders::lines_vert, shaders::lines_frag);
  if (!program) return program.error();
  return LinePass(std::move(*program));
}

void LinePass::grow(Box& box, const std::vector<LineItem>& items) {
  for (const LineItem& item : items)
    for (const Eigen::Vector3f& point : item.points) box.extend(point);
}

// The points with one more before and after, which shape the first and the last joint.
void LinePass::append(std::vector<Vertex>& strip, const LineItem& item, float alpha) {
  const auto& points = item.points;
  if (points.size() < 2) return;
  const Rgba8 colour = to_bytes(item.colour, alpha);
  const bool closed = item.closed && points.size() > 2;
  strip.push_back({closed ? points.back() : points.front(), colour, 0.0f});
  for (const Eigen::Vector3f& point : points) strip.push_back({point, colour, item.width});
  if (closed) strip.push_back({points[0], colour, 0.0f});
  strip.back().width = 0.0f;
  strip.push_back({closed ? points[1] : points.back(), colour, 0.0f});
}

void LinePass::load(const std::vector<LineItem>& items) {
  std::vector<Vertex> strip;
  const auto add = [&](bool on_top, auto alpha_of) {
    const std::size_t begin = strip.size();
    for (const LineItem& item : items)
      if (item.on_top == on_top) append(strip, item, alpha_of(item));
    return Range{begin, strip.size()};
  };
  in_depth_ = add(false, [](const LineItem&) { return 1.0f; });
  hidden_ = add(true, [](const LineItem& item) { return item.hidden_alpha; });
  on_top_ = add(true, [](const LineItem&) { return 1.0f; });
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(strip.size() * sizeof(Vertex)), strip.data(),
               GL_STREAM_DRAW);
}

void LinePass::use(const View& view, float opacity, float already) const {
  program_.use();
  set_view(program_, view);
  program_.set("viewport", Eigen::Vector2f(view.viewport.width, view.viewport.height));
  program_.set("corner", Eigen::Vector2f(view.viewport.x, view.viewport.y));
  program_.set("near_depth", view.near_depth);
  program_.set("pull", view.perspective ? Eigen::Vector2f(1.0f - kPull, 0.0f)
                                        : Eigen::Vector2f(1.0f, kPull * view.height));
  program_.set("opacity", opacity);
  program_.set("already", already);
  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
}

void LinePass::draw_range(const Range& range, GLenum depth_test) const {
  if (range.end - range.begin < 4) return;
  glBindVertexArray(arrays_.name());
  glBindBuffer(GL_ARRAY_BUFFER, buffer_.name());
  const auto of_vertex = [&](std::size_t index, std::size_t member) {
    return (range.begin + index) * sizeof(Vertex) + member;
  };
  for (GLuint point = 0; point < 4;
       ++point)  // before, start, end, after: a window that slides along the strip
    attribute(point, 3, GL_FLOAT, sizeof(Vertex), of_vertex(point, offsetof(Vertex, position)));
  attribute(4, 4, GL_UNSIGNED_BYTE, sizeof(Vertex), of_vertex(1, offsetof(Vertex, colour)));
  attribute(5, 1, GL_FLOAT, sizeof(Vertex), of_vertex(1, offsetof(Vertex, width)));
  for (GLuint index = 0; index < 6; ++index) glVertexAttribDivisor(index, 1);
  glDepthFunc(depth_test);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(range.end - range.begin - 3));
}

void LinePass::draw_veiled(const View& view) const {
  use(view, kVeiled, 0.0f);
  draw_range(in_depth_, GL_LEQUAL);
  leave();
}

void LinePass::draw_unveiled(const View& view) const {
  use(view, 1.0f, kVeiled);
  draw_range(in_depth_, GL_LEQUAL);
  use(view, 1.0f, 0.0f);
  draw_range(hidden_, GL_GREATER);
  draw_range(on_top_, GL_LEQUAL);
  leave();
}

}  // namespace patchlab::viewer
