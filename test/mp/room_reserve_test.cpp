// Room for the end of a run: taken from the disk at its beginning, free when it is needed.
#include "mp/room_reserve.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <iterator>

#include "base/fault.hpp"
#include "test/open_files.hpp"

namespace mrroc::mp {
namespace {

namespace fs = std::filesystem;

class Room : public ::testing::Test {
 protected:
  Room() {
    std::string pattern = (fs::temp_directory_path() / "room_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
  }
  ~Room() override { fs::remove_all(folder_); }
  fs::path folder_;
};

TEST_F(Room, IsReallyTakenAndGivenBack) {
  {
    const int other = ::open((folder_ / "other").c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const bool promises = ::fallocate(other, 0, 0, 4096) == 0;
    ::close(other);
    fs::remove(folder_ / "other");
    if (!promises) GTEST_SKIP() << "this file system promises no room";
  }
  RoomReserve reserve(folder_);
  struct stat file {};
  ASSERT_EQ(::stat((folder_ / RoomReserve::kFile).c_str(), &file), 0);
  EXPECT_GE(static_cast<std::uintmax_t>(file.st_blocks) * 512, RoomReserve::kSize)
      << "a hole promises nothing";
  EXPECT_EQ(file.st_mode & 0777, 0600) << "for its user alone";
  reserve.release();
  EXPECT_TRUE(fs::is_empty(folder_));
  reserve.release();
}

TEST_F(Room, IsGivenBackAtTheEndInAnyCase) {
  { const RoomReserve reserve(folder_); }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(Room, OfAFolderThatIsNotThereIsAnError) { EXPECT_THROW(RoomReserve(folder_ / "no"), FaultError); }

TEST_F(Room, WhereFilesMayNotGrowSoFarARunGoesWithout) {
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{1'000'000, 1'000'000};
    ::setrlimit(RLIMIT_FSIZE, &small);
    try {
      const RoomReserve reserve(folder_);
      ::_exit(fs::is_empty(folder_) ? 0 : 1);
    } catch (const FaultError&) {
      ::_exit(2);
    }
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(Room, NoFileStaysOpenForIt) {
  const auto before = test::open_files();
  const RoomReserve reserve(folder_);
  EXPECT_EQ(test::open_files(), before);
}

TEST_F(Room, ThatCannotBeTakenIsSaidWithItsFile) {
  try {
    const RoomReserve reserve(folder_ / "no");
    ADD_FAILURE() << "it was taken";
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::cannot_write);
    EXPECT_EQ(e.fault().text.view(), "cannot write " + (folder_ / "no" / "reserve").string());
  }
  fs::create_directories(folder_ / "there");
  { const RoomReserve first(folder_ / "there"), second(folder_ / "there"); }
  EXPECT_TRUE(fs::is_empty(folder_ / "there")) << "one that is there already is taken over";
}

}  // namespace
}  // namespace mrroc::mp
