#include "viewer/render/mesh_pass.h"

#include <algorithm>
#include <cstddef>

namespace patchlab::viewer {
namespace {

GlBuffer upload_triangles(const std::vector<std::uint32_t>& triangles) {
  GlBuffer buffer;
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, buffer.name());
  glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(triangles.size() * sizeof(std::uint32_t)),
               triangles.data(), GL_STATIC_DRAW);
  return buffer;
}

}  // namespace

Result<MeshPass> MeshPass::create() {
  Result<Program> program = Program::link(shaders::mesh_vert, shaders::mesh_frag);
  if (!program) return program.error();
  return MeshPass(std::move(*program));
}

bool MeshPass::complete(const MeshItem& item) {
  return item.vertices && item.triangles && !item.vertices->empty() && !item.triangles->empty();
}

MeshPass::Vertices MeshPass::upload(const std::vector<MeshVertex>& vertices) {
  Vertices resident;
  for (const MeshVertex& vertex : vertices) {
    resident.box.extend(vertex.position);
    resident.translucent = resident.translucent || vertex.colour[3] < 255;
  }
  glBindBuffer(GL_ARRAY_BUFFER, resident.buffer.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(MeshVertex)),
               vertices.data(), GL_STATIC_DRAW);
  return resident;
}

const MeshPass::Vertices& MeshPass::resident(const MeshItem& item) {
  return vertices_.get(item.vertices, upload);
}

void MeshPass::prepare(const std::vector<MeshItem>& items, Box& box) {
  for (const MeshItem& item : items)
    if (complete(item)) box.extend(resident(item).box);
}

std::vector<const MeshItem*> MeshPass::back_to_front(const std::vector<MeshItem>& items, const View& view,
                                                     bool translucent) {
  std::vector<std::pair<float, const MeshItem*>> found;
  for (const MeshItem& item : items) {
    if (!complete(item) || resident(item).translucent != translucent) continue;
    const Eigen::Vector3f centre = resident(item).box.center();
    found.emplace_back((view.view_from_local * centre.homogeneous()).z(), &item);
  }
  std::ranges::stable_sort(found, {}, [](const auto& entry) { return entry.first; });
  std::vector<const MeshItem*> sorted(found.size());
  std::ranges::transform(found, sorted.begin(), [](const auto& entry) { return entry.second; });
  return sorted;
}

void MeshPass::draw_one(const MeshItem& item) {
  glBindVertexArray(arrays_.name());
  glBindBuffer(GL_ARRAY_BUFFER, resident(item).buffer.name());
  attribute(0, 3, GL_FLOAT, sizeof(MeshVertex), offsetof(MeshVertex, position));
  attribute(1, 3, GL_FLOAT, sizeof(MeshVertex), offsetof(MeshVertex, normal));
  attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(MeshVertex), offsetof(MeshVertex, colour));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, triangles_.get(item.triangles, upload_triangles).name());
  program_.set("lit", item.lit ? 1.0f : 0.0f);
  glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(item.triangles->size()), GL_UNSIGNED_INT, nullptr);
}

void MeshPass::use(const View& view) const {
  program_.use();
  set_view(program_, view);
  program_.set("perspective", view.perspective ? 1.0f : 0.0f);
}

void MeshPass::draw(const std::vector<MeshItem>& items, const View& view) {
  use(view);
  for (const MeshItem* item : back_to_front(items, view, false)) draw_one(*item);

  glEnable(GL_BLEND);
  glDepthMask(GL_FALSE);
  glEnable(GL_CULL_FACE);
  for (const MeshItem* item : back_to_front(items, view, true)) {
    for (const GLenum nearer_side : {GL_FRONT, GL_BACK}) {  // of a closed surface the far side first
      glCullFace(nearer_side);
      draw_one(*item);
    }
  }
  glDisable(GL_CULL_FACE);
  glDepthMask(GL_TRUE);
  glDisable(GL_BLEND);
  vertices_.drop_unheld();
  triangles_.drop_unheld();
}

void MeshPass::draw_depth_of_translucent(const std::vector<MeshItem>& items, const View& view) {
  use(view);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  for (const MeshItem* item : back_to_front(items, view, true)) draw_one(*item);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

}  // namespace patchlab::viewer
