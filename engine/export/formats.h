// The writers behind the table of formats, one file each. Their sets are checked: every patch is valid, every
// id is wanted. Lengths are metre.
#pragma once

#include "engine/export/export.h"

namespace patchlab {

// The patch set itself, with further covariances of each pose where they are asked for.
Result<Exported> export_patch_set(const PatchSet& set, const ExportOptions& options);

// One row a patch, numbers that read back to the same bits: id, frame_id, source, surface, boundary, size; a
// column for each parameter that some type has, and sigma_NAME; the quaternion of the pose; cov_i_j, i <= j,
// by the place of the parameters in their order, from 1. nan where the type has no such parameter or the
// patch no covariance.
Result<Exported> export_csv(const PatchSet& set, const ExportOptions& options);

// JSON (schema: assets/schema/footholds.schema.json): a convex polygon a patch to stand in, pose, normal,
// tilt and the probability that it exceeds the limit. Patches that are too small, or have no covariance to
// keep away from, are left out by name.
Result<Exported> export_footholds(const PatchSet& set, const ExportOptions& options);
// The same polygons in the fields of convex_plane_decomposition_msgs/PlanarTerrain, as JSON: pose, bounding
// box, boundary, and the polygon as its inset. A patch that leaves its plane by more than 10 mm is left out.
Result<Exported> export_planar_regions(const PatchSet& set, const ExportOptions& options);

// Triangles, open or (with a thickness) closed solids, in the one frame of the patches.
//
// PLY, binary little-endian, doubles. A vertex has x y z, nx ny nz (outward), height_sigma (m: standard
// deviation of the height along the normal, from the covariance of curvature and pose; -1 where the patch has
// no covariance) and patch (its number among those written, from 0). Comments name each patch and its type.
Result<Exported> export_ply(const PatchSet& set, const ExportOptions& options);
// OBJ, text, numbers that read back to the same bits; one object a patch, with normals.
Result<Exported> export_obj(const PatchSet& set, const ExportOptions& options);
// STL, binary: single precision. Refused where that would move a point by more than 0.1 mm.
Result<Exported> export_stl(const PatchSet& set, const ExportOptions& options);

// Folders: a world with a fixed body for each patch, and its meshes, in the one frame of the patches.
//
// world.urdf: thick meshes; concave ones are marked concave="yes" (Bullet), for engines that would take the
// hull.
Result<Exported> export_urdf(const PatchSet& set, const ExportOptions& options);
// world.xml for MuJoCo, which takes the hull of a mesh: so a patch that rises above its tangent plane is a
// height field, exact to its 96 x 96 cells.
Result<Exported> export_mjcf(const PatchSet& set, const ExportOptions& options);

// A bag of ROS 1 (2.0, not compressed) and a folder of YAML for `ros2 topic pub`, one file a message:
// markers, a pose with covariance a patch, points with covariances (engine/export/patch_messages.h). The bag
// holds the measured points where they are given; the YAML, which has to fit an argument, never does.
Result<Exported> export_ros1_bag(const PatchSet& set, const ExportOptions& options);
Result<Exported> export_ros2_yaml(const PatchSet& set, const ExportOptions& options);

}  // namespace patchlab
