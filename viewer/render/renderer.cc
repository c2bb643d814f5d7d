#include "viewer/render/renderer.h"

#include "viewer/platform/software_gl.h"
#include "viewer/render/line_pass.h"
#include "viewer/render/mesh_pass.h"
#include "viewer/render/point_pass.h"
#include "viewer/render/splat_pass.h"

namespace patchlab::viewer {
namespace {

Eigen::Vector3f rgb(const Rgba& colour) { return {colour[0], colour[1], colour[2]}; }

void begin(const Viewport& viewport) {
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glEnable(GL_SCISSOR_TEST);
  glEnable(GL_MULTISAMPLE);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LEQUAL);
  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
}

void end() {
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_SCISSOR_TEST);
}

}  // namespace

struct Renderer::State {
  Program background;
  PointPass points;
  SplatPass splats;
  MeshPass meshes;
  LinePass lines;
  GlVertexArray no_arrays;
  bool software = is_software_gl();

  // Splats cannot be copied into a multisampled framebuffer.
  bool by_processor() const {
    GLint samples = 0;
    glGetIntegerv(GL_SAMPLES, &samples);
    return software && samples == 0;
  }

  void draw_background(const Scene& scene) const {
    glDisable(GL_DEPTH_TEST);
    background.use();
    background.set("top", rgb(scene.background_top));
    background.set("bottom", rgb(scene.background_bottom));
    glBindVertexArray(no_arrays.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glEnable(GL_DEPTH_TEST);
  }
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

Result<Renderer> Renderer::create() {
  Result<Program> background = Program::link(shaders::background_vert, shaders::background_frag);
  if (!background) return background.error();
  Result<PointPass> points = PointPass::create();
  if (!points) return points.error();
  Result<MeshPass> meshes = MeshPass::create();
  if (!meshes) return meshes.error();
  Result<LinePass> lines = LinePass::create();
  if (!lines) return lines.error();
  return Renderer(std::make_unique<State>(
      State{std::move(*background), std::move(*points), {}, std::move(*meshes), std::move(*lines), {}}));
}

void Renderer::draw(const Scene& scene, const ViewCamera& camera, const Viewport& viewport) {
  if (viewport.width <= 0 || viewport.height <= 0) return;
  State& state = *state_;
  const bool by_processor = state.by_processor();
  Box box;
  if (by_processor) state.splats.prepare(scene.points, box);
  if (!by_processor) state.points.prepare(scene.points, box);
  state.meshes.prepare(scene.meshes, box);
  LinePass::grow(box, scene.lines);
  const View view = make_view(camera, viewport, scene.origin, box);
  const PointFade fade = point_fade(view, scene);

  begin(viewport);
  if (by_processor) {
    state.splats.draw(scene, view, fade);
  } else {
    state.draw_background(scene);
    state.points.draw(scene.points, view, fade);
  }
  state.meshes.draw(scene.meshes, view);
  state.lines.load(scene.lines);
  state.lines.draw_veiled(view);
  state.meshes.draw_depth_of_translucent(scene.meshes, view);
  state.lines.draw_unveiled(view);
  end();
}

}  // namespace patchlab::viewer
