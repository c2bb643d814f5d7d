#include "viewer/app/stage.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "viewer/app/boxes.h"
#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

// Of the distance between points, how much a point covers; and how much larger than asked for it may get.
constexpr double point_share = 1.25;
constexpr double chosen_share = 0.15;  // of that, where a surface is to be seen between them
constexpr double chosen_apart = 3.0;   // of the size of a point, from one such to the next
constexpr double set_back = 2.5;  // of that distance: what noise alone puts before a patch does not hide it
constexpr double map_set_back = 8.0;  // the same where patches of other sights lie among the points
constexpr float most_larger = 6.0f;
constexpr double flight_seconds = 0.22;
constexpr double sensor_fov = 0.80;  // rad, where the scan does not say its own

// The least prime with which points of a surface, `ratio` times too close, are far enough apart.
std::size_t every(double ratio) {
  constexpr std::size_t primes[] = {1, 2, 3, 5, 7, 11, 17, 23, 31, 43, 61, 89, 127, 181, 257, 367, 521};
  const double wanted = ratio * ratio;
  for (const std::size_t prime : primes)
    if (static_cast<double>(prime) >= wanted) return prime;
  return primes[std::size(primes) - 1];
}

double fov_of(const Scan& scan) {
  if (!scan.intrinsics || scan.height < 2) return sensor_fov;
  return 2 * std::atan(0.5 * scan.height / (*scan.intrinsics)[1]);
}

}  // namespace

void Stage::update(const Document& document, const ViewState& state, std::uint64_t generation, float scale) {
  const Drawn wanted{generation, state.selected, state.theme,    state.colours, state.layers,
                     scale,      state.map,      state.sigma_of, shades_made_,  target().up};
  if (drawn_ == wanted) return;
  drawn_ = wanted;
  forget_absent(document);
  const Theme colours = theme(state.theme);
  scene_ = {};
  notes_ = {};
  tips_.clear();
  scene_.background_top = colours.view_top;
  scene_.background_bottom = colours.view_bottom;
  if (!document.scans.empty() && document.scans.front().scan)
    scene_.origin = document.scans.front().scan->origin;
  PointScene in{document, state, colours};
  if (state.colours == PointColours::height) in.scale = height_scale(document, wanted.up);
  if (state.colours == PointColours::intensity) in.scale = intensity_scale(document);
  if (state.colours == PointColours::noise) {
    in.scale = noise_scale(document, [this](const ScanEntry& entry) {
      return has_sigmas(entry) ? sigmas_.at(entry.scan).sigmas : nullptr;
    });
  }
  if (in.scale) notes_.points = {in.scale->title, {in.scale->low, in.scale->high}};
  add_points(in);
  add_patches(in, scale);
  take(maps_and_robots_.make({document, state, colours, scene_.origin, scale}));
  notes_.residual_colours = state.colours == PointColours::residual && find_patch(document, state.selected);
}

void Stage::forget_absent(const Document& document) {
  const auto is_absent = [&](const auto& known) {
    return std::ranges::find(document.scans, known.first, &ScanEntry::scan) == document.scans.end();
  };
  std::erase_if(shades_, is_absent);
  std::erase_if(spacings_, is_absent);
  std::erase_if(sigmas_, is_absent);
  std::erase_if(surfaces_, [&](const auto& known) { return !find_patch(document, known.first); });
}

void Stage::add_points(const PointScene& in) {
  drawn_points_.clear();
  for (const ScanEntry& entry : in.document.scans) {
    if (!entry.visible || !entry.scan) continue;
    const std::shared_ptr<const Scan>& scan = entry.scan;
    const auto shades = shades_.find(scan);
    std::vector<Rgba8> colours = point_colours(in, entry, shades == shades_.end() ? nullptr : shades->second);
    const std::optional<PointsItem> chosen = chosen_points(in, entry, scene_.origin, colours);
    scene_.points.push_back({point_positions(entry.scan, scene_.origin),
                             std::make_shared<const std::vector<Rgba8>>(std::move(colours))});
    if (!spacings_.contains(scan)) spacings_[scan] = point_spacing(*scan);
    drawn_points_.push_back({spacings_[scan], point_share, false});
    scene_.points.back().set_back =
        static_cast<float>((in.document.maps.empty() ? set_back : map_set_back) * spacings_[scan]);
    if (!chosen) continue;
    scene_.points.push_back(*chosen);
    const bool thinned = in.state.colours != PointColours::residual;
    drawn_points_.push_back({spacings_[scan], chosen_share * point_share, thinned});
  }
}

