// Sessions in a folder of their own, and processes that die there.
#pragma once
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/link/session.hpp"

namespace mrroc::link::test {

/// A folder for the files of sessions.
class Session : public ::testing::Test {
 protected:
  Session() {
    std::string pattern = (std::filesystem::temp_directory_path() / "session_test.XXXXXX").string();
    home_ = ::mkdtemp(pattern.data());
  }
  ~Session() override { std::filesystem::remove_all(home_); }

  [[nodiscard]] std::filesystem::path directory() const { return home_ / "mrroc"; }
  static SessionInfo info(const std::string& name) {
    return {name, 42, address_for(name), "drawing", "/runs/drawing-1", 0};
  }
  [[nodiscard]] std::vector<std::string> names() const {
    std::vector<std::string> result;
    for (const SessionInfo& s : running_sessions(directory())) result.push_back(s.name);
    return result;
  }

  std::filesystem::path home_;
};

/// @return the code with which f fails, none when it does not
template <class F>
FaultCode code_of(F f) {
  try {
    f();
  } catch (const FaultError& e) {
    return e.fault().code;
  }
  return FaultCode::none;
}

/// Runs f in a child that then ends without destructors.
template <class F>
int status_of_child(F f) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(f());
  int status{};
  ::waitpid(child, &status, 0);
  return WEXITSTATUS(status);
}

}  // namespace mrroc::link::test
