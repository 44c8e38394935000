// Intervals of steps in which something is broken on purpose.
#include "base/step_interval.hpp"

#include <gtest/gtest.h>

#include <string>

namespace mrroc::test {
namespace {

StepInterval read(const std::string& list) {
  return read_step_interval(Config::parse("[a]\nb = " + list, "a.toml"), "a.b");
}

TEST(StepInterval, LastsFromItsFirstStepToTheOneBeforeItsEnd) {
  const StepInterval some = read("[3, 5]");
  for (const std::int64_t step : {0, 1, 2, 3, 4, 5, 6})
    EXPECT_EQ(some.contains(step), step == 3 || step == 4);
  for (const StepInterval& none : {StepInterval{}, read("[]"), read_step_interval(Config(), "a.b")})
    for (const std::int64_t step : {-1, 0, 1}) EXPECT_FALSE(none.contains(step));
}

TEST(StepInterval, IsRefusedByItsKeyWhenItIsNoInterval) {
  for (const std::string list :
       {"[1]", "[1, 2, 3]", "[2, 2]", "[3, 2]", "[0.5, 2]", "[1, 2.5]", "[-1, 2]", "[1, nan]", "7"})
    try {
      (void)read(list);
      ADD_FAILURE() << list;
    } catch (const FaultError& error) {
      EXPECT_EQ(error.fault().code, FaultCode::bad_configuration);
      EXPECT_NE(std::string(error.what()).find("a.b"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace mrroc::test
