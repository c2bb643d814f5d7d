// The program as it is run: exit statuses, messages, pictures, and that it leaves files alone that it only
// shows.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "tests/viewer/app/ball_scan.h"
#include "viewer/app/journal_file.h"

namespace patchlab::viewer {
namespace {

struct Ran {
  int status = -1;
  std::string errors;
};

class CommandTest : public testing::Test {
 protected:
  Ran run(const std::string& arguments) const {
    const std::filesystem::path log = folder_.path() / "stderr";
    const std::string line = "XDG_STATE_HOME='" + (folder_.path() / "state").string() +
                             "' '" PATCHLAB_VIEWER "' " + arguments + " > /dev/null 2> '" + log.string() +
                             "'";
    const int status = std::system(line.c_str());
    std::ostringstream errors;
    errors << std::ifstream(log).rdbuf();
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, errors.str()};
  }
  std::string text(const std::string& name) const {
    const Result<Bytes> bytes = read_file(folder_.path() / name);
    return bytes ? std::string(as_text(*bytes)) : std::string();
  }
  std::string path(const std::string& name) const { return "'" + (folder_.path() / name).string() + "' "; }
  // A journal with one kept sphere, made by the program itself.
  void make_journal() const {
    std::ofstream log(folder_.path() / "log");
    log << "key L\ndrag ";
    for (int i = 0; i < 30; ++i) {
      log << 663 + 45 * std::cos(0.2 * i) << " " << 473 + 45 * std::sin(0.2 * i) << " ";
    }
    log << "\nwait\nkey 3\nwait\nkey Enter\nwait\n";
    log.close();
    (void)folder_.ball();
    const Ran ran = run("--headless " + path("ball.pcd") + "--replay " + path("log"));
    ASSERT_EQ(ran.status, 0) << ran.errors;
    for (const auto& file : std::filesystem::directory_iterator(folder_.path() / "state" / "patchlab")) {
      ASSERT_TRUE(copy_journal(file.path(), folder_.path() / "ball.patchlab"));
    }
  }

  TestFolder folder_;
};

TEST_F(CommandTest, NothingIsWrittenWhereNobodyAsked) {
  const std::filesystem::path home = folder_.path() / "home", here = folder_.path() / "here";
  std::filesystem::create_directories(home);
  std::filesystem::create_directories(here);
  (void)folder_.ball();
  const std::string line = "cd '" + here.string() + "' && env -u XDG_STATE_HOME -u XDG_CONFIG_HOME HOME='" +
                           home.string() + "' '" PATCHLAB_VIEWER "' --headless " + path("ball.pcd") +
                           "--screenshot " + path("ball.png") + "> /dev/null 2>&1";
  EXPECT_EQ(std::system(line.c_str()), 0);
  EXPECT_TRUE(std::filesystem::exists(folder_.path() / "ball.png"));
  EXPECT_TRUE(std::filesystem::is_empty(here));
  EXPECT_TRUE(std::filesystem::is_empty(home));
}

TEST_F(CommandTest, WrongUsageIsTwo) {
  EXPECT_EQ(run("--size huge").status, 2);
  EXPECT_EQ(run("--version").status, 0);
}

TEST_F(CommandTest, AScanThatCannotBeReadIsThreeAndNamed) {
  const Ran ran = run("--headless " + path("missing.pcd"));
  EXPECT_EQ(ran.status, 3);
  EXPECT_NE(ran.errors.find("missing.pcd"), std::string::npos) << ran.errors;
}

TEST_F(CommandTest, APictureThatCannotBeWrittenIsFour) {
  EXPECT_EQ(run("--headless --screenshot " + path("no/such/folder.png")).status, 4);
}

TEST_F(CommandTest, ALogThatNamesNoWidgetIsThree) {
  std::ofstream(folder_.path() / "log") << "click tools/Teapot\n";
  const Ran ran = run("--headless --replay " + path("log"));
  EXPECT_EQ(ran.status, 3);
  EXPECT_NE(ran.errors.find("tools/Teapot"), std::string::npos) << ran.errors;
}

TEST_F(CommandTest, AJournalIsShownExportedAndLeftAsItIs) {
  make_journal();
  const std::string before = text("ball.patchlab");
  const Ran ran = run("--headless " + path("ball.patchlab") + "--screenshot " + path("a.png") +
                      "--export patch_set=" + path("set.json") + "--export ply=" + path("mesh.ply"));
  EXPECT_EQ(ran.status, 0) << ran.errors;
  EXPECT_EQ(text("a.png").substr(1, 3), "PNG");
  EXPECT_NE(text("set.json").find("\"sphere\""), std::string::npos);
  EXPECT_EQ(text("mesh.ply").substr(0, 3), "ply");
  EXPECT_EQ(text("ball.patchlab"), before);
}

TEST_F(CommandTest, TheSamePictureIsDrawnTwice) {
  make_journal();
  for (const char* name : {"a.png", "b.png"}) {
    ASSERT_EQ(
        run("--headless --theme light --scale 1.5 " + path("ball.patchlab") + "--screenshot " + path(name))
            .status,
        0);
  }
  EXPECT_EQ(text("a.png"), text("b.png"));
}

TEST_F(CommandTest, TheSampleIsDrawn) {
  const std::filesystem::path sample =
      std::filesystem::path(PATCHLAB_SOURCE_DIR) / "assets" / "sample.patchlab";
  const Ran ran = run("--headless '" + sample.string() + "' --screenshot " + path("sample.png"));
  EXPECT_EQ(ran.status, 0) << ran.errors;
  EXPECT_GT(text("sample.png").size(), 100'000u);
}

}  // namespace
}  // namespace patchlab::viewer