double Stage::metres_per_pixel(double viewport_height) const {
  return 2 * camera.distance * std::tan(0.5 * camera.fov_y) / viewport_height;
}

std::size_t Stage::points() const {
  std::size_t count = 0;
  for (const PointsItem& item : scene_.points) count += item.positions->size();
  return count;
}

void Stage::size_points(double viewport_height, float least, std::size_t one_in) {
  const double wider = std::sqrt(static_cast<double>(one_in));
  for (std::size_t i = 0; i < scene_.points.size(); ++i) {
    const double apart = wider * drawn_points_[i].apart / metres_per_pixel(viewport_height);
    const auto suits = static_cast<float>(drawn_points_[i].share * apart);
    scene_.points[i].size = std::clamp(suits, least, most_larger * least);
    scene_.points[i].step = one_in;
    if (drawn_points_[i].thinned) scene_.points[i].step *= every(chosen_apart * least / apart);
  }
}

void Stage::add_patches(const PointScene& in, float scale) {
  for (const PatchEntry& entry : in.document.patches) {
    if (!entry.visible || !entry.fit) continue;
    const bool chosen = entry.id == in.state.selected;
    const Rgba colour = colour_of(entry);
    if (in.state.layers.surface) {
      const SurfaceMesh& surface =
          surface_of(entry, chosen ? std::nullopt : std::optional(with_alpha(colour, 0.45f)), in.state);
      scene_.meshes.push_back(surface.item);
      if (chosen) notes_.height_sigma = surface.height_sigma;
    }
    if (in.state.layers.grid)
      std::ranges::move(grid_items(entry.fit->patch, scene_.origin, with_alpha(in.theme.text, 0.55f), scale),
                        std::back_inserter(scene_.lines));
    if (in.state.layers.names) tips_.push_back({centre(entry.fit->patch), entry.name, in.theme.text});
    if (chosen)
      add_chosen(in, entry, colour, scale);
    else
      scene_.lines.push_back(outline_item(entry.fit->patch, scene_.origin, colour, 2.0f * scale));
  }
  if (in.state.layers.points) add_point_ellipsoids(in);
}

void Stage::add_chosen(const PointScene& in, const PatchEntry& entry, const Rgba& colour, float scale) {
  const Patch patch = with_part(entry.fit->patch, in.state.sigma_of);
  take(chosen_patch(patch, scene_.origin, in.state.layers, in.theme, colour, scale));
  if (notes_.lines.empty() || in.state.sigma_of == SigmaOf::both) return;
  notes_.lines.emplace_back(in.state.sigma_of == SigmaOf::shape
                                ? "of the shape alone, the pose taken as known"
                                : "of the pose alone, the shape taken as known");
}

void Stage::add_point_ellipsoids(const PointScene& in) {
  const RegionEntry* region = lit_region(in.document, in.state.selected);
  const ScanEntry* scan = region ? find_scan(in.document, region->scan) : nullptr;
  if (!scan || !scan->scan || !region->points) return;
  take(point_ellipsoids(*scan, *region, spacings_[scan->scan], scene_.origin, in.theme));
}

void Stage::take(PatchScene scene) {
  std::ranges::move(scene.meshes, std::back_inserter(scene_.meshes));
  std::ranges::move(scene.lines, std::back_inserter(scene_.lines));
  std::ranges::move(scene.tips, std::back_inserter(tips_));
  std::ranges::move(scene.notes, std::back_inserter(notes_.lines));
}

