#include "engine/export/export.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/base/file.h"
#include "tests/engine/export/consumer.h"
#include "tests/engine/io/sample_set.h"

namespace patchlab {
namespace {

using testing::Contains;
using testing::HasSubstr;

TEST(Export, ListsItsFormatsForAnUnknownName) {
  const Result<const ExportFormat*> format = export_format("dance");
  ASSERT_FALSE(format);
  EXPECT_EQ(format.error().code, ErrorCode::usage);
  for (const ExportFormat& known : export_formats()) {
    EXPECT_THAT(format.error().message, HasSubstr(std::string(known.name)));
    EXPECT_EQ((*export_format(known.name))->name, known.name);
  }
}

TEST(Export, WritesThePatchSetAsItIsWritten) {
  EXPECT_EQ(test::exported_bytes("patch_set", test::sample_set()), *write_patch_set(test::sample_set()));
}

TEST(Export, WritesThePatchesAskedForOnly) {
  const PatchSet set = test::sample_set();
  const std::vector<std::string> ids = {set.patches[4].id, set.patches[2].id};
  const Result<PatchSet> read =
      read_patch_set(test::exported_bytes("patch_set", set, {.patches = ids}), "chosen");
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_EQ(read->patches.size(), 2u);
  EXPECT_EQ(read->patches[0].id, ids[1]);
  EXPECT_EQ(read->patches[1].id, ids[0]);
}

TEST(Export, RefusesAnIdThatTheSetDoesNotHold) {
  const Result<Exported> exported =
      export_patches(**export_format("ply"), test::designed_set(), {.patches = {"dance"}});
  ASSERT_FALSE(exported);
  EXPECT_EQ(exported.error().code, ErrorCode::usage);
  EXPECT_THAT(exported.error().message, HasSubstr("left_sole"));
}

TEST(Export, RefusesAPatchThatIsNotValidByNameInEveryFormat) {
  PatchSet set = test::designed_set();
  set.patches[0].patch.parameters[0] = -0.1;
  for (const ExportFormat& format : export_formats()) {
    const Result<Exported> exported = export_patches(format, set);
    ASSERT_FALSE(exported) << format.name;
    EXPECT_EQ(exported.error().code, ErrorCode::refused);
    EXPECT_THAT(exported.error().message, HasSubstr("patch \"left_sole\""));
  }
}

TEST(Export, RefusesOptionsThatMeanNothing) {
  const ExportFormat& format = **export_format("ply");
  for (const ExportOptions& options :
       {ExportOptions{.thickness = 0.0}, ExportOptions{.thickness = NAN}, ExportOptions{.inset_sigmas = -1.0},
        ExportOptions{.foot_radius = INFINITY}, ExportOptions{.up = Vector3d::Zero()},
        ExportOptions{.tilt_limit = 4.0}}) {
    const Result<Exported> exported = export_patches(format, test::designed_set(), options);
    ASSERT_FALSE(exported);
    EXPECT_EQ(exported.error().code, ErrorCode::usage);
  }
}

TEST(Export, PreviewSaysWhatWouldBeWritten) {
  const ExportPreview preview =
      preview_export(**export_format("ply"), test::sample_set(), {.patches = {"sphere_convex"}});
  EXPECT_THAT(preview.patches, testing::ElementsAre("sphere_convex"));
  EXPECT_THAT(preview.lines, Contains(HasSubstr("kB")));
  EXPECT_THAT(preview.lines, Contains(HasSubstr("covariance: ")));
  EXPECT_EQ(preview.refusal, "");
}

TEST(Export, PreviewSaysWhyItWouldBeRefused) {
  PatchSet set = test::designed_set();
  set.patches[0].patch.parameters[0] = -0.1;
  EXPECT_THAT(preview_export(**export_format("stl"), set).refusal, HasSubstr("left_sole"));
}

TEST(WriteExported, MakesAWholeFolder) {
  const test::Folder folder;
  const Exported exported{{{"a.txt", "one"}, {"meshes/b.txt", "two"}}, {}};
  const Result<void> written = write_exported(exported, folder.at("world"));
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_EQ(as_text(*read_file(folder.at("world/a.txt"))), "one");
  EXPECT_EQ(as_text(*read_file(folder.at("world/meshes/b.txt"))), "two");
}

TEST(WriteExported, LeavesAFolderThatIsThereAlone) {
  const test::Folder folder;
  const Exported exported{{{"a.txt", "one"}, {"b.txt", "two"}}, {}};
  ASSERT_TRUE(write_exported(exported, folder.at("world/")));
  const Result<void> again = write_exported({{{"a.txt", "three"}, {"c.txt", ""}}, {}}, folder.at("world"));
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, ErrorCode::unwritable);
  EXPECT_EQ(as_text(*read_file(folder.at("world/a.txt"))), "one");
  EXPECT_FALSE(std::filesystem::exists(folder.at("world/c.txt")));
}

TEST(WriteExported, LeavesNothingWhereAFileCannotBeWritten) {
  const test::Folder folder;
  const Exported exported{{{"a.txt", "one"}, {"a.txt/b.txt", "two"}}, {}};
  EXPECT_FALSE(write_exported(exported, folder.at("world")));
  EXPECT_TRUE(std::filesystem::is_empty(folder.at("")));
}

TEST(WriteExported, RefusesAFolderOnStandardOutput) {
  const Result<void> written = write_exported({{{"a.txt", "one"}, {"b.txt", "two"}}, {}}, "-");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::usage);
}

}  // namespace
}  // namespace patchlab
