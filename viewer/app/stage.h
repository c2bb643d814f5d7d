// The 3D view: its camera, and the scene made of the document. Knows no ImGui and no window.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/project/document.h"
#include "viewer/app/patch_scene.h"
#include "viewer/app/point_scene.h"
#include "viewer/camera/orbit_camera.h"
#include "viewer/panel/view_state.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

class Stage {
 public:
  OrbitCamera camera;

  // Makes the scene anew where `generation` or what the state says of the picture has changed.
  void update(const Document& document, const ViewState& state, std::uint64_t generation, float scale);
  const Scene& scene() const { return scene_; }
  // Points as large as suits their distance from each other on the screen, but at least `least` pixels.
  void size_points(double viewport_height, float least);
  // Notes for the overlays, with labels where `view` sees them.
  SceneNotes notes(const ViewCamera& view) const;

  // Shades of a scan that the worker has made; a scan without them is drawn plain.
  void set_shades(const std::shared_ptr<const Scan>& scan, Shades shades);
  bool has_shades(const std::shared_ptr<const Scan>& scan) const { return shades_.contains(scan); }

  // Cameras. Each flies there in a moment; settle() jumps to the end.
  void view_of_sensor(const Scan& scan, double aspect);
  void frame_all(const Document& document, double aspect);
  void frame(const Document& document, const std::string& id, double aspect);
  void look_along(const ViewCamera& view, const Document& document, const std::string& id, double aspect);
  void set_pivot(const Eigen::Vector3d& pivot);
  bool fly(double seconds);              // moves on; true while under way
  void settle();                         // at the end of the flight
  void interrupt() { flight_.reset(); }  // the user has taken over
  bool flying() const { return flight_.has_value(); }

 private:
  struct Flight {
    OrbitCamera from, to;
    double part = 0.0;
  };
  struct Drawn {  // what the present scene was made of
    std::uint64_t generation = 0;
    std::string selected;
    ThemeChoice theme{};
    PointColours colours{};
    Layers layers;
    float scale = 0;
    std::size_t shades_made = 0;
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // heights are measured along it
    bool operator==(const Drawn&) const = default;
  };
  struct KnownSurface {
    std::shared_ptr<const FitResult> fit;  // held: its address is the key
    bool coloured = false;
    Rgba flat{};
    SurfaceMesh mesh;
  };

  void fly_to(const OrbitCamera& to);
  OrbitCamera target() const { return flight_ ? flight_->to : camera; }
  void add_points(const PointScene& in);
  double metres_per_pixel(double viewport_height) const;  // at the pivot
  void add_patches(const PointScene& in, float scale);
  const SurfaceMesh& surface_of(const PatchEntry& entry, const std::optional<Rgba>& flat);

  Scene scene_;
  std::optional<Drawn> drawn_;
  SceneNotes notes_;
  std::vector<AxisTip> tips_;
  std::map<std::shared_ptr<const Scan>, Shades> shades_;
  std::map<std::shared_ptr<const Scan>, double> spacings_;  // m
  std::vector<double> drawn_spacings_;                      // of the scene's points
  std::size_t shades_made_ = 0;
  std::map<std::string, KnownSurface> surfaces_;  // by patch id
  std::optional<Flight> flight_;
};

}  // namespace patchlab::viewer
