// A folder that is no run folder is refused with what it lacks and where the runs are.
#include "base/link/run_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>

#include "base/fault.hpp"
#include "base/link/log_reader.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;

class RunFolders : public ::testing::Test {
 protected:
  RunFolders() : before_(fs::current_path()) {
    std::string pattern = (fs::temp_directory_path() / "run_folder_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    fs::current_path(folder_);
  }
  ~RunFolders() override {
    fs::current_path(before_);
    fs::remove_all(folder_);
  }
  static void put(const fs::path& file) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "x";
  }
  struct Refusal {
    std::string what, remedy;
  };
  static Refusal refusal(const fs::path& folder) {
    try {
      EXPECT_EQ(checked_run_folder(folder), folder);
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_log);
      return {e.what(), std::string(e.remedy())};
    }
    return {};
  }

  fs::path before_, folder_;
};

TEST_F(RunFolders, NeedALogAndAConfiguration) {
  EXPECT_EQ(refusal("runs/a").what, "there is no folder runs/a");
  fs::create_directories("runs/a");
  EXPECT_EQ(refusal("runs/a").what, "runs/a is no run folder: it has no " + std::string(kEventLog));
  put(fs::path("runs/a") / kEventLog);
  EXPECT_EQ(refusal("runs/a").what, "runs/a is no run folder: it has no config.toml");
  put("runs/a/config.toml");
  EXPECT_EQ(refusal("runs/a").what, "");
}

TEST_F(RunFolders, TheNewestOneIsNamedToWhoeverMissesIt) {
  EXPECT_TRUE(refusal("x").remedy.ends_with("and there are none here")) << refusal("x").remedy;
  fs::create_directories("runs/without");
  EXPECT_TRUE(refusal("x").remedy.ends_with("and there are none here"));
  const auto now = fs::file_time_type::clock::now();
  for (const auto& [name, age] : {std::pair("b", 20), std::pair("c", 10), std::pair("a", 30)}) {
    const fs::path log = fs::path("runs") / name / kEventLog;
    put(log);
    fs::last_write_time(log, now - std::chrono::seconds(age));
  }
  EXPECT_TRUE(refusal("x").remedy.ends_with("and the newest here is runs/c")) << refusal("x").remedy;
}

}  // namespace
}  // namespace mrroc::link
