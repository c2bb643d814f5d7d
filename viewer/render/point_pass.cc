#include "viewer/render/point_pass.h"

#include <limits>

namespace patchlab::viewer {
namespace {

// What points.vert takes for "absent": comparing with NaN is not reliable in shaders.
constexpr float kAbsent = std::numeric_limits<float>::max();

GlBuffer upload_colours(const std::vector<Rgba8>& colours) {
  GlBuffer buffer;
  glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(colours.size() * sizeof(Rgba8)), colours.data(),
               GL_STATIC_DRAW);
  return buffer;
}

}  // namespace

Result<PointPass> PointPass::create() {
  Result<Program> program = Program::link(shaders::points_vert, shaders::points_frag);
  if (!program) return program.error();
  return PointPass(std::move(*program));
}

PointPass::Positions PointPass::upload(const std::vector<Eigen::Vector3f>& positions) {
  Positions resident;
  std::vector<Eigen::Vector3f> finite = positions;
  for (Eigen::Vector3f& position : finite) {
    if (position.allFinite()) {
      resident.box.extend(position);
    } else {
      position.setConstant(kAbsent);
    }
  }
  glBindBuffer(GL_ARRAY_BUFFER, resident.buffer.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(finite.size() * sizeof(Eigen::Vector3f)),
               finite.data(), GL_STATIC_DRAW);
  return resident;
}

const PointPass::Positions& PointPass::resident(const PointsItem& item) {
  return positions_.get(item.positions, upload);
}

void PointPass::prepare(const std::vector<PointsItem>& items, Box& box) {
  for (const PointsItem& item : items)
    if (complete(item)) box.extend(resident(item).box);
}

void PointPass::bind(const PointsItem& item) {
  glBindVertexArray(arrays_.name());
  glBindBuffer(GL_ARRAY_BUFFER, resident(item).buffer.name());
  attribute(0, 3, GL_FLOAT, item.step * sizeof(Eigen::Vector3f), 0);
  glBindBuffer(GL_ARRAY_BUFFER, colours_.get(item.colours, upload_colours).name());
  attribute(1, 4, GL_UNSIGNED_BYTE, item.step * sizeof(Rgba8), 0);
}

void PointPass::draw(const std::vector<PointsItem>& items, const View& view, const PointFade& fade) {
  program_.use();
  set_view(program_, view);
  program_.set("fade_depths", Eigen::Vector2f(fade.nearest, fade.nearest + fade.depth));
  program_.set("farthest_fade", PointFade::kFarthest);
  program_.set("background", fade.background);
  glEnable(GL_PROGRAM_POINT_SIZE);
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  for (const PointsItem& item : items) {
    if (!complete(item)) continue;
    program_.set("size", item.size);
    program_.set("set_back", item.set_back);
    bind(item);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>((item.positions->size() - 1) / item.step + 1));
  }
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  positions_.drop_unheld();
  colours_.drop_unheld();
}

}  // namespace patchlab::viewer
