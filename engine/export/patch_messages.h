// A patch set as ROS messages, each header with the frame of its patch and the stamp 0 (the latest
// transform).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "engine/export/export.h"
#include "engine/export/ros_message.h"

namespace patchlab {

// Each list has one message a patch.
struct PatchMessages {
  // /patches, MarkerArray: with its id as name space the surface (0, triangles in the patch's own frame), the
  // outline (1) and the 95 % ellipsoid of the centre (2).
  std::vector<RosMessage> markers;
  // /patches/NAME/pose, PoseWithCovarianceStamped: the covariance of (position, rotation about fixed parent
  // axes); an unknown spin has variance pi^2/3.
  std::vector<RosMessage> poses;
  // /patches/NAME/points, PointCloud2: x y z (m) and covariance (cov_xx ... cov_zz, m^2; single precision)
  // of the points that the patch was fitted to, or else of points of its surface, by the variance of its
  // height; and the number of the patch.
  std::vector<RosMessage> points;
  std::vector<std::string>
      notices;  // patches without a covariance have neither pose nor ellipsoid nor points
};
// Surfaces of `cells` cells along each side; `measured` as of ExportOptions. refused error for a patch that
// names no frame.
Result<PatchMessages> patch_messages(const PatchSet& set, const std::map<std::string, Observations>& measured,
                                     int cells);
// The markers of all patches in one message; markers that are there already are deleted first.
RosMessage all_markers(const PatchMessages& messages);

}  // namespace patchlab
