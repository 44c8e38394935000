// Shared by tests of hanging, leaving and ending nodes: a clock, and programs that print their process number.
#pragma once
#include <csignal>

#include <cstdlib>
#include <string>

#include "test/mp/no_deadlines.hpp"
#include "test/mp/supervisor_fixture.hpp"

namespace mrroc::mp::test {

/// Wall time since it was made.
struct Watch {
  Process::Clock::time_point begun{Process::Clock::now()};
  [[nodiscard]] auto passed() const { return Process::Clock::now() - begun; }
};

/// With programs that write down which process they are.
class SupervisorEnds : public SupervisorFixture {
 protected:
  /// @return whether the process of that number, which the script of a child wrote to a file, has gone
  bool gone(const std::string& file) {
    const int number = std::atoi(text_of(file).c_str());
    return number > 0 && ::kill(number, 0) != 0;
  }
  std::string writes_its_number(const std::string& file) { return "echo $$ > " + (folder / file).string(); }
};

}  // namespace mrroc::mp::test
