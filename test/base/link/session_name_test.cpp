// Names of sessions, and the addresses and the ids that go with them.
#include <gtest/gtest.h>

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "base/fault.hpp"
#include "base/link/session.hpp"
#include "test/base/link/session_fixture.hpp"

namespace mrroc::link {
namespace {

using test::code_of;
using test::Session;

TEST_F(Session, RefusesNamesThatCannotBePartOfAChannelAndAFile) {
  for (const std::string name : {"a", "A_b-9", "abcdefghijklmnopqrstuvwx"}) {
    EXPECT_TRUE(valid_session_name(name)) << name;
    EXPECT_NO_THROW(check_session_name(name));
  }
  for (const std::string name :
       {"", "abcdefghijklmnopqrstuvwxy", "a b", "a.b", "../a", "a/b", "\xc3\xa9", "a\n"}) {
    EXPECT_FALSE(valid_session_name(name)) << name;
    EXPECT_EQ(code_of([&] { check_session_name(name); }), FaultCode::bad_usage) << name;
    EXPECT_EQ(code_of([&] { SessionFile file(info(name), directory()); }), FaultCode::bad_usage) << name;
  }
}

TEST_F(Session, ANameThatIsNoneIsShownWithoutWhatATerminalWouldObey) {
  try {
    check_session_name("a\x1b[2J" + std::string(100, 'x'));
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()), "'a?[2J" + std::string(2 * kMaxSessionName - 5, 'x') +
                                         "' cannot name a session: give 1..24 letters, digits, '_' or '-'");
  }
}

TEST_F(Session, GetsAValidNameThatNobodyHas) {
  std::set<std::string> seen;
  for (const std::string task : {"drawing", "", "a task with a very long name", "../x"}) {
    const std::string name = unique_session_name(task, directory());
    EXPECT_TRUE(valid_session_name(name)) << name;
    EXPECT_TRUE(seen.insert(name).second);
  }
  const auto begins = [this](const char* task, const std::string& with) {
    const std::string name = unique_session_name(task, directory());
    EXPECT_EQ(name.size(), with.size() + 4) << name;
    EXPECT_EQ(name.substr(0, with.size()), with);
    for (const char c : name.substr(with.size()))
      EXPECT_TRUE((c >= '0' && c <= '9') || (c >= 'a' && c <= 'f')) << name;
  };
  begins("drawing", "drawing-");
  begins("", "task-");
  begins("../x y", "---x-y-");
  begins("abcdefghijklmnopqrstuvwxyz", "abcdefghijklmnopqrs-");
}

TEST_F(Session, TalksAtPortsThatDifferForAlmostAllNames) {
  std::map<int, int> used;
  constexpr int kNames = 1000;
  for (int k = 0; k < kNames; ++k) {
    const LcmAddress address = address_for("drawing-" + std::to_string(k));
    EXPECT_EQ(address.ttl, 0);
    EXPECT_EQ(address.port % 4, 0);
    EXPECT_GE(address.port, 20000);
    EXPECT_LE(address.port + kGroups - 1, 29999);
    ++used[address.port];
  }
  // 2500 (1 - (1 - 1/2500)^1000) = 824 different ports are expected of a fair hash.
  EXPECT_GT(used.size(), 780U);
  EXPECT_EQ(address_for("a").port, address_for("a").port);
}

TEST_F(Session, IdsAreAboveZeroAndDiffer) {
  std::set<std::int64_t> seen;
  for (int k = 0; k < 1000; ++k) {
    const std::int64_t id = random_id();
    EXPECT_GT(id, 0);
    EXPECT_TRUE(seen.insert(id).second);
  }
}

}  // namespace
}  // namespace mrroc::link
