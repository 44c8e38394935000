// What is said of a command line that lacks something.
#include "base/command_line.hpp"

#include <gtest/gtest.h>

#include <sstream>

namespace mrroc::test {
namespace {

const Examples kExamples{"bake bread rye", "bake bread rye --degrees 230", "bake sort --from flour"};

/// A program with two commands, of which one wants two words.
struct Bakery {
  Bakery() {
    app.require_subcommand(1)->fallthrough();
    CLI::App* const bread = app.add_subcommand("bread", "bakes one");
    bread->add_option("grain", grain, "rye or wheat")->required();
    bread->add_option("--degrees", degrees, "heat of the oven");
    CLI::App* const sort = app.add_subcommand("sort", "into boxes");
    sort->add_option("from", from)->required();
    sort->add_option("to", to, "a box")->required();
    app.add_option("--oven", oven, "which one")->type_name("NAME");
  }
  /// @return the error line
  std::string said_of(const std::vector<std::string>& words, const Examples& examples = kExamples) {
    std::ostringstream out, err;
    EXPECT_EQ(parse_words(app, words, out, err, examples), 2);
    return err.str();
  }

  CLI::App app{"bakes", "bake"};
  std::string grain, from, to, oven;
  int degrees{};
};

TEST(CommandLine, AWordThatIsMissingIsNamedWithALineToType) {
  EXPECT_EQ(Bakery().said_of({"bread"}),
            "error: bad_usage: GRAIN (rye or wheat) is missing; type for example `bake bread rye`\n");
  EXPECT_EQ(Bakery().said_of({"sort"}),
            "error: bad_usage: FROM and TO (a box) are missing; type for example `bake sort --from flour`\n");
}

TEST(CommandLine, ACommandThatIsMissingIsToldWithThoseThatThereAre) {
  EXPECT_EQ(Bakery().said_of({}),
            "error: bad_usage: a command is missing; there are bread and sort; type for example `bake bread "
            "rye`\n");
}

TEST(CommandLine, AValueThatIsMissingIsToldWithWhatItIsFor) {
  EXPECT_EQ(
      Bakery().said_of({"bread", "rye", "--degrees"}),
      "error: bad_usage: a value is missing behind --degrees (heat of the oven); type for example `bake "
      "bread rye --degrees 230`\n");
  EXPECT_EQ(Bakery().said_of({"bread", "rye", "--oven"}),
            "error: bad_usage: a value is missing behind --oven (which one); look at `bake bread --help`\n")
      << "no example has it";
}

TEST(CommandLine, AWordThatDoesNotExistIsToldBeforeOneThatIsMissing) {
  EXPECT_EQ(Bakery()
                .said_of({"bread", "--degres=230"})
                .find("error: bad_usage: there is no option '--degres'; did"),
            0U);
  EXPECT_EQ(Bakery().said_of({"braed"}).find(
                "error: bad_usage: there is no command 'braed'; did you mean 'bread'?"),
            0U);
}

TEST(CommandLine, WithoutExamplesItSaysWhereToLook) {
  EXPECT_EQ(Bakery().said_of({"bread"}, {}),
            "error: bad_usage: GRAIN (rye or wheat) is missing; look at `bake bread --help`\n");
}

}  // namespace
}  // namespace mrroc::test
