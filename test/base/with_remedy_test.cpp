#include "base/with_remedy.hpp"

#include <gtest/gtest.h>

#include "base/fault.hpp"

namespace mrroc {
namespace {

TEST(WithRemedy, BehindAQuestionItIsASentenceOfItsOwn) {
  EXPECT_EQ(with_remedy("it broke", "mend it"), "it broke; mend it");
  EXPECT_EQ(with_remedy("no 'a'; did you mean 'b'?", "look at `x --help`"),
            "no 'a'; did you mean 'b'? Look at `x --help`");
  EXPECT_EQ(with_remedy("no 'a'; did you mean 'b'?", "`x` lists them"),
            "no 'a'; did you mean 'b'? `x` lists them");
  EXPECT_EQ(FaultError(FaultCode::bad_usage, "did you mean 'b'?", "give it").error_line(),
            "error: bad_usage: did you mean 'b'? Give it");
}

}  // namespace
}  // namespace mrroc
