// Keys of sessions: who can read them, when they end, and what cannot be opened without one.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <tuple>

#include "base/fault.hpp"
#include "base/link/session.hpp"
#include "test/base/link/session_fixture.hpp"

namespace mrroc::link {
namespace {

namespace fs = std::filesystem;
using test::Session;
using test::status_of_child;

TEST_F(Session, HasAKeyThatItsUserAloneCanReadAndThatEndsWithIt) {
  fs::path key_file;
  {
    const SessionFile file(info("s"), directory());
    ASSERT_TRUE(file.info().key);
    key_file = file.info().key_file;
    const SessionInfo running = running_sessions(directory()).at(0);
    EXPECT_EQ(running.key, file.info().key);
    EXPECT_EQ(running.key_file, key_file);
    EXPECT_EQ(fs::status(key_file).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    std::ifstream in(file.path());
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text.find(file.info().key->hex()), std::string::npos) << "the secret has a file of its own";
    const SessionFile other(info("t"), directory());
    EXPECT_NE(other.info().key, file.info().key);
  }
  EXPECT_FALSE(fs::exists(key_file));
}

TEST_F(Session, WithinOneProcessHasNoKey) {
  SessionInfo quiet = info("quiet");
  quiet.address.reset();
  const SessionFile file(quiet, directory());
  EXPECT_FALSE(file.info().key);
  EXPECT_FALSE(fs::exists(directory() / "quiet.key"));
}

TEST_F(Session, TheKeyOfAKilledTaskIsRemovedAndNotUsedAgain) {
  status_of_child([this] {
    new SessionFile(info("heir"), directory());
    return 0;
  });
  const std::string before = fs::exists(directory() / "heir.key") ? "there" : "gone";
  EXPECT_EQ(before, "there");
  EXPECT_TRUE(names().empty());
  EXPECT_FALSE(fs::exists(directory() / "heir.key"));
}

TEST_F(Session, AKeyThatOthersCanReadIsNotBelieved) {
  const SessionFile file(info("s"), directory());
  ::chmod(file.info().key_file.c_str(), 0644);
  EXPECT_FALSE(running_sessions(directory()).at(0).key);
  try {
    std::ignore = open_session(running_sessions(directory()).at(0));
    FAIL();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::no_such_session);
  }
}

TEST_F(Session, CannotBeOpenedWithoutAnAddressOrAKey) {
  SessionInfo s = info("drawing-1a2b");
  EXPECT_FALSE(s.key);
  try {
    std::ignore = open_session(s);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::no_such_session);
    EXPECT_EQ(std::string(e.what()), "the key of session drawing-1a2b is not known here");
    EXPECT_NE(e.remedy().find("--key-file"), std::string_view::npos);
  }
  s.address.reset();
  EXPECT_THROW(std::ignore = open_session(s), std::logic_error);
}

}  // namespace
}  // namespace mrroc::link
