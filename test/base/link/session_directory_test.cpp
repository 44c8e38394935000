// The directory of sessions: where it is, and how it is kept from other users.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <ios>
#include <optional>
#include <string>
#include <tuple>

#include "base/fault.hpp"
#include "base/link/session.hpp"
#include "test/base/link/session_fixture.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using test::code_of;
using test::Session;
using test::status_of_child;

TEST_F(Session, KeepsItsDirectoryFromOtherUsers) {
  fs::create_directory(directory());
  for (const mode_t mode : {0777, 0770, 0750, 0740, 0720, 0710, 0707, 0704, 0702, 0701}) {
    ::chmod(directory().c_str(), mode);
    const SessionFile file(info("private"), directory());
    EXPECT_EQ(fs::status(directory()).permissions(), fs::perms::owner_all) << std::oct << mode;
  }
}

TEST_F(Session, WhoLooksForThemKeepsTheDirectoryFromOtherUsersToo) {
  fs::create_directory(directory());
  ::chmod(directory().c_str(), 0777);
  EXPECT_TRUE(names().empty());
  EXPECT_EQ(fs::status(directory()).permissions(), fs::perms::owner_all);
  fs::remove_all(directory());
  fs::create_directory(home_ / "elsewhere");
  fs::create_symlink(home_ / "elsewhere", directory());
  EXPECT_EQ(code_of([this] { std::ignore = running_sessions(directory()); }), FaultCode::cannot_write);
}

TEST_F(Session, RefusesADirectoryThatIsNoneOrALink) {
  fs::create_directory(home_ / "elsewhere");
  fs::create_symlink(home_ / "elsewhere", directory());
  EXPECT_EQ(code_of([this] { SessionFile file(info("a"), directory()); }), FaultCode::cannot_write);
  EXPECT_EQ(code_of([this] { SessionFile file(info("a"), home_ / "no" / "parent"); }),
            FaultCode::cannot_write);
}

TEST_F(Session, AnEntryThatAnotherUserHasMadeIsNotBelieved) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give a file away";
  const SessionFile file(info("s"), directory());
  ASSERT_EQ(::chown(file.path().c_str(), 65534, 65534), 0);
  EXPECT_TRUE(names().empty());
}

/// Sets a variable of the environment as long as it lives.
class Variable {
 public:
  Variable(const char* name, const std::string& value) : name_(name) {
    if (const char* const before = std::getenv(name)) before_ = before;
    ::setenv(name, value.c_str(), 1);
  }
  ~Variable() { before_ ? ::setenv(name_, before_->c_str(), 1) : ::unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(Session, IsAtHomeWhenAnotherUserHasTakenTheUsualName) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can be another user";
  const Variable runtime("XDG_RUNTIME_DIR", ""), home("XDG_STATE_HOME", home_.string());
  constexpr uid_t kVictim = 54321, kOther = 54322;
  const fs::path usual = "/tmp/mrroc-" + std::to_string(kVictim);
  fs::remove_all(usual);
  fs::permissions(home_, fs::perms::all);
  const auto as_victim = [](auto f) {
    return status_of_child([&] { return ::seteuid(kVictim) == 0 && f() ? 0 : 1; });
  };
  const auto usually = [&] { return session_place().directory == usual && session_place().note.empty(); };
  EXPECT_EQ(as_victim(usually), 0) << "nobody has it";
  fs::create_directory(usual);
  ASSERT_EQ(::chown(usual.c_str(), kOther, kOther), 0);
  EXPECT_EQ(as_victim([&] {
              const SessionPlace place = session_place();
              if (place.directory.parent_path() != home_ / "mrroc" ||
                  place.note.find("another user") == std::string::npos)
                return false;
              const SessionFile file(info("s"), place.directory);
              if (::seteuid(0) != 0) return false;
              fs::remove_all(usual);  // its owner gives it back meanwhile
              return ::seteuid(kVictim) == 0 && running_sessions().size() == 1;
            }),
            0);
  fs::remove_all(usual);
  fs::create_symlink("/etc", usual);
  EXPECT_EQ(as_victim([&] { return session_place().directory != usual; }), 0) << "a link";
  fs::remove(usual);
  EXPECT_EQ(as_victim(usually), 0) << "given back, and nothing runs";
}

TEST_F(Session, LooksInTheUsersRuntimeDirectoryIfThereIsOne) {
  const std::string user = "mrroc-" + std::to_string(::geteuid());
  const char* const before = std::getenv("XDG_RUNTIME_DIR");
  const std::string kept = before ? before : "";
  ::setenv("XDG_RUNTIME_DIR", home_.c_str(), 1);
  EXPECT_EQ(session_directory(), home_ / user);
  ::setenv("XDG_RUNTIME_DIR", (home_ / "missing").c_str(), 1);
  EXPECT_EQ(session_directory(), fs::path("/tmp") / user);
  before ? ::setenv("XDG_RUNTIME_DIR", kept.c_str(), 1) : ::unsetenv("XDG_RUNTIME_DIR");
}

}  // namespace
}  // namespace mrroc::link
