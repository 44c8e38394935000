#include "ui_cli/doctor.hpp"

#include <gtest/gtest.h>
#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "test/docs/json_table.hpp"

namespace mrroc::ui {
namespace {

Host healthy() {
  return {.multicast = true,
          .receive_buffer = 8'000'000,
          .clock_resolution_ns = 1,
          .latest_wake_us = 80,
          .cores = 2,
          .real_time_priority = 40,
          .memory_lock = true,
          .missing = {},
          .platforms = {{"rex", true}, {"other", true}},
          .folder = "/runs",
          .free_bytes = 50'000'000'000};
}

Finding finding(const Host& host, const std::string& what) {
  for (const Finding& f : examine(host))
    if (f.what == what) return f;
  ADD_FAILURE() << "nothing is said of " << what;
  return {};
}

TEST(Doctor, HasNothingToSayToAHealthyHost) {
  for (const Finding& f : examine(healthy())) {
    EXPECT_EQ(f.verdict, Verdict::good) << f.what;
    EXPECT_FALSE(f.found.empty()) << f.what;
    EXPECT_TRUE(f.type.empty()) << f.what;
  }
}

TEST(Doctor, SaysWhatToTypeForEverythingThatIsNotWell) {
  struct Case {
    const char* what;
    void (*harm)(Host&);
    Verdict verdict;
    const char* type;
  };
  for (const Case& c :
       {Case{"multicast", [](Host& h) { h.multicast = false; }, Verdict::bad, "ip route add"},
        Case{"buffers", [](Host& h) { h.receive_buffer = 212'992; }, Verdict::limited, "sysctl -w"},
        Case{"clocks", [](Host& h) { h.latest_wake_us = 9000; }, Verdict::limited, "--clock step"},
        Case{"cores", [](Host& h) { h.cores = 1; }, Verdict::limited, "core"},
        Case{"real time", [](Host& h) { h.memory_lock = false; }, Verdict::limited, "memlock"},
        Case{"real time", [](Host& h) { h.real_time_priority = 39; }, Verdict::limited, "rtprio 40"},
        Case{"packages", [](Host& h) { h.missing = {"gnuplot"}; }, Verdict::limited,
             "apt-get install gnuplot-nox "},
        Case{"packages", [](Host& h) { h.missing = {"libEGL.so.1"}; }, Verdict::limited,
             "apt-get install libegl1"},
        Case{"platform", [](Host& h) { h.platforms.clear(); }, Verdict::limited, "./run rex_drive"},
        Case{"platform", [](Host& h) { h.platforms[1].starts = false; }, Verdict::limited, "build again"},
        Case{"sessions",
             [](Host& h) { h.sessions_refused = "cannot use /tmp/mrroc-1: it is not a directory"; },
             Verdict::bad, "XDG_RUNTIME_DIR"},
        Case{"sessions", [](Host& h) { h.sessions_note = "/tmp/mrroc-1 belongs to another user"; },
             Verdict::limited, "XDG_RUNTIME_DIR"},
        Case{"disk", [](Host& h) { h.free_bytes = 1000; }, Verdict::bad, "--run-dir"}}) {
    Host host = healthy();
    c.harm(host);
    const Finding f = finding(host, c.what);
    EXPECT_EQ(f.verdict, c.verdict) << c.what;
    EXPECT_NE(f.type.find(c.type), std::string::npos) << c.what << ": " << f.type;
    for (const Finding& other : examine(host))
      if (other.what != c.what) {
        EXPECT_EQ(other.verdict, Verdict::good) << c.what << " makes " << other.what << " ill";
      }
  }
}

TEST(Doctor, NamesThePlatformsWhoseDriversDoNotStart) {
  Host host = healthy();
  EXPECT_NE(finding(host, "platform").found.find("rex, other"), std::string::npos);
  host.platforms[1].starts = false;
  const std::string found = finding(host, "platform").found;
  EXPECT_NE(found.find("other"), std::string::npos) << found;
  EXPECT_EQ(found.find("rex"), std::string::npos) << found;
}

TEST(Doctor, SaysWhatSignaturesDoNotProtectFrom) {
  const std::string found = finding(healthy(), "sessions").found;
  for (const char* const what : {"signed", "your own programs", "root", "listeners", "filled up"})
    EXPECT_NE(found.find(what), std::string::npos) << what;
}

TEST(Doctor, LooksAtThisHost) {
  const Host host = look_at_host();
  EXPECT_GE(host.cores, 1);
  EXPECT_GT(host.receive_buffer, 0);
  EXPECT_GT(host.clock_resolution_ns, 0);
  EXPECT_GT(host.free_bytes, 0);
  EXPECT_FALSE(host.sessions.empty());
  EXPECT_GT(host.tag_us, 0);
}

TEST(Doctor, LooksAtTheFolderOfSessionsAndChangesNothing) {
  const char* const variable = std::getenv("XDG_RUNTIME_DIR");
  const std::optional<std::string> before = variable ? std::optional<std::string>(variable) : std::nullopt;
  const std::filesystem::path runtime = ::testing::TempDir() + "doctor_test." + std::to_string(::getpid());
  std::filesystem::create_directory(runtime);
  ::setenv("XDG_RUNTIME_DIR", runtime.c_str(), 1);
  Host host = look_at_host();
  EXPECT_EQ(host.sessions.parent_path(), runtime);
  EXPECT_EQ(host.sessions_refused, "");
  EXPECT_TRUE(std::filesystem::is_empty(runtime)) << "no folder is made";
  std::filesystem::create_directory(host.sessions);
  std::filesystem::permissions(host.sessions, std::filesystem::perms(0755));
  EXPECT_EQ(look_at_host().sessions_refused, "") << "a task closes it";
  EXPECT_EQ(std::filesystem::status(host.sessions).permissions(), std::filesystem::perms(0755));
  std::filesystem::remove(host.sessions);
  std::ofstream(host.sessions) << "x";
  EXPECT_NE(look_at_host().sessions_refused.find("is not a directory"), std::string::npos);
  before ? ::setenv("XDG_RUNTIME_DIR", before->c_str(), 1) : ::unsetenv("XDG_RUNTIME_DIR");
  std::filesystem::remove_all(runtime);
}

TEST(Doctor, BelievesWhatTheSystemGrantsAndNotWhoAsks) {
  const Host before = look_at_host();
  const pid_t child = ::fork();
  if (child == 0) {  // root or not: without the capabilities, and with limits that grant nothing
    const rlimit nothing{};
    ::setrlimit(RLIMIT_RTPRIO, &nothing);
    ::setrlimit(RLIMIT_MEMLOCK, &nothing);
    __user_cap_header_struct header{.version = _LINUX_CAPABILITY_VERSION_3, .pid = 0};
    std::array<__user_cap_data_struct, 2> none{};
    ::syscall(SYS_capset, &header, none.data());
    const Host host = look_at_host();
    ::_exit((host.real_time_priority == 0 ? 0 : 1) + (host.memory_lock ? 2 : 0));
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(look_at_host().real_time_priority, before.real_time_priority) << "looking changes nothing";
}

TEST(Doctor, SaysTheSameToScripts) {
  std::ostringstream out, err;
  const int status = run_doctor({"--json"}, out, err);
  const auto all = nlohmann::json::parse(out.str());
  ASSERT_EQ(all.size(), examine(healthy()).size());
  EXPECT_TRUE(test::documented("doctor", all));
  bool bad = false;
  for (const auto& f : all) bad = bad || f.at("verdict") == "NOT OK";
  EXPECT_EQ(status, bad ? 1 : 0);
}

TEST(Doctor, RefusesWordsThatItDoesNotKnow) {
  std::ostringstream out, err;
  EXPECT_EQ(run_doctor({"--jsno"}, out, err), 2);
  EXPECT_EQ(err.str().find("error: bad_usage: doctor does not know '--jsno'"), 0U) << err.str();
  EXPECT_EQ(run_doctor({"--help"}, out, err), 0);
}

}  // namespace
}  // namespace mrroc::ui
