#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "engine/project/command.h"
#include "engine/project/session.h"

namespace patchlab {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::filesystem::path kContract = PATCHLAB_SOURCE_DIR "/../shared/contracts/journal.jsonl";

json plain(const Command& command) { return json::parse(to_json(command).dump()); }

std::string refusal(const std::string& line) {
  const Result<Command> command = command_from_json(json::parse(line));
  return command ? "accepted" : command.error().message;
}

TEST(CommandJson, ReadsAndWritesTheContractsJournalMemberForMember) {
  if (!std::filesystem::exists(kContract)) GTEST_SKIP() << "no contracts beside this checkout";
  std::ifstream file(kContract);
  std::string line;
  std::getline(file, line);
  int lines = 0;
  for (; std::getline(file, line); ++lines) {
    const Result<Command> command = command_from_json(json::parse(line));
    ASSERT_TRUE(command.ok()) << command.error().message;
    EXPECT_EQ(plain(*command), json::parse(line));
  }
  EXPECT_EQ(lines, 6);
}

TEST(CommandJson, BeginsWithWhatItDoes) {
  EXPECT_EQ(to_json(Undo{}).dump(), R"({"do":"undo"})");
  EXPECT_EQ(to_json(Rename{"patch-1", "mug side"}).dump(),
            R"({"do":"rename","target":"patch-1","name":"mug side"})");
  EXPECT_EQ(to_json(SetColour{"region-1", Colour{230, 159, 0}}).dump(),
            R"({"do":"set_colour","target":"region-1","colour":"#e69f00"})");
  EXPECT_EQ(to_json(SetColour{"region-1", std::nullopt}).dump(),
            R"({"do":"set_colour","target":"region-1"})");
}

TEST(CommandJson, KeepsEveryMemberThereAndBack) {
  OpenScan open{"scan-2", "a/b.pcd", "ab12", "isotropic:0.002", true, Eigen::Vector3d(1, 2, 0.1)};
  open.unit = LengthUnit::mm;
  open.intrinsics = Intrinsics{.fx = 585, .fy = 586, .cx = 320, .cy = 240};
  open.depth_scale = 5000;
  Select lasso{.region = "region-3", .scan = "scan-2", .mode = SelectMode::intersect};
  lasso.polygon = {{0.1, 1.0 / 3.0}, {1e-300, 7.0}, {-12.5, 3.25}};
  lasso.camera.perspective = false;
  lasso.camera.height = 0.3;
  lasso.camera.near_plane = 0.0;
  lasso.camera.far_plane = 2.5;
  lasso.camera.viewport = {640, 480};
  Select label{.region = "region-4", .scan = "scan-2", .mode = SelectMode::add};
  label.label = 50;
  Select indices{.region = "region-5", .scan = "scan-2", .mode = SelectMode::subtract};
  indices.indices = std::vector<std::uint32_t>{4, 7, 4294967295u};
  Select flood{.region = "region-6", .scan = "scan-2"};
  flood.flood = Eigen::Vector3d(0.1, -2.0, 1.0 / 3.0);
  Fit fit{"patch-1", "region-3", {}, "00ff"};
  fit.options.surface = SurfaceRequest::plane;
  fit.options.boundary = BoundaryRequest::convex_quad;
  fit.options.method = FitMethod::paper;
  fit.options.bounds = BoundsMethod::extent;
  fit.options.containment = 0.95;
  fit.options.robust = true;
  fit.options.seed = 18446744073709551615u;
  fit.options.limits.coverage = 0.5;
  Place place{"body", "world", {}};
  place.pose.pose = {{0.1, -0.2, 1.0 / 3.0}, {1e-300, 2.0, 3.0}};
  place.pose.covariance.diagonal().setConstant(0.1);
  const std::vector<Command> commands = {
      open,
      OpenMap{"map-1", "a.json", "ab12"},
      OpenRobot{"robot-1", "w.urdf", "ab", "w.json", "cd", "p.json", "ef"},
      SetJoint{"robot-1", "left_knee", 1.0 / 3.0, 0.002},
      SetJoint{"robot-1", "left_knee", -0.1, {}},
      place,
      Merge{"map-1", "scan-2", 0.9, {{"a", "b"}, {"c", "d"}}, "2026-11-23T14:02:11Z"},
      SetNoise{"scan-2", "kinect1"},
      lasso,
      label,
      indices,
      flood,
      Reshape{"region-3", Reshaping::shrink, 4},
      Reshape{"region-3", Reshaping::linked},
      fit,
      Rename{"patch-1", "φ"},
      Delete{"region-4"},
      Show{"patch-1", false},
      Undo{},
      Redo{}};
  for (const Command& command : commands) {
    const Result<Command> back = command_from_json(plain(command));
    ASSERT_TRUE(back.ok()) << back.error().message;
    EXPECT_EQ(back->index(), command.index());
    EXPECT_EQ(to_json(*back).dump(), to_json(command).dump());
  }
}

TEST(CommandJson, LeavesDefaultsOut) {
  const std::string line = to_json(Fit{"patch-1", "region-1", {}, ""}).dump();
  for (const char* absent : {"bounds", "containment", "seed", "limits", "result_sha256"}) {
    EXPECT_THAT(line, testing::Not(HasSubstr(absent)));
  }
}

struct Refused {
  const char* line;
  const char* says;
};

const char* const kLassoHead =
    R"({"do":"select","region":"r","scan":"s","polygon":[[0,0],[9,0],[0,9]],"camera":{"position":[0,0,0],)";

TEST(CommandJson, NamesTheMemberThatIsWrong) {
  const std::vector<Refused> cases = {
      {R"([1])", "journal: the command is an array where an object is expected."},
      {R"({})", "the command lacks the member \"do\""},
      {R"({"do":7})", "the command.do is 7 where a string is expected"},
      {R"({"do":"dance"})", "the command.do 'dance' is not known"},
      {R"({"do":"undo","times":2})", "undo has the unknown member \"times\""},
      {R"({"do":"rename","target":"x"})", "rename lacks the member \"name\""},
      {R"({"do":"set_colour","target":"x","colour":"red"})",
       "set_colour.colour is no colour such as #e69f00"},
      {R"({"do":"set_colour","target":"x","colour":"#12345g"})",
       "set_colour.colour is no colour such as #e69f00"},
      {R"({"do":"set_colour","target":"x","colour":"#-12345"})",
       "set_colour.colour is no colour such as #e69f00"},
      {R"({"do":"open_scan","id":"scan-1","file":"a.pcd","unit":"ft"})", "open_scan.unit 'ft' is not known"},
      {R"({"do":"open_scan","id":"scan-1","file":"a.png","intrinsics":[0,1,2,3]})",
       "open_scan.intrinsics has a focal length that is not positive"},
      {R"({"do":"open_scan","id":"scan-1","file":"a.png","depth_scale":0})",
       "open_scan.depth_scale must be positive"},
      {R"({"do":"open_scan","id":"scan-1","file":"a.pcd","viewpoint":[0,1]})",
       "open_scan.viewpoint has 2 entries"},
      {R"({"do":"select","region":"r","scan":"s"})",
       "select needs one of the members polygon, flood, label and indices"},
      {R"({"do":"select","region":"r","scan":"s","label":3,"indices":[1]})",
       "select needs one of the members"},
      {R"({"do":"select","region":"r","scan":"s","label":3,"flood":[0,0,1]})",
       "select needs one of the members"},
      {R"({"do":"set_joint","robot":"r","joint":"j","value":0,"sigma":-1})", "sigma must not be negative"},
      {R"({"do":"place","frame":"a","in":"b","r":[0,0,0],"t":[0,0]})", "place.t has 2 entries"},
      {R"({"do":"merge","map":"m","view":"s","gate":1})", "merge.gate must be between 0 and 1"},
      {R"({"do":"merge","map":"m","view":"s","refused":[["a"]]})", "must be two ids"},
      {R"({"do":"reshape","region":"r"})", "reshape lacks the member \"how\""},
      {R"({"do":"reshape","region":"r","how":"melt"})", "reshape.how 'melt' is not known"},
      {R"({"do":"reshape","region":"r","how":"grow","steps":0})", "reshape.steps must be at least 1"},
      {R"({"do":"select","region":"r","scan":"s","label":-3})", "select.label is -3 where a whole number"},
      {R"({"do":"select","region":"r","scan":"s","indices":[1,2.5]})",
       "select.indices[1] is 2.5 where a whole"},
      {R"({"do":"select","region":"r","scan":"s","indices":[4294967296]})",
       "select.indices[0] is 4294967296 where a"},
      {R"({"do":"select","region":"r","scan":"s","label":1,"mode":"xor"})", "select.mode 'xor' is not known"},
      {R"({"do":"select","region":"r","scan":"s","polygon":[[0,0],[1,"x"],[2,2]]})",
       "select.polygon[1][1] is \"x\" where a number is expected"},
      {R"({"do":"select","region":"r","scan":"s","polygon":[[0,0],[1,1]]})",
       "select.polygon must have three vertices"},
      {R"({"do":"fit","patch":"p","region":"r","options":{"surface":"cone"}})",
       "fit.options.surface 'cone' is not known"},
      {R"({"do":"fit","patch":"p","region":"r","options":{"limits":{"coverage":"all"}}})",
       "fit.options.limits.coverage is \"all\" where a number is expected"},
      {R"({"do":"fit","patch":"p","region":"r","options":{"sigma":1}})",
       "fit.options has the unknown member \"sigma\""},
      {R"({"do":"show","target":"p","visible":1})", "show.visible is 1 where true or false"},
  };
  for (const auto& [line, says] : cases) EXPECT_THAT(refusal(line), HasSubstr(says)) << line;
}

TEST(CommandJson, RefusesACameraThatSeesNothing) {
  const std::vector<Refused> rests = {
      {R"("quaternion_xyzw":[0,0,0,1],"near":0.01,"viewport":[100,100]}})",
       "select.camera lacks the member \"fov_y\""},
      {R"("quaternion_xyzw":[0,0,0,1],"fov_y":0.8,"near":-1,"viewport":[100,100]}})",
       "must not have a negative near"},
      {R"("quaternion_xyzw":[0,0,0,1],"fov_y":0.8,"near":1,"far":1,"viewport":[100,100]}})",
       "must have a far beyond its near"},
      {R"("quaternion_xyzw":[0,0,0,1],"fov_y":4,"near":0,"viewport":[100,100]}})",
       "must have a fov_y between 0 and pi"},
      {R"("quaternion_xyzw":[0,0,0,0],"fov_y":0.8,"near":0,"viewport":[9,9]}})",
       "quaternion_xyzw of length 1"},
      {R"("quaternion_xyzw":[0,0,0,1],"fov_y":0.8,"near":0,"viewport":[0,100]}})",
       "camera.viewport must be two whole"},
      {R"("quaternion_xyzw":[0,0,0,1],"fov_y":0.8,"near":0,"viewport":[1e300,1]}})",
       "camera.viewport must be two whole"},
      {R"("quaternion_xyzw":[0,0,0,1],"near":0,"viewport":[1,1],"projection":"fisheye"}})",
       "'fisheye' is not known"},
      {R"("quaternion_xyzw":[0,0,0,1],"near":0,"viewport":[1,1],"projection":"orthographic"}})",
       "select.camera lacks the member \"height\""},
  };
  for (const auto& [rest, says] : rests) {
    EXPECT_THAT(refusal(std::string(kLassoHead) + rest), HasSubstr(says)) << rest;
  }
}

TEST(ReadJournal, ReadsTheContractsJournal) {
  if (!std::filesystem::exists(kContract)) GTEST_SKIP() << "no contracts beside this checkout";
  std::ifstream file(kContract);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const Result<std::vector<Command>> commands = read_journal(text, "journal.jsonl");
  ASSERT_TRUE(commands.ok()) << commands.error().message;
  EXPECT_EQ(commands->size(), 6u);
  EXPECT_TRUE(std::holds_alternative<Redo>(commands->back()));
}

TEST(ReadJournal, NamesABadLineByItsNumber) {
  const std::string head = journal_header() + "\n";
  const auto refused = [&](const std::string& text) {
    const auto commands = read_journal(text, "w.patchlab");
    return commands ? "accepted" : commands.error().message;
  };
  EXPECT_THAT(refused(head + "{\"do\":\"undo\"}\n{\"do\":\n{\"do\":\"redo\"}\n"),
              HasSubstr("w.patchlab: line 3: is not JSON"));
  EXPECT_THAT(refused(head + "{\"do\":\"dance\"}\n"),
              HasSubstr("w.patchlab: line 2: the command.do 'dance'"));
  EXPECT_THAT(refused(head + "{\"do\":\"dance\"}"), HasSubstr("line 2")) << "a whole object is not torn";
  EXPECT_THAT(refused(head + "\n{\"do\":\"undo\"}\n"), HasSubstr("line 2"));
}

TEST(ReadJournal, DropsATornLastLineAndKeepsAWholeOneWithoutNewline) {
  const std::string head = journal_header() + "\n{\"do\":\"undo\"}\n";
  EXPECT_EQ(read_journal(head + "{\"do\":\"re", "w")->size(), 1u);
  EXPECT_EQ(read_journal(head + std::string(64, '\0'), "w")->size(), 1u) << "a block that was never written";
  EXPECT_EQ(read_journal(head + "{\"do\":\"redo\"}", "w")->size(), 2u);
}

TEST(ReadJournal, RefusesOtherFilesAndNewerVersions) {
  const auto refused = [](const std::string& text) { return read_journal(text, "w").error().message; };
  EXPECT_THAT(refused("x,y,z\n0,0,0\n"), HasSubstr("not a patchlab journal"));
  EXPECT_THAT(refused("{}\n"), HasSubstr("not a patchlab journal"));
  EXPECT_THAT(refused("{\"format\":\"patchlab.patch_set\",\"version\":1}\n"),
              HasSubstr("not a patchlab journal"));
  EXPECT_THAT(refused("{\"format\":\"patchlab.journal\"}\n"), HasSubstr("not a patchlab journal"));
  EXPECT_THAT(refused("{\"format\":\"patchlab.journal\",\"version\":2}\n"), HasSubstr("version 2"));
}

}  // namespace
}  // namespace patchlab
