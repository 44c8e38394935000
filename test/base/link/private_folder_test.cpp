// Files and folders that others have no part in: what is taken, and what is said of the rest.
#include "base/link/private_folder.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <tuple>

#include "base/fault.hpp"
#include "test/open_files.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

class PrivateFolder : public ::testing::Test {
 protected:
  PrivateFolder() {
    std::string pattern = (fs::temp_directory_path() / "private_folder_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~PrivateFolder() override { fs::remove_all(folder_); }

  fs::path file(const std::string& text, mode_t mode) const {
    fs::path path = folder_ / "file";
    std::ofstream(path, std::ios::binary) << text;
    ::chmod(path.c_str(), mode);
    return path;
  }
  /// @return what is wrong with a file that is not read
  static std::string wrong(const fs::path& path, OwnFile kind) {
    std::string why = "what was wrong with another one";
    EXPECT_FALSE(read_own_file(path, kind, why)) << path;
    return why;
  }
  static std::string refusal(const fs::path& folder) {
    try {
      make_private_folder(folder);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::cannot_write);
      return e.what();
    }
    return "";
  }

  fs::path folder_;
};

TEST_F(PrivateFolder, AFileOfOnesOwnIsReadWholeUpTo64Kilobytes) {
  std::string why;
  for (const std::size_t size : {0U, 1U, 1000U, 65536U}) {
    const std::string text(size, 'x');
    EXPECT_EQ(read_own_file(file(text, 0600), OwnFile::secret, why), text);
  }
  EXPECT_EQ(why, "");
  EXPECT_EQ(wrong(file(std::string(65537, 'x'), 0600), OwnFile::secret), "it is too large");
  EXPECT_EQ(wrong(file(std::string(200'000, 'x'), 0600), OwnFile::trusted), "it is too large");
}

TEST_F(PrivateFolder, OthersMayReadWhatIsTrustedAndNotWriteItAndDoNothingWithASecret) {
  for (mode_t mode = 0; mode < 0100; ++mode) {
    const fs::path path = file("text", 0600 | mode);
    std::string why;
    EXPECT_EQ(read_own_file(path, OwnFile::secret, why).has_value(), mode == 0) << std::oct << mode;
    EXPECT_EQ(read_own_file(path, OwnFile::trusted, why).has_value(), (mode & 022) == 0) << std::oct << mode;
    if (mode != 0) {
      EXPECT_EQ(wrong(path, OwnFile::secret), "it is open to other users");
    }
  }
}

TEST_F(PrivateFolder, WhatIsNoFileOfOnesOwnIsNamed) {
  EXPECT_EQ(wrong(folder_ / "none", OwnFile::trusted), "No such file or directory");
  EXPECT_EQ(wrong(folder_, OwnFile::trusted), "it is no file");
  ::mkfifo((folder_ / "pipe").c_str(), 0600);
  EXPECT_EQ(wrong(folder_ / "pipe", OwnFile::trusted), "it is no file");
  const fs::path path = file("text", 0600);
  fs::create_symlink(path, folder_ / "link");
  EXPECT_EQ(wrong(folder_ / "link", OwnFile::trusted), "Too many levels of symbolic links");
}

TEST_F(PrivateFolder, AFileOfAnotherUserIsNamed) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  const fs::path path = file("text", 0600);
  ASSERT_EQ(::chown(path.c_str(), 65534, 65534), 0);
  EXPECT_EQ(wrong(path, OwnFile::trusted), "it belongs to another user");
}

TEST_F(PrivateFolder, AFileIsWrittenOnceAndForItsUserAlone) {
  std::string why;
  const fs::path path = folder_ / "new";
  const mode_t before = ::umask(0);
  EXPECT_TRUE(write_own_file(path, "some text", why));
  ::umask(before);
  EXPECT_EQ(why, "");
  EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
  EXPECT_EQ(read_own_file(path, OwnFile::secret, why), "some text");
  EXPECT_FALSE(write_own_file(path, "other", why));
  EXPECT_EQ(why, "File exists");
  EXPECT_EQ(read_own_file(path, OwnFile::secret, why), "some text") << "it stays as it was";
  EXPECT_FALSE(write_own_file(folder_ / "no" / "file", "text", why));
  EXPECT_EQ(why, "No such file or directory");
}

TEST_F(PrivateFolder, IsMadeOrClosedAndRefusedWhereThatCannotBe) {
  const fs::path made = folder_ / "made";
  EXPECT_EQ(refusal(made), "");
  EXPECT_EQ(fs::status(made).permissions(), fs::perms::owner_all);
  EXPECT_FALSE(is_anothers(made));
  fs::permissions(made, fs::perms::all);
  EXPECT_EQ(refusal(made), "");
  EXPECT_EQ(fs::status(made).permissions(), fs::perms::owner_all);
  const fs::path text = file("text", 0600);
  EXPECT_EQ(refusal(text), "cannot use " + text.string() + ": it is not a directory");
  EXPECT_TRUE(is_anothers(text));
  EXPECT_FALSE(is_anothers(folder_ / "none"));
  EXPECT_EQ(refusal(folder_ / "no" / "folder"),
            "cannot use " + (folder_ / "no" / "folder").string() + ": No such file or directory");
}

TEST_F(PrivateFolder, OfAnotherUserIsRefused) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a folder away";
  const fs::path made = folder_ / "made";
  EXPECT_EQ(refusal(made), "");
  ASSERT_EQ(::chown(made.c_str(), 65534, 65534), 0);
  EXPECT_EQ(refusal(made), "cannot use " + made.string() + ": it belongs to another user");
  EXPECT_TRUE(is_anothers(made));
}

TEST_F(PrivateFolder, NoFileOfItStaysOpen) {
  const auto before = mrroc::test::open_files();
  std::string why;
  const fs::path path = file("text", 0600);
  EXPECT_TRUE(read_own_file(path, OwnFile::secret, why));
  EXPECT_FALSE(read_own_file(folder_, OwnFile::secret, why));
  EXPECT_FALSE(write_own_file(path, "other", why));
  EXPECT_TRUE(write_own_file(folder_ / "new", "other", why));
  {
    const FolderLock lock(folder_, std::chrono::milliseconds(20));
    EXPECT_EQ(mrroc::test::open_files(), before + 1);
    EXPECT_THROW(FolderLock(folder_, std::chrono::milliseconds(20)), FaultError);
    EXPECT_EQ(mrroc::test::open_files(), before + 1);
  }
  EXPECT_EQ(mrroc::test::open_files(), before);
  EXPECT_NO_THROW(FolderLock(folder_, std::chrono::milliseconds(20))) << "it was given back";
}

TEST_F(PrivateFolder, AFileThatFindsNoRoomIsNotLeftByHalf) {
  const pid_t child = ::fork();
  if (child == 0) {
    ::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    std::string part, none;
    const bool half = write_own_file(folder_ / "half", std::string(1001, 'x'), part);
    const bool whole = write_own_file(folder_ / "whole", std::string(1000, 'x'), none);
    ::_exit(!half && part == "the disk is full" && whole && none.empty() ? 0 : 1);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_FALSE(fs::exists(folder_ / "half"));
  EXPECT_EQ(fs::file_size(folder_ / "whole"), 1000U);
}

TEST_F(PrivateFolder, ALockThatIsHeldIsToldWithItsHolder) {
  const FolderLock lock(folder_);
  std::string name;
  std::getline(std::ifstream("/proc/self/comm"), name);
  const auto begun = std::chrono::steady_clock::now();
  try {
    const FolderLock second(folder_, std::chrono::milliseconds(50));
    ADD_FAILURE() << "it was given twice";
  } catch (const FaultError& e) {
    EXPECT_GE(std::chrono::steady_clock::now() - begun, std::chrono::milliseconds(50));
    EXPECT_EQ(e.fault().code, FaultCode::cannot_write);
    EXPECT_EQ(e.what(), "cannot use " + (folder_ / ".lock").string() + ": process " +
                            std::to_string(::getpid()) + " (" + name + ") has held it for 0.05 s");
    EXPECT_EQ(e.remedy(), "end that process");
  }
  try {
    const FolderLock nowhere(folder_ / "no");
    ADD_FAILURE() << "there is no such folder";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::cannot_write);
    EXPECT_EQ(e.what(), "cannot use " + (folder_ / "no" / ".lock").string() + ": No such file or directory");
    EXPECT_NE(e.remedy(), "end that process");
  }
}

TEST_F(PrivateFolder, WhetherOneCouldBeMadeIsToldWithoutMakingIt) {
  EXPECT_EQ(why_no_private_folder(folder_), "");
  EXPECT_EQ(why_no_private_folder(folder_ / "new"), "");
  EXPECT_EQ(why_no_private_folder(folder_ / "new" / "newer"), "");
  EXPECT_FALSE(fs::exists(folder_ / "new"));
  const fs::path text = file("text", 0600);
  EXPECT_EQ(why_no_private_folder(text), "cannot use " + text.string() + ": it is not a directory");
  EXPECT_EQ(why_no_private_folder(text / "a" / "b"),
            "cannot use " + (text / "a" / "b").string() + ": it cannot be made in " + text.string());
}

}  // namespace
}  // namespace mrroc::link
