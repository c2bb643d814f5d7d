#include "viewer/app/point_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "viewer/panel/colours.h"

namespace patchlab::viewer {

namespace {

constexpr double residual_reach = 3.0;  // standard deviations at the ends of the residual colours

constexpr std::size_t steps_of_scale = 256;

void paint_shades(const PointScene& in, const Shades& shades, std::vector<Rgba8>& colours) {
  std::array<Rgba8, 256> by_shade;
  for (std::size_t i = 0; i < by_shade.size(); ++i) {
    by_shade[i] = to_bytes(mix(in.theme.point_dark, in.theme.point_lit, static_cast<float>(i) / 255.0f));
  }
  for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = by_shade[shades ? (*shades)[i] : 160];
}

void paint_photo(const Scan& scan, std::vector<Rgba8>& colours) {
  std::transform(scan.colours.begin(), scan.colours.end(), colours.begin(), [](const auto& colour) {
    return Rgba8{colour[0], colour[1], colour[2], 255};
  });
}

// Points without a number stay as they are.
void paint_scale(const PointScene& in, const ScanEntry& entry, std::vector<Rgba8>& colours) {
  std::array<Rgba8, steps_of_scale> by_step;
  for (std::size_t i = 0; i < by_step.size(); ++i)
    by_step[i] = to_bytes(sequential(static_cast<double>(i) / (steps_of_scale - 1), in.state.map));
  const double steps = (steps_of_scale - 1) / std::max(in.scale->high - in.scale->low, 1e-9);
  for (std::size_t i = 0; i < colours.size(); ++i) {
    const double value = entry.scan->finite[i] ? in.scale->value(entry, i) : std::nan("");
    if (!std::isfinite(value)) continue;
    const double at = std::clamp((value - in.scale->low) * steps, 0.0, steps_of_scale - 1.0);
    colours[i] = by_step[static_cast<std::size_t>(at + 0.5)];
  }
}

// Points without a label stay as they are.
void paint_labels(const Scan& scan, std::vector<Rgba8>& colours) {
  std::map<std::uint32_t, Rgba8> by_label;
  for (std::size_t i = 0; i < scan.labels.size(); ++i) {
    const std::uint32_t label = scan.labels[i];
    if (label == 0) continue;
    const auto [known, is_new] = by_label.try_emplace(label);
    if (is_new) known->second = to_bytes(category_colour("label-" + std::to_string(label)));
    colours[i] = known->second;
  }
}

void paint_base(const PointScene& in, const ScanEntry& entry, const Shades& shades,
                std::vector<Rgba8>& colours) {
  const Scan& scan = *entry.scan;
  paint_shades(in, shades, colours);
  if (in.state.colours == PointColours::photo) paint_photo(scan, colours);
  if (in.state.colours == PointColours::label) paint_labels(scan, colours);
  if (in.scale) paint_scale(in, entry, colours);
}

void paint(const std::shared_ptr<const std::vector<std::uint32_t>>& ids, const Rgba8& colour,
           std::vector<Rgba8>& colours) {
  if (!ids) return;
  for (const std::uint32_t id : *ids)
    if (id < colours.size()) colours[id] = colour;
}

void tint(const std::vector<std::uint32_t>& ids, const Rgba& colour, std::vector<Rgba8>& colours) {
  for (const std::uint32_t id : ids) {
    if (id >= colours.size()) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      colours[id][k] = static_cast<std::uint8_t>(0.5f * colours[id][k] + 0.5f * 255.0f * colour[k]);
    }
  }
}

void paint_residuals(const PatchEntry& entry, double neutral_lightness, std::vector<Rgba8>& colours) {
  const std::vector<double>& residuals = entry.fit->report.residuals;
  for (std::size_t i = 0; i < residuals.size() && i < entry.points->size(); ++i) {
    const std::uint32_t id = (*entry.points)[i];
    if (id < colours.size())
      colours[id] = to_bytes(diverging(residuals[i] / residual_reach, neutral_lightness));
  }
}

void paint_outliers(const PatchEntry& entry, const Rgba& colour, std::vector<Rgba8>& colours) {
  for (const std::uint32_t index : entry.fit->report.outliers) {
    if (index < entry.points->size() && (*entry.points)[index] < colours.size()) {
      colours[(*entry.points)[index]] = to_bytes(colour);
    }
  }
}

}  // namespace

const RegionEntry* lit_region(const Document& document, const std::string& selected) {
  const PatchEntry* patch = find_patch(document, selected);
  return find_region(document, patch ? patch->region : selected);
}

std::vector<Rgba8> point_colours(const PointScene& in, const ScanEntry& entry, const Shades& shades) {
  std::vector<Rgba8> colours(entry.scan->size());
  paint_base(in, entry, shades, colours);
  const RegionEntry* lit = lit_region(in.document, in.state.selected);
  for (const RegionEntry& region : in.document.regions) {
    if (region.scan != entry.id || !region.visible || !region.points || &region == lit) continue;
    tint(*region.points, colour_of(region), colours);
  }
  if (lit && lit->scan == entry.id) paint(lit->points, to_bytes(in.theme.point_selected), colours);
  const PatchEntry* patch = find_patch(in.document, in.state.selected);
  if (patch && patch->scan == entry.id && patch->fit && patch->points) {
    if (in.state.colours == PointColours::residual)
      paint_residuals(*patch, in.theme.neutral_lightness, colours);
    paint_outliers(*patch, in.theme.point_outlier, colours);
  }
  return colours;
}

std::optional<PointsItem> chosen_points(const PointScene& in, const ScanEntry& entry,
                                        const Eigen::Vector3d& origin, std::vector<Rgba8>& colours) {
  const PatchEntry* patch = find_patch(in.document, in.state.selected);
  const RegionEntry* lit = lit_region(in.document, in.state.selected);
  const bool covered = patch && patch->visible && patch->fit && in.state.layers.surface;
  if (!covered || !lit || !lit->points || lit->scan != entry.id) return std::nullopt;
  auto positions = std::make_shared<std::vector<Eigen::Vector3f>>();
  auto own_colours = std::make_shared<std::vector<Rgba8>>();
  const Eigen::Vector3f moved = (entry.scan->origin - origin).cast<float>();
  const Rgba8 outlier = to_bytes(in.theme.point_outlier);
  for (const std::uint32_t id : *lit->points) {
    if (colours[id] == outlier) continue;
    positions->push_back(entry.scan->positions[id] + moved);
    own_colours->push_back(colours[id]);
    colours[id][3] = 0;
  }
  return PointsItem{positions, own_colours};
}

Shared<Eigen::Vector3f> point_positions(const std::shared_ptr<const Scan>& scan,
                                        const Eigen::Vector3d& origin) {
  if (scan->origin == origin) return {scan, &scan->positions};
  auto moved = std::make_shared<std::vector<Eigen::Vector3f>>(scan->positions);
  const Eigen::Vector3f by = (scan->origin - origin).cast<float>();
  for (Eigen::Vector3f& position : *moved) position += by;
  return moved;
}

}  // namespace patchlab::viewer