const SurfaceMesh& Stage::surface_of(const PatchEntry& entry, const std::optional<Rgba>& flat,
                                     const ViewState& state) {
  KnownSurface& known = surfaces_[entry.id];
  const Rgba wanted = flat.value_or(Rgba{});
  if (known.fit != entry.fit || known.coloured != !flat || known.flat != wanted || known.map != state.map ||
      known.sigma_of != state.sigma_of) {
    const Patch patch = with_part(entry.fit->patch, state.sigma_of);
    known = {entry.fit, !flat,          wanted,
             state.map, state.sigma_of, surface_item(patch, scene_.origin, flat, state.map)};
  }
  return known.mesh;
}

SceneNotes Stage::notes(const ViewCamera& view) const {
  SceneNotes notes = notes_;
  notes.metres_per_pixel = metres_per_pixel(view.viewport[1]);
  for (const AxisTip& tip : tips_) {
    const Projected seen = project(view, tip.position);
    if (seen.depth > view.near_plane) notes.labels.push_back({{seen.x, seen.y}, tip.text, tip.colour});
  }
  return notes;
}

void Stage::set_shades(const std::shared_ptr<const Scan>& scan, Shades shades) {
  shades_[scan] = std::move(shades);
  ++shades_made_;
}

void Stage::set_sigmas(const ScanEntry& entry, Sigmas sigmas) {
  sigmas_[entry.scan] = {entry.noise.specification, std::move(sigmas)};
  ++shades_made_;
}

bool Stage::has_sigmas(const ScanEntry& entry) const {
  const auto known = sigmas_.find(entry.scan);
  return known != sigmas_.end() && known->second.noise == entry.noise.specification;
}

void Stage::look_from(double azimuth, double elevation) {
  OrbitCamera to = target();
  to.azimuth = azimuth;
  to.elevation = elevation;
  fly_to(to);
}

void Stage::fly_to(const OrbitCamera& to) { flight_ = Flight{camera, to, 0.0}; }

bool Stage::fly(double seconds) {
  if (!flight_) return false;
  flight_->part = std::min(1.0, flight_->part + seconds / flight_seconds);
  const double eased = flight_->part * flight_->part * (3 - 2 * flight_->part);
  camera = between(flight_->from, flight_->to, eased);
  if (flight_->part == 1.0) settle();
  return flight_.has_value();
}

void Stage::settle() {
  if (flight_) camera = flight_->to;
  flight_.reset();
}

void Stage::view_of_sensor(const Scan& scan, double aspect) {
  OrbitCamera to = target();
  const std::optional<double> depth = depth_seen_by_sensor(scan);
  if (depth) {
    to = from_sensor(scan.viewpoint, *depth, fov_of(scan));
    to.perspective = camera.perspective;
  } else if (const std::optional<Bounds> box = bounds(scan)) {
    to.up = Eigen::Vector3d::UnitZ();
    to.azimuth = 0.6;
    to.elevation = 0.5;
    to.frame(box->min, box->max, aspect);
  }
  fly_to(to);
}

void Stage::frame_all(const Document& document, double aspect) {
  const std::optional<Bounds> box = box_of(document);
  if (!box) return;
  OrbitCamera to = target();
  to.frame(box->min, box->max, aspect);
  fly_to(to);
}

void Stage::oblique_view(const Document& document, double aspect) {
  constexpr double to_the_right = 0.6, above = 0.3;  // rad
  look_from(to_the_right, above);
  frame_all(document, aspect);
}

void Stage::frame(const Document& document, const std::string& id, double aspect) {
  const std::optional<Bounds> box = box_of(document, id);
  if (!box) return;
  OrbitCamera to = target();
  to.frame(box->min, box->max, aspect);
  to.distance *= 1.5;
  fly_to(to);
}

void Stage::look_along(const ViewCamera& view, const Document& document, const std::string& id,
                       double aspect) {
  const auto& q = view.quaternion_xyzw;
  const Eigen::Vector3d outwards = Eigen::Quaterniond(q[3], q[0], q[1], q[2]) * Eigen::Vector3d::UnitZ();
  OrbitCamera to = target();
  turn_towards(to, outwards);
  to.fov_y = view.fov_y;
  flight_ = Flight{to, to, 0.0};
  frame(document, id, aspect);
  settle();
}

void Stage::set_pivot(const Eigen::Vector3d& pivot) {
  OrbitCamera to = target();
  to.pivot = pivot;
  fly_to(to);
}

}  // namespace patchlab::viewer
