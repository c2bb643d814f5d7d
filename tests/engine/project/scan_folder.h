// A folder of its own for each test, with a scan in it.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "engine/project/command.h"

namespace patchlab {

class ScanFolder : public testing::Test {
 protected:
  ScanFolder();
  ~ScanFolder() override;

  std::filesystem::path at(const std::string& file) const { return folder_ / file; }
  std::string text(const std::string& file) const;
  void write(const std::string& file, const std::string& text) const;

  // boxes.pcd: two level plates one metre below the sensor's origin at labels 7 and 8, and a point that is
  // not finite.
  ApplyOptions here() const { return {.folder = folder_, .on = {}, .progress = {}}; }
  static OpenScan open_boxes() { return {.id = "scan-1", .file = "boxes.pcd", .noise = "isotropic:0.001"}; }
  static Select select_label(const std::string& region, std::uint32_t label);
  // A lasso that holds the plate of label 7 and nothing else.
  static Select lasso_left(const std::string& region);
  static Fit fit_plane(const std::string& patch, const std::string& region);

  // The document after these commands; a failure of the test where one is refused.
  Document after(std::vector<Command> commands) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace patchlab
