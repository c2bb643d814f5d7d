// The 3D view: its camera, and the scene made of the document. Knows no ImGui and no window.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/project/document.h"
#include "viewer/app/map_scene.h"
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
  // Points as large as suits their distance from each other on the screen, but at least `least` pixels. Of
  // many, one in `one_in` is drawn, that much larger.
  void size_points(double viewport_height, float least, std::size_t one_in = 1);
  std::size_t points() const;  // of the scene
  // Notes for the overlays, with labels where `view` sees them.
  SceneNotes notes(const ViewCamera& view) const;

  // Shades of a scan that the worker has made; a scan without them is drawn plain.
  void set_shades(const std::shared_ptr<const Scan>& scan, Shades shades);
  bool has_shades(const std::shared_ptr<const Scan>& scan) const { return shades_.contains(scan); }

  // How far noise spreads the points of a scan, made by the worker for one noise model.
  void set_sigmas(const ScanEntry& entry, Sigmas sigmas);
  bool has_sigmas(const ScanEntry& entry) const;

  // Seen obliquely from above, all of it.
  void oblique_view(const Document& document, double aspect);

  // Cameras. Each flies there in a moment; settle() jumps to the end.
  void look_from(double azimuth, double elevation);  // rad, about the pivot
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
    ColourMap map{};
    SigmaOf sigma_of{};
    std::size_t shades_made = 0;
    Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // heights are measured along it
    bool operator==(const Drawn&) const = default;
  };
  struct KnownSurface {
    std::shared_ptr<const FitResult> fit;  // held: its address is the key
    bool coloured = false;
    Rgba flat{};
    ColourMap map{};
    SigmaOf sigma_of{};
    SurfaceMesh mesh;
  };

  void fly_to(const OrbitCamera& to);
  OrbitCamera target() const { return flight_ ? flight_->to : camera; }
  void forget_absent(const Document& document);
  void add_points(const PointScene& in);
  double metres_per_pixel(double viewport_height) const;  // at the pivot
  void add_patches(const PointScene& in, float scale);
  const SurfaceMesh& surface_of(const PatchEntry& entry, const std::optional<Rgba>& flat,
                                const ViewState& state);
  void add_chosen(const PointScene& in, const PatchEntry& entry, const Rgba& colour, float scale);
  void add_point_ellipsoids(const PointScene& in);
  void take(PatchScene scene);

  Scene scene_;
  std::optional<Drawn> drawn_;
  SceneNotes notes_;
  std::vector<AxisTip> tips_;
  std::map<std::shared_ptr<const Scan>, Shades> shades_;
  std::map<std::shared_ptr<const Scan>, double> spacings_;  // m
  struct KnownSigmas {
    std::string noise;  // its specification
    Sigmas sigmas;
  };
  std::map<std::shared_ptr<const Scan>, KnownSigmas> sigmas_;
  struct DrawnPoints {
    double apart;  // m, from point to point
    double share;  // of it that a point covers
    bool thinned;  // where they are dense, so that the surface is seen between them
  };
  std::vector<DrawnPoints> drawn_points_;  // one an item of the scene
  std::size_t shades_made_ = 0;
  std::map<std::string, KnownSurface> surfaces_;  // by patch id
  MapScene maps_and_robots_;
  std::optional<Flight> flight_;
};

}  // namespace patchlab::viewer
