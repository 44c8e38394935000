// The secret of a session: where it is read, and whose files are believed.
#include "base/link/key.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "base/fault.hpp"
#include "base/link/child.hpp"
#include "base/link/private_folder.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

class KeyFile : public ::testing::Test {
 protected:
  static fs::path new_folder() {
    std::string pattern = (fs::temp_directory_path() / "key_test.XXXXXX").string();
    return ::mkdtemp(pattern.data());
  }
  ~KeyFile() override { fs::remove_all(folder_); }

  /// @return what is wrong with the file, empty: nothing
  [[nodiscard]] std::string refusal() const {
    try {
      std::ignore = read_key_file(file_);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
      return e.what();
    }
    return "";
  }

  const fs::path folder_ = new_folder();
  const fs::path file_ = folder_ / "s.key";
};

TEST(Key, IsReadFromItsOwnTextAndDiffersFromEveryOther) {
  const Key a = Key::random(), b = Key::random();
  EXPECT_EQ(Key::parse(a.hex()), a);
  EXPECT_NE(a, b);
  std::string upper = a.hex();
  for (char& c : upper) c = static_cast<char>(std::toupper(c));
  EXPECT_EQ(Key::parse(upper), a);
}

TEST(Key, NothingElseIsOne) {
  const std::string right = Key::random().hex();
  EXPECT_FALSE(Key::parse(""));
  EXPECT_FALSE(Key::parse(right.substr(1)));
  EXPECT_FALSE(Key::parse(right + "0"));
  for (const char c : {'g', 'G', '/', ':', '@', '`', ' ', '\0', '\xff'}) {
    std::string wrong = right;
    wrong[17] = c;
    EXPECT_FALSE(Key::parse(wrong)) << c;
  }
}

TEST(Key, ComesAsTheFirstLineOfAPipe) {
  const Key key = Key::random();
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  const std::string text = key.hex() + "\nwhat follows\n";
  ASSERT_EQ(::write(ends[1], text.data(), text.size()), static_cast<ssize_t>(text.size()));
  ::close(ends[1]);
  EXPECT_EQ(read_key(ends[0]), key);
  EXPECT_THROW(std::ignore = read_key(ends[0]), FaultError);
  ::close(ends[0]);
  EXPECT_THROW(std::ignore = read_key(ends[0]), FaultError) << "a descriptor that is closed";
}

TEST(Key, ReachesAChildByItsStandardInputAndByNothingElse) {
  const std::string hex = Key::random().hex();
  Child child("/bin/sh", {"-c", "read key && [ ${#key} = 64 ] && ! read more && ! env | grep -q \"$key\""},
              {}, hex + "\n");
  for (int k = 0; k < 1000 && !child.reap(); ++k) ::usleep(10000);
  EXPECT_TRUE(child.ended_well()) << child.ended().value_or("it runs");
}

TEST_F(KeyFile, IsForItsUserAlone) {
  const Key key = Key::random();
  write_key_file(file_, key);
  EXPECT_EQ(fs::status(file_).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(read_key_file(file_), key);
}

TEST_F(KeyFile, IsNotWrittenOverWhatIsThere) {
  fs::create_symlink(folder_ / "elsewhere", file_);
  EXPECT_THROW(write_key_file(file_, Key::random()), FaultError);
  EXPECT_FALSE(fs::exists(folder_ / "elsewhere"));
  fs::remove(file_);
  write_key_file(file_, Key::random());
  EXPECT_THROW(write_key_file(file_, Key::random()), FaultError);
}

TEST_F(KeyFile, IsNotBelievedWhenOthersCanOpenItOrItIsSomethingElse) {
  EXPECT_NE(refusal(), "") << "none is there";
  write_key_file(file_, Key::random());
  for (const mode_t mode : {0640U, 0604U, 0620U, 0666U}) {
    ::chmod(file_.c_str(), mode);
    EXPECT_NE(refusal().find("open to other users"), std::string::npos) << std::oct << mode;
  }
  ::chmod(file_.c_str(), 0400);
  EXPECT_EQ(refusal(), "");
  fs::create_symlink(file_, folder_ / "link.key");
  EXPECT_THROW(std::ignore = read_key_file(folder_ / "link.key"), FaultError);
  EXPECT_THROW(std::ignore = read_key_file(folder_), FaultError);
  ::mkfifo((folder_ / "pipe.key").c_str(), 0600);
  EXPECT_THROW(std::ignore = read_key_file(folder_ / "pipe.key"), FaultError) << "and it does not wait";
  std::ofstream(folder_ / "empty.key").flush();
  ::chmod((folder_ / "empty.key").c_str(), 0600);
  EXPECT_THROW(std::ignore = read_key_file(folder_ / "empty.key"), FaultError);
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  ::chmod(file_.c_str(), 0600);
  ASSERT_EQ(::chown(file_.c_str(), 65534, 65534), 0);
  EXPECT_NE(refusal().find("another user"), std::string::npos);
}

TEST_F(KeyFile, ALockThatIsHeldIsWaitedForOnlySoLongAndItsHolderIsNamed) {
  const int held = ::open((folder_ / ".lock").c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0600);
  ASSERT_EQ(::flock(held, LOCK_EX), 0);
  const auto begun = std::chrono::steady_clock::now();
  try {
    const FolderLock lock(folder_, 100ms);
    FAIL() << "two hold it";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::cannot_write);
    const std::string text = e.what();
    EXPECT_NE(text.find("process " + std::to_string(::getpid()) + " (base_link_test)"), std::string::npos)
        << text;
  }
  EXPECT_GE(std::chrono::steady_clock::now() - begun, 100ms);
  ::close(held);
  EXPECT_NO_THROW(FolderLock(folder_, 100ms));
}

}  // namespace
}  // namespace mrroc::link
