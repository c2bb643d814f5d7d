#include "engine/base/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

namespace patchlab {
namespace {

using testing::HasSubstr;

class FileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = testing::TempDir() + "patchlab_file_XXXXXX";
    folder_ = ::mkdtemp(pattern.data());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string contents(const std::string& name) const {
    const Result<Bytes> bytes = read_file(folder_ / name);
    return bytes ? std::string(as_text(*bytes)) : bytes.error().message;
  }
  std::size_t files_here() const {
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder_), std::filesystem::directory_iterator()));
  }
  std::filesystem::path folder_;
};

TEST_F(FileTest, WhatIsWrittenIsReadBackToTheByte) {
  const std::string bytes("a\0b\r\n\xFF", 6);
  ASSERT_TRUE(write_file(folder_ / "file", bytes));
  EXPECT_EQ(contents("file"), bytes);
  ASSERT_TRUE(write_file(folder_ / "file", "shorter"));
  EXPECT_EQ(contents("file"), "shorter");
  EXPECT_EQ(files_here(), 1U) << "a temporary file is left";
}

TEST_F(FileTest, NewFilesHaveTheRightsTheMaskAllows) {
  const mode_t mask = ::umask(027);
  const bool written = write_file(folder_ / "file", "x").ok();
  ::umask(mask);
  ASSERT_TRUE(written);
  EXPECT_EQ(std::filesystem::status(folder_ / "file").permissions(),
            static_cast<std::filesystem::perms>(0640));
}

TEST_F(FileTest, FailedWriteLeavesTheOldFileAsItWas) {
  const std::filesystem::path missing = folder_ / "no" / "file";
  const Result<void> into_missing = write_file(missing, "x");
  ASSERT_FALSE(into_missing);
  EXPECT_EQ(into_missing.error().code, ErrorCode::unwritable);
  EXPECT_THAT(into_missing.error().message, HasSubstr(missing.string()));

  std::filesystem::create_directory(folder_ / "folder");
  const Result<void> onto_folder = write_file(folder_ / "folder", "x");
  ASSERT_FALSE(onto_folder);
  EXPECT_EQ(onto_folder.error().code, ErrorCode::unwritable);
  EXPECT_EQ(files_here(), 1U);
}

TEST_F(FileTest, FullDeviceIsReported) {
  const Result<void> written = write_file("/dev/full", "x");
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().code, ErrorCode::unwritable);
  EXPECT_THAT(written.error().message, HasSubstr("/dev/full"));
}

TEST_F(FileTest, DevicesAndPipesAreWrittenToAndStayWhatTheyAre) {
  ASSERT_TRUE(write_file("/dev/null", "x"));
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));

  const std::filesystem::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { std::ifstream(pipe) >> received; });
  const bool written = write_file(pipe, "hello").ok();
  reader.join();
  EXPECT_TRUE(written);
  EXPECT_EQ(received, "hello");
  EXPECT_TRUE(std::filesystem::is_fifo(pipe));
}

TEST_F(FileTest, LinksKeepPointingWhereTheyDid) {
  ASSERT_TRUE(write_file(folder_ / "target", "old"));
  std::filesystem::create_symlink("target", folder_ / "link");
  ASSERT_TRUE(write_file(folder_ / "link", "new"));
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link"));
  EXPECT_EQ(contents("target"), "new");
}

TEST_F(FileTest, OnlyRegularFilesWithSomethingInThemAreRead) {
  ASSERT_EQ(::mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  std::ofstream(folder_ / "empty").flush();
  std::filesystem::create_symlink("loop", folder_ / "loop");
  EXPECT_THAT(contents("pipe"), HasSubstr("pipe: is not a regular file"));
  EXPECT_THAT(contents("empty"), HasSubstr("is empty"));
  EXPECT_THAT(contents("loop"), HasSubstr("cannot be opened"));
  EXPECT_THAT(contents("missing"), HasSubstr("cannot be opened"));
  EXPECT_THAT(contents("."), HasSubstr("is a folder"));
}

TEST_F(FileTest, FilesLargerThanTheLimitAreNotRead) {
  ASSERT_TRUE(write_file(folder_ / "file", "12345"));
  EXPECT_TRUE(read_file(folder_ / "file", 5));
  const Result<Bytes> bytes = read_file(folder_ / "file", 4);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().code, ErrorCode::unreadable);
  EXPECT_THAT(bytes.error().message, HasSubstr("limit"));
}

// Standard input replaced by a file for the length of a test.
class StandardInput {
 public:
  explicit StandardInput(const std::filesystem::path& file) : saved_(::dup(STDIN_FILENO)) {
    const int opened = ::open(file.c_str(), O_RDONLY);
    ::dup2(opened, STDIN_FILENO);
    ::close(opened);
  }
  ~StandardInput() {
    ::dup2(saved_, STDIN_FILENO);
    ::close(saved_);
  }
  StandardInput(const StandardInput&) = delete;
  StandardInput& operator=(const StandardInput&) = delete;

 private:
  int saved_;
};

TEST_F(FileTest, DashIsStandardInput) {
  const std::string long_text(300000, 'a');
  ASSERT_TRUE(write_file(folder_ / "file", long_text));
  {
    const StandardInput redirected(folder_ / "file");
    const Result<Bytes> bytes = read_file("-");
    ASSERT_TRUE(bytes);
    EXPECT_EQ(as_text(*bytes), long_text);
  }
  const StandardInput redirected(folder_ / "file");
  EXPECT_FALSE(read_file("-", 1000));
}

TEST(Sha256, IsTheStandardOne) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace patchlab
