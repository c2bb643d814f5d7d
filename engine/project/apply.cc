#include <algorithm>
#include <bit>
#include <cmath>
#include <iterator>

#include "engine/base/file.h"
#include "engine/base/progress_share.h"
#include "engine/fit/fit_patch.h"
#include "engine/io/read_scan.h"
#include "engine/project/command.h"
#include "engine/project/map_commands.h"
#include "engine/region/grow.h"
#include "engine/region/observe.h"

namespace patchlab {
namespace {

namespace fs = std::filesystem;
using Ids = std::vector<std::uint32_t>;

Error wrong(std::string message) { return {ErrorCode::usage, std::move(message)}; }
Error unknown(const std::string& what, const std::string& id) {
  return wrong("There is no " + what + " '" + id + "'.");
}

template <class Entry>
Entry* find(std::vector<Entry>& entries, const std::string& id) {
  const auto found = std::ranges::find(entries, id, &Entry::id);
  return found == entries.end() ? nullptr : &*found;
}

template <class Entry>
Entry& find_or_add(std::vector<Entry>& entries, const std::string& id) {
  if (Entry* entry = find(entries, id)) return *entry;
  Entry& entry = entries.emplace_back();
  entry.id = entry.name = id;
  return entry;
}

Error taken(const std::string& id) { return wrong("The id '" + id + "' is taken already."); }

Result<Scan> read(OpenScan& open, const ApplyOptions& options) {
  const fs::path file = options.on         ? *options.on
                        : open.file == "-" ? fs::path("-")
                                           : options.folder / open.file;
  constexpr double share_of_file = 0.5;
  const Result<Bytes> bytes =
      read_file(file, default_file_limit, share_of(options.progress, 0.0, share_of_file));
  if (!bytes) return bytes.error();
  const std::string hash = sha256(as_text(*bytes));
  if (!options.on && !open.sha256.empty() && open.sha256 != hash) {
    return Error{ErrorCode::refused, file.string() + ": is not the file that was recorded: its sha256 is " +
                                         hash + ", the recorded one " + open.sha256 +
                                         "; restore it, or replay with --on " + file.string() + "."};
  }
  const ReadOptions how{.points_in_sensor_frame = open.points_in_sensor_frame,
                        .unit = open.unit,
                        .intrinsics = open.intrinsics,
                        .depth_scale = open.depth_scale,
                        .progress = share_of(options.progress, share_of_file, 1.0)};
  Result<Scan> scan = read_scan_bytes(as_text(*bytes), file == "-" ? "standard input" : file.string(), how);
  if (!scan) return scan;
  open.sha256 = hash;
  if (!options.on) scan->file = open.file;
  if (open.viewpoint) {
    scan->viewpoint.position = *open.viewpoint;
    scan->viewpoint.stated = true;
    scan->viewpoints.clear();
  }
  return scan;
}

Result<NoiseModel> noise_for(const Scan& scan, const std::string& specification) {
  if (specification.empty()) return default_noise_model(scan);
  Result<NoiseModel> model = noise_model(specification);
  if (model && model->from_file() && scan.covariances.empty()) {
    return wrong(scan.file + ": holds no covariances for the noise model from_file; name a sensor model.");
  }
  return model;
}

Result<void> run(OpenScan& open, Document& document, const ApplyOptions& options) {
  if (open.id.empty()) open.id = free_id(document, "scan");
  if (is_taken(document, open.id)) return taken(open.id);
  if (options.on && !document.scans.empty()) {
    return wrong("Another scan can stand in for one scan only, and this is the second.");
  }
  Result<Scan> scan = read(open, options);
  if (!scan) return scan.error();
  const Result<NoiseModel> noise = noise_for(*scan, open.noise);
  if (!noise) return noise.error();
  const std::string name = fs::path(scan->file).filename().string();
  document.scans.push_back(
      {open.id, name, open.sha256, std::make_shared<const Scan>(std::move(*scan)), *noise, true});
  return {};
}

Result<Ids> with_label(const ScanEntry& entry, std::uint32_t label) {
  const Scan& scan = *entry.scan;
  if (scan.labels.empty()) return wrong(scan.file + ": has no labels; draw a lasso or name a region file.");
  Ids ids;
  for (std::uint32_t i = 0; i < scan.size(); ++i) {
    if (scan.finite[i] && scan.labels[i] == label) ids.push_back(i);
  }
  if (!ids.empty()) return ids;
  return Error{ErrorCode::no_finite_fit,
               scan.file + ": no finite point has the label " + std::to_string(label) + "."};
}

Result<Ids> with_indices(const ScanEntry& entry, Ids ids) {
  std::ranges::sort(ids);
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  if (ids.empty() || ids.back() < entry.scan->size()) return ids;
  return Error{ErrorCode::unreadable, "The region names point " + std::to_string(ids.back()) +
                                          " (counted from 0), but " + entry.scan->file + " has only " +
                                          std::to_string(entry.scan->size()) + " points."};
}

// How far the noise spreads a surface: six standard deviations of a typical point in its worst direction, m.
double thickness(const ScanEntry& entry) {
  constexpr std::size_t most_asked = 200;
  const Scan& scan = *entry.scan;
  const bool stored = entry.noise.from_file();
  std::vector<double> variances;
  for (std::size_t i = 0; i < scan.size(); i += 1 + scan.size() / most_asked) {
    if (!scan.finite[i]) continue;
    const auto c = stored ? scan.covariances[i] : Covariance6{};
    variances.push_back(stored ? c[0] + c[3] + c[5]
                               : covariance(entry.noise, scan.viewpoint, scan.point(i)).trace());
  }
  if (variances.empty()) return 0.0;
  const auto middle = variances.begin() + static_cast<std::ptrdiff_t>(variances.size() / 2);
  std::nth_element(variances.begin(), middle, variances.end());
  return std::isfinite(*middle) ? 6.0 * std::sqrt(std::max(*middle, 0.0)) : 0.0;
}

Ids seen_among(const ScanEntry& entry, const Select& select, const Ids& ids, const ApplyOptions& options) {
  const std::shared_ptr<VisibilityCache> cache =
      options.visibility ? options.visibility : std::make_shared<VisibilityCache>();
  const auto seen = cache->get(entry.scan, select.camera, thickness(entry));
  Ids kept;
  std::ranges::copy_if(ids, std::back_inserter(kept), [&seen](std::uint32_t id) { return (*seen)[id] != 0; });
  return kept;
}

// `hidden` becomes how many points a lasso on visible points left out.
Result<Ids> selected(const Select& select, const ScanEntry& entry, const ApplyOptions& options,
                     std::size_t& hidden) {
  if (select.label) return with_label(entry, *select.label);
  if (select.indices) return with_indices(entry, *select.indices);
  if (select.flood) return flood(*entry.scan, *select.flood, {}, options.progress);
  Ids inside = select_lasso(*entry.scan, select.camera, select.polygon);
  if (!select.visible_only) return inside;
  Ids seen = seen_among(entry, select, inside, options);
  hidden = inside.size() - seen.size();
  return seen;
}

Result<void> run(Select& select, Document& document, const ApplyOptions& options) {
  const ScanEntry* scan = find_scan(document, select.scan);
  if (scan == nullptr) return unknown("scan", select.scan);
  if (select.region.empty()) select.region = free_id(document, "region");
  const bool is_other = is_taken(document, select.region) && !find_region(document, select.region);
  if (is_other) return taken(select.region);
  std::size_t hidden = 0;
  Result<Ids> ids = selected(select, *scan, options, hidden);
  if (!ids) return ids.error();
  const RegionEntry* before = find_region(document, select.region);
  const bool changes = before != nullptr && select.mode != SelectMode::set;
  if (changes && before->scan != select.scan) {
    return wrong("The region '" + select.region + "' is of the scan '" + before->scan + "', not of '" +
                 select.scan + "'.");
  }
  if (before == nullptr && (select.mode == SelectMode::subtract || select.mode == SelectMode::intersect)) {
    return unknown("region", select.region);
  }
  if (changes) ids = combine(*before->points, *ids, select.mode);
  RegionEntry& region = find_or_add(document.regions, select.region);
  region.scan = select.scan;
  region.points = std::make_shared<const Ids>(std::move(*ids));
  region.hidden_left_out = hidden;
  return {};
}

Result<Ids> reshaped(const Reshape& reshape, const Scan& scan, const Ids& ids, const Progress& progress) {
  switch (reshape.how) {
    case Reshaping::invert:
      return invert(scan, ids);
    case Reshaping::grow:
      return grow(scan, ids, reshape.steps);
    case Reshaping::shrink:
      return shrink(scan, ids, reshape.steps);
    case Reshaping::linked:
      return linked(scan, ids, progress);
  }
  return ids;
}

Result<void> run(Reshape& reshape, Document& document, const ApplyOptions& options) {
  RegionEntry* region = find(document.regions, reshape.region);
  if (region == nullptr) return unknown("region", reshape.region);
  if (reshape.steps < 1) return wrong("A region is grown or shrunk by one ring of points or more.");
  Result<Ids> ids =
      reshaped(reshape, *find_scan(document, region->scan)->scan, *region->points, options.progress);
  if (!ids) return ids.error();
  region->points = std::make_shared<const Ids>(std::move(*ids));
  region->hidden_left_out = 0;
  return {};
}

// Fits `entry` to the points of its scan with these ids.
Result<void> fit_to(PatchEntry& entry, const ScanEntry& scan, const Ids& ids, const ApplyOptions& how) {
  Ids kept;
  const Result<Observations> observations = observe(*scan.scan, scan.noise, ids, &kept);
  if (!observations) return observations.error();
  Result<FitResult> fit = how.fit_from
                              ? refit_patch(*how.fit_from, *observations, entry.options, how.progress)
                              : fit_patch(*observations, entry.options, how.progress);
  if (!fit && fit.error().code == ErrorCode::no_finite_fit) {
    return Error{ErrorCode::no_finite_fit, scan.scan->file + ": " + fit.error().message};
  }
  if (!fit) return fit.error();
  entry.fit = std::make_shared<const FitResult>(std::move(*fit));
  entry.points = std::make_shared<const Ids>(std::move(kept));
  return {};
}

Result<void> run(Fit& fit, Document& document, const ApplyOptions& options) {
  const RegionEntry* region = find_region(document, fit.region);
  if (region == nullptr) return unknown("region", fit.region);
  if (fit.patch.empty()) fit.patch = free_id(document, "patch");
  if (is_taken(document, fit.patch) && !find_patch(document, fit.patch)) return taken(fit.patch);
  PatchEntry& patch = find_or_add(document.patches, fit.patch);
  patch.scan = region->scan;
  patch.region = region->id;
  patch.colour = region->colour;
  patch.options = fit.options;
  const Result<void> fitted = fit_to(patch, *find_scan(document, patch.scan), *region->points, options);
  if (!fitted) return fitted;
  const std::string hash = result_hash(*patch.fit);
  patch.differs_from_record = !options.on && !fit.result_sha256.empty() && fit.result_sha256 != hash;
  fit.result_sha256 = hash;
  return {};
}

Result<void> run(SetNoise& set, Document& document, const ApplyOptions& options) {
  ScanEntry* scan = find(document.scans, set.scan);
  if (scan == nullptr) return unknown("scan", set.scan);
  const Result<NoiseModel> noise = noise_for(*scan->scan, set.noise);
  if (!noise) return noise.error();
  scan->noise = *noise;
  for (PatchEntry& patch : document.patches) {
    if (patch.scan != scan->id) continue;
    const Ids ids = *patch.points;
    const Result<void> fitted = fit_to(patch, *scan, ids, options);
    if (!fitted) return fitted;
  }
  return {};
}

// Calls `change` with the entry of that id, whatever it is.
template <class Change>
Result<void> with_entry(Document& document, const std::string& id, Change change) {
  if (ScanEntry* scan = find(document.scans, id)) {
    change(*scan);
  } else if (RegionEntry* region = find(document.regions, id)) {
    change(*region);
  } else if (PatchEntry* patch = find(document.patches, id)) {
    change(*patch);
  } else if (MapEntry* map = find(document.maps, id)) {
    change(*map);
  } else if (RobotEntry* robot = find(document.robots, id)) {
    change(*robot);
  } else {
    return unknown("scan, region, patch, map or robot", id);
  }
  return {};
}

Result<void> run(Rename& rename, Document& document, const ApplyOptions&) {
  return with_entry(document, rename.target, [&](auto& entry) { entry.name = rename.name; });
}

Result<void> run(SetColour& set, Document& document, const ApplyOptions&) {
  const PatchEntry* patch = find_patch(document, set.target);
  const std::string of = patch ? patch->region : set.target;
  RegionEntry* region = find(document.regions, of);
  if (!region && !patch) return unknown("region or patch", set.target);
  if (region) region->colour = set.colour;
  for (PatchEntry& entry : document.patches)
    if (entry.region == of) entry.colour = set.colour;
  return {};
}

Result<void> run(Show& show, Document& document, const ApplyOptions&) {
  return with_entry(document, show.target, [&](auto& entry) { entry.visible = show.visible; });
}

Result<void> run(Delete& erase, Document& document, const ApplyOptions&) {
  const auto gone = [&](const auto& entry) { return entry.id == erase.target; };
  const auto of_gone_scan = [&](const auto& entry) { return entry.scan == erase.target || gone(entry); };
  const std::size_t erased = std::erase_if(document.scans, gone) +
                             std::erase_if(document.regions, of_gone_scan) +
                             std::erase_if(document.patches, of_gone_scan) +
                             std::erase_if(document.maps, gone) + std::erase_if(document.robots, gone);
  if (erased == 0) return unknown("scan, region, patch, map or robot", erase.target);
  return {};
}

Result<void> run(Undo&, Document&, const ApplyOptions&) {
  return wrong("Undo is a step in the history, not a change.");
}
Result<void> run(Redo&, Document&, const ApplyOptions&) {
  return wrong("Redo is a step in the history, not a change.");
}

void append_bits(std::string& bytes, const double* values, Eigen::Index count) {
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto bits = std::bit_cast<std::uint64_t>(values[i]);
    for (int shift = 0; shift < 64; shift += 8) bytes.push_back(static_cast<char>((bits >> shift) & 0xFF));
  }
}

}  // namespace

Result<Document> apply(const Document& before, Command& command, const ApplyOptions& options) {
  Document after = before;
  const Result<void> done = std::visit([&](auto& one) { return run(one, after, options); }, command);
  if (!done) return done.error();
  return after;
}

std::vector<std::string*> files_of(Command& command) {
  std::vector<std::string*> files;
  if (auto* scan = std::get_if<OpenScan>(&command)) files = {&scan->file};
  if (auto* map = std::get_if<OpenMap>(&command)) files = {&map->file};
  if (auto* robot = std::get_if<OpenRobot>(&command)) files = {&robot->file, &robot->joints, &robot->patches};
  std::erase_if(files, [](const std::string* file) { return file->empty(); });
  return files;
}

std::string result_hash(const FitResult& fit) {
  const Patch& patch = fit.patch;
  std::string bytes(name(patch.type->surface));
  bytes.append(" ").append(name(patch.type->boundary)).append(" ");
  append_bits(bytes, patch.parameters.data(), patch.parameters.size());
  if (patch.covariance) append_bits(bytes, patch.covariance->data(), patch.covariance->size());
  return sha256(bytes);
}

}  // namespace patchlab
