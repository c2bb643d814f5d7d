#include "engine/base/file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <thread>

#include "tests/support/seeded_random.h"

namespace patchlab::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A folder of the test's own that goes with it.
class File : public testing::Test {
 protected:
  File() : folder_(fs::path(testing::TempDir()) / (current_test_name() + std::to_string(::getpid()))) {
    fs::create_directories(folder_);
  }
  ~File() override { fs::remove_all(folder_); }

  fs::path with(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }
  static std::string text_of(const fs::path& file) {
    const Result<Bytes> bytes = read_file(file);
    return bytes ? std::string(as_text(*bytes)) : "error: " + bytes.error().message;
  }

  const fs::path folder_;
};

TEST_F(File, IsReadWhole) {
  std::string text(200000, 'x');
  text[100000] = '\0';
  EXPECT_EQ(text_of(with("a", text)), text);
}

TEST_F(File, IsRefusedBeyondTheLimit) {
  const fs::path file = with("a", "12345");
  EXPECT_TRUE(read_file(file, 5));
  const Result<Bytes> refused = read_file(file, 4);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unreadable);
  EXPECT_THAT(refused.error().message, HasSubstr(file.string()));
}

TEST_F(File, ThatIsMissingEmptyAFolderOrAPipeIsRefusedByName) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const fs::path& file : {folder_ / "missing", folder_, pipe, with("empty", "")}) {
    const Result<Bytes> refused = read_file(file);
    ASSERT_FALSE(refused) << file;
    EXPECT_EQ(refused.error().code, ErrorCode::unreadable);
    EXPECT_THAT(refused.error().message, HasSubstr(file.string()));
  }
}

TEST_F(File, IsWrittenAndReplacedWhole) {
  const fs::path file = folder_ / "out.json";
  ASSERT_TRUE(write_file(file, "first"));
  EXPECT_EQ(text_of(file), "first");
  ASSERT_TRUE(write_file(file, "second, longer"));
  EXPECT_EQ(text_of(file), "second, longer");
  EXPECT_EQ(files(), 1u);  // no temporary file stays
}

TEST_F(File, KeepsALinkALink) {
  const fs::path file = with("target", "old"), link = folder_ / "link";
  fs::create_symlink(file, link);
  ASSERT_TRUE(write_file(link, "new"));
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(text_of(file), "new");
}

TEST_F(File, ThatCannotBeWrittenLeavesNothingBehind) {
  const Result<void> refused = write_file(folder_ / "no_such_folder" / "out.json", "text");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::unwritable);
  EXPECT_THAT(refused.error().message, HasSubstr("no_such_folder"));
  EXPECT_EQ(files(), 0u);
}

TEST_F(File, APipeIsWrittenToAsItIs) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { std::getline(std::ifstream(pipe), received); });
  EXPECT_TRUE(write_file(pipe, "through the pipe\n"));
  reader.join();
  EXPECT_EQ(received, "through the pipe");
  EXPECT_TRUE(fs::is_fifo(pipe));
}

TEST(Sha256, GivesTheStandardVectors) {
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace patchlab::test
