// Scans in: our own strict readers. A file is read rightly or refused with one sentence that names the file,
// the line or byte, what was expected and what was found.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "engine/base/file.h"
#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/io/scan_options.h"
#include "engine/scan/scan.h"

namespace patchlab {

struct ReadOptions {
  bool points_in_sensor_frame =
      false;  // --points-in sensor: PCD points are in the sensor's frame, apply VIEWPOINT
  LengthUnit unit = LengthUnit::m;  // --unit: of the lengths in the file
  std::optional<Intrinsics> intrinsics =
      {};                    // --intrinsics: of the camera, which a depth image does not hold
  double depth_scale = 0.0;  // --depth-scale: raw units of a depth image a metre; 0: not said
  std::uint64_t memory_limit = std::uint64_t{2} << 30;  // bytes the points may take
  Progress progress = {};
};

// By content, not by extension alone. "-" is standard input.
Result<Scan> read_scan(const std::filesystem::path& file, const ReadOptions& options = {});
// The same from bytes already read; `name` is for messages and becomes Scan::file.
Result<Scan> read_scan_bytes(std::string_view bytes, const std::string& name,
                             const ReadOptions& options = {});

// The single formats, from bytes already read; `name` is for messages.
Result<Scan> read_pcd(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
// Ascii, little and big endian, elements in any order; the vertices become the points, `camera` the
// viewpoint.
Result<Scan> read_ply(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
// Rows of numbers between blanks, tabs, commas or semicolons, under a header row
// `x,y,z[,cxx,cxy,cxz,cyy,cyz,czz]` (more columns are kept out with a notice) or without one: then x, y and z
// are the first three columns.
Result<Scan> read_point_table(std::string_view bytes, const std::string& name,
                              const ReadOptions& options = {});
// The vertices of a mesh as points.
Result<Scan> read_obj(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
Result<Scan> read_off(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
Result<Scan> read_stl(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
// KITTI's x y z intensity, float32 without a header; nuScenes adds the number of the laser. The sensor is the
// origin, x forward.
Result<Scan> read_kitti(std::string_view bytes, const std::string& name, const ReadOptions& options = {});
// A grey picture of 16 bits, PNG or binary PGM: depths along the camera's z axis, 0 where there is none.
// usage error that names the flags where intrinsics or depth scale were not said.
Result<Scan> read_depth_image(std::string_view bytes, const std::string& name,
                              const ReadOptions& options = {});

// PCD binary of an organised or plain scan (x y z, label, rgb where present), VIEWPOINT written: read_pcd
// gives it back.
std::string write_pcd(const Scan& scan);

}  // namespace patchlab
