// The points of a scan in the colours that say what they are: shaded, selected, in other regions, outliers,
// residuals.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "engine/project/document.h"
#include "viewer/app/point_scale.h"
#include "viewer/panel/view_state.h"
#include "viewer/render/scene.h"

namespace patchlab::viewer {

// The shades of a scan, made once (viewer/app/point_shades.h) and shared.
using Shades = std::shared_ptr<const std::vector<std::uint8_t>>;

struct PointScene {
  const Document& document;
  const ViewState& state;
  const Theme& theme;
  std::optional<PointScale> scale = {};  // where points are coloured by a number
};

// Region whose points are lit: the selected one, or that of the selected patch; nullptr where there is none.
const RegionEntry* lit_region(const Document& document, const std::string& selected);

// `shades` may be null: all points are drawn alike then.
std::vector<Rgba8> point_colours(const PointScene& in, const ScanEntry& entry, const Shades& shades);

// The points of the chosen patch as an item of their own, where its surface is drawn: they must not hide it.
// They are taken out of `colours`, but for outliers, which must be seen. Nothing where no such patch is of
// this scan.
std::optional<PointsItem> chosen_points(const PointScene& in, const ScanEntry& entry,
                                        const Eigen::Vector3d& origin, std::vector<Rgba8>& colours);

// The positions about another origin; the scan's own array where the origins agree.
Shared<Eigen::Vector3f> point_positions(const std::shared_ptr<const Scan>& scan,
                                        const Eigen::Vector3d& origin);

}  // namespace patchlab::viewer
