// Accepted words of a command line, and the messages about one that lacks something or has too much.
#include "base/command_line.hpp"

#include <gtest/gtest.h>

#include <sstream>
#include <stdexcept>

#include "base/fault.hpp"
#include "base/with_remedy.hpp"

namespace mrroc::test {
namespace {

const Examples kExamples{"bake bread rye", "bake bread rye --degrees 230", "bake sort --from flour"};

/// A program with two commands, of which one wants two words.
struct Bakery {
  Bakery() {
    line.take_one_subcommand(true);
    line.take_options_anywhere();
    CommandLine& bread = line.subcommand("bread", "bakes one");
    bread.option("grain", grain, "rye or wheat").required();
    bread.option("--degrees", degrees, "heat of the oven");
    CommandLine& sort = line.subcommand("sort", "into boxes");
    sort.option("from", from).required();
    sort.option("to", to, "a box").required();
    line.option("--oven", oven, "which one").type_name("NAME");
  }
  /// @return the error line
  std::string said_of(const std::vector<std::string>& words, const Examples& examples = kExamples) {
    std::ostringstream out, err;
    EXPECT_EQ(line.parse_words(words, out, err, examples), 2);
    return err.str();
  }

  CommandLine line{"bakes", "bake"};
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

TEST(CommandLine, ASettingThatStandsByItselfIsToldWithItsOption) {
  CommandLine line("", "task");
  std::vector<std::string> settings;
  line.option("--set", settings);
  try {
    line.parse({"task.force=3"});
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
    EXPECT_NE(e.error_line().find("give --set task.force=3"), std::string::npos) << e.error_line();
  }
  CommandLine without("", "other");
  EXPECT_THROW(without.parse({"task.force=3"}), FaultError);
}

TEST(CommandLine, WithoutExamplesItSaysWhereToLook) {
  EXPECT_EQ(Bakery().said_of({"bread"}, {}),
            "error: bad_usage: GRAIN (rye or wheat) is missing; look at `bake bread --help`\n");
}

TEST(CommandLine, OptionsStandBehindCommandsToo) {
  Bakery bakery;
  bakery.line.parse({"bread", "rye", "--oven", "old", "--degrees", "230"});
  EXPECT_EQ(bakery.grain, "rye");
  EXPECT_EQ(bakery.oven, "old");
  EXPECT_EQ(bakery.degrees, 230);
  EXPECT_TRUE(bakery.line.named("--oven").given());
  EXPECT_THROW(static_cast<void>(bakery.line.named("--owen")), std::out_of_range);
}

TEST(CommandLine, HelpIsGivenForALineThatIsWrong) {
  std::ostringstream out, err;
  EXPECT_EQ(Bakery().line.parse_words({"bread", "--help", "--nonsense"}, out, err), 0);
  EXPECT_NE(out.str().find("bakes one\n"), std::string::npos) << out.str();
  EXPECT_NE(out.str().find("grain TEXT REQUIRED"), std::string::npos) << out.str();
  EXPECT_EQ(err.str(), "");
  EXPECT_FALSE(Bakery().line.help_asked({"bread", "--", "--help"}));
}

enum class Crust : std::uint8_t { soft, hard };

/// A program that is particular about its values.
struct Mill {
  Mill() {
    const Option kind = line.option("--grain", grain, "of what").one_of({"rye", "wheat"}).type_name("GRAIN");
    line.option("--stones", stones, "how many").range(1, 4);
    line.option("--hours", hours, "how long").range(0.5, 2.5).show_default();
    line.option("--sieves", sieves, "sizes").delimiter(',');
    const Option wind = line.flag("--wind", by_wind, "drives it");
    line.flag("--water", "drives it (default)").excludes(wind);
    line.option("--speed", speed, "of the wind").needs(wind);
    line.option(
        "--sacks", [this](const std::string& text) { take_sacks(text); }, "dozens, or all");
    line.option("--for", whom, "a baker").check([](const std::string& name) {
      if (name.size() < 2) throw WrongValue("it is too short");
    });
    line.option("--note", note, "is kept").value_optional();
    line.choice<Crust>("--crust", crust, {{"soft", Crust::soft}, {"hard", Crust::hard}}, "is wanted");
    line.ignored_option("--by", "who says so");
    line.named("--sieves").excludes(kind);
    line.named("--for").about("who gets it");
  }
  void take_sacks(const std::string& text) {
    if (text == "none") throw FaultError(FaultCode::bad_configuration, "the mill is shut");
    if (text != "all") throw WrongValue("'" + text + "' is not all");
    sacks = text;
  }
  /// @return what the error says; empty: there is none
  std::string refusal(const std::vector<std::string>& words) {
    try {
      line.parse(words, {"mill --speed 3 --wind"});
      return "";
    } catch (const FaultError& e) {
      EXPECT_EQ(e.fault().code, FaultCode::bad_usage);
      return with_remedy(e.what(), e.remedy());
    }
  }

  CommandLine line{"mills", "mill"};
  std::string grain, sacks, whom, note;
  std::optional<double> speed;
  std::vector<std::string> sieves;
  double hours{1};
  int stones{2};
  bool by_wind{};
  Crust crust{};
};

std::string refusal(const std::vector<std::string>& words) { return Mill().refusal(words); }

TEST(CommandLine, ValuesAreWhatTheLineSays) {
  Mill m;
  EXPECT_EQ(m.refusal({"--stones", "3", "--hours=2", "--sieves", "1,2", "--wind", "--speed", "7", "--sacks",
                       "all", "--for", "rye & son", "--note", "--crust", "hard", "--by", "me"}),
            "");
  EXPECT_EQ(m.stones, 3);
  EXPECT_EQ(m.hours, 2);
  EXPECT_EQ(m.sieves, (std::vector<std::string>{"1", "2"}));
  EXPECT_TRUE(m.by_wind);
  EXPECT_EQ(m.speed, 7);
  EXPECT_EQ(m.sacks, "all");
  EXPECT_EQ(m.whom, "rye & son");
  EXPECT_TRUE(m.line.named("--note").given());
  EXPECT_EQ(m.note, "");
  EXPECT_EQ(m.crust, Crust::hard);
}

TEST(CommandLine, ValuesThatAreNotGivenStayAsTheyWere) {
  Mill m;
  EXPECT_EQ(m.refusal({}), "");
  EXPECT_EQ(m.stones, 2);
  EXPECT_EQ(m.hours, 1);
  EXPECT_FALSE(m.speed);
  EXPECT_FALSE(m.line.named("--note").given());
}

TEST(CommandLine, AValueThatIsNoneOfSeveralIsToldWithThem) {
  EXPECT_EQ(refusal({"--grain", "oats"}), "--grain: oats not in {rye,wheat}; look at `mill --help`");
  EXPECT_EQ(refusal({"--grain", "wheet"}),
            "--grain: wheet not in {rye,wheat}; did you mean 'wheat'? Look at `mill --help`");
  EXPECT_EQ(refusal({"--crust", "1"}), "--crust: 1 not in {hard,soft}; look at `mill --help`");
}

TEST(CommandLine, AValueOutOfItsRangeIsToldWithTheLimits) {
  EXPECT_EQ(refusal({"--stones", "5"}), "--stones: 5 is outside 1..4; look at `mill --help`");
  EXPECT_EQ(refusal({"--stones", "-3"}), "--stones: -3 is outside 1..4; look at `mill --help`");
  EXPECT_EQ(refusal({"--stones", "1.5"}), "--stones: '1.5' is no whole number; look at `mill --help`");
  EXPECT_EQ(refusal({"--hours", "max"}), "--hours: 'max' is no number; look at `mill --help`");
  EXPECT_EQ(refusal({"--hours", "nan"}), "--hours: nan is outside 0.5..2.5; look at `mill --help`");
  EXPECT_EQ(refusal({"--hours", "3"}), "--hours: 3 is outside 0.5..2.5; look at `mill --help`");
}

TEST(CommandLine, AValueThatIsNoNumberIsTold) {
  EXPECT_EQ(refusal({"--wind", "--speed", "fast"}), "--speed: 'fast' is no number; look at `mill --help`");
}

TEST(CommandLine, OptionsThatExcludeEachOtherAreNamed) {
  EXPECT_EQ(refusal({"--wind", "--water"}),
            "--wind and --water cannot be given together; look at `mill --help`");
  EXPECT_EQ(refusal({"--sieves", "1", "--grain", "rye"}),
            "--grain and --sieves cannot be given together; look at `mill --help`");
}

TEST(CommandLine, AnOptionThatNeedsAnotherIsToldWithALineToType) {
  EXPECT_EQ(refusal({"--speed", "3"}), "--speed requires --wind; type for example `mill --speed 3 --wind`");
}

TEST(CommandLine, WhatAFunctionSaysOfAValueIsToldBehindTheOption) {
  EXPECT_EQ(refusal({"--sacks", "two"}), "--sacks: 'two' is not all; look at `mill --help`");
  EXPECT_EQ(refusal({"--for", "x"}), "--for: it is too short; look at `mill --help`");
}

TEST(CommandLine, OtherErrorsOfAFunctionAreThrownAsTheyAre) {
  Mill m;
  try {
    m.line.parse({"--sacks", "none"});
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(e.fault().code, FaultCode::bad_configuration);
  }
}

TEST(CommandLine, AnOptionThatIsGivenTwiceIsRefused) {
  EXPECT_EQ(refusal({"--stones", "1", "--stones", "2"}),
            "--stones is given 2 times; once is enough; look at `mill --help`");
}

TEST(CommandLine, AWordThatNobodyTakesIsRefused) {
  EXPECT_EQ(refusal({"flour"}), "no option and no command takes the word 'flour'; look at --help");
}

TEST(CommandLine, TheHelpHasWhatWasSaidOfTheOptions) {
  const std::string help = Mill().line.help_asked(std::vector<std::string>{"-h"}).value();
  for (const char* part :
       {"mills\n", "--grain GRAIN:{rye,wheat}", "--crust TEXT:{hard,soft} ", "--stones INT:INT in [1 - 4]",
        "--hours FLOAT:FLOAT in [0.5 - 2.5]=1", "Excludes: --wind", "Needs: --wind", "who gets it", "--by"})
    EXPECT_NE(help.find(part), std::string::npos) << part << " is not in\n" << help;
  for (const char c : help) EXPECT_TRUE(c == '\n' || (c >= ' ' && c <= '~')) << static_cast<int>(c);
}

TEST(CommandLine, AnUnknownOptionOfAProgramIsToldBeforeAnythingElse) {
  const char* words[]{"bake", "--ovne=old"};
  try {
    Bakery().line.refuse_unknown_options(2, words);
    ADD_FAILURE();
  } catch (const FaultError& e) {
    EXPECT_EQ(std::string(e.what()), "there is no option '--ovne'; did you mean '--oven'?");
  }
  const char* behind[]{"bake", "--", "--ovne=old"};
  EXPECT_NO_THROW(Bakery().line.refuse_unknown_options(3, behind));
}

TEST(CommandLine, HelpMayWaitForTheOptionsBeforeIt) {
  const char* right[]{"mill", "--stones", "2", "--help"};
  const auto help = Mill().line.parse_or_help(4, right);
  ASSERT_TRUE(help);
  EXPECT_EQ(help->find("mills\n"), 0U);
  const char* wrong[]{"mill", "--stones", "5", "--help"};
  EXPECT_THROW(static_cast<void>(Mill().line.parse_or_help(4, wrong)), FaultError);
}

TEST(CommandLine, ACommandMayTakeItsWordsUnread) {
  CommandLine line("bakes", "bake");
  line.footer("the end");
  CommandLine& tool = line.subcommand("tool", "of another");
  tool.take_words_unread();
  std::vector<std::string> words;
  tool.when_given([&] { words = tool.remaining(); });
  line.parse({"tool", "--its", "own", "--help"});
  EXPECT_EQ(words, (std::vector<std::string>{"--its", "own", "--help"}));
  ASSERT_EQ(line.subcommands().size(), 1U);
  EXPECT_EQ(line.subcommands()[0]->name(), "tool");
  EXPECT_EQ(line.subcommands()[0]->about(), "of another");
  EXPECT_EQ(line.subcommands()[0]->long_options(), std::vector<std::string>{});
  EXPECT_EQ(line.long_options(), std::vector<std::string>{"--help"});
}

TEST(CommandLine, HelpIsAskedForByAnyWordBeforeTheOneThatEndsOptions) {
  EXPECT_TRUE(asks_for_help({"a", "-h"}));
  EXPECT_TRUE(asks_for_help({"--help", "--", "x"}));
  EXPECT_FALSE(asks_for_help({"a", "--", "-h"}));
  EXPECT_FALSE(asks_for_help({"--helps"}));
  EXPECT_FALSE(asks_for_help({}));
}

TEST(CommandLine, HelpOfACommandIsItsOwnAndNamesTheWholeLine) {
  const std::string sort = Bakery().line.help_asked(std::vector<std::string>{"sort", "--help"}).value();
  EXPECT_NE(sort.find("into boxes"), std::string::npos) << sort;
  EXPECT_EQ(sort.find("bakes one"), std::string::npos);
  EXPECT_NE(sort.find("bake sort"), std::string::npos) << sort;
  const std::string whole = Bakery().line.help_asked(std::vector<std::string>{"--help"}).value();
  EXPECT_NE(whole.find("bread"), std::string::npos);
  EXPECT_NE(whole.find("--oven NAME"), std::string::npos) << whole;
  EXPECT_FALSE(Bakery().line.help_asked(std::vector<std::string>{"sort"}));
}

TEST(CommandLine, ALineWithoutANameOfItsOwnIsCalledAsTheProgramIs) {
  CommandLine line("does things");
  const char* words[]{"anything", "--help"};
  const auto help = line.help_asked(2, words);
  ASSERT_TRUE(help);
  EXPECT_NE(help->find("base_test"), std::string::npos) << *help;
  EXPECT_EQ(line.name(), "base_test");
  const char* none[]{"anything"};
  EXPECT_FALSE(line.help_asked(1, none));
  EXPECT_FALSE(line.help_asked(0, none));
}

TEST(CommandLine, ASubcommandThatNeedNotBeGivenMayBeLeftOut) {
  for (const bool required : {false, true}) {
    CommandLine line("bakes", "bake");
    line.take_one_subcommand(required);
    line.subcommand("bread", "one");
    line.subcommand("cake", "one");
    if (required) {
      EXPECT_THROW(line.parse(std::vector<std::string>{}), FaultError);
    } else {
      EXPECT_NO_THROW(line.parse(std::vector<std::string>{}));
    }
    EXPECT_NO_THROW(line.parse(std::vector<std::string>{"cake"}));
    EXPECT_THROW(line.parse(std::vector<std::string>{"cake", "bread"}), FaultError) << "one at a time";
  }
}

TEST(CommandLine, AnExampleOfTheCommandIsGivenBeforeAnyOtherThatHasTheWord) {
  const Examples examples{"bake cake --degrees 180", "bake bread rye --degrees 230"};
  EXPECT_NE(Bakery().said_of({"bread", "rye", "--degrees"}, examples).find("`bake bread rye --degrees 230`"),
            std::string::npos);
  EXPECT_NE(Bakery()
                .said_of({"bread", "rye", "--degrees"}, {"bake cake --degrees 180"})
                .find("`bake cake --degrees 180`"),
            std::string::npos);
}

TEST(CommandLine, LinesOfHelpStandInTwoColumns) {
  EXPECT_EQ(explained({{"./run a", "does"}, {"./run longer", "does more"}, {"./run bare", ""}}),
            "  ./run a        does\n  ./run longer   does more\n  ./run bare\n");
  EXPECT_EQ(explained({}), "");
}

TEST(CommandLine, NamesAreListedAsAPersonSaysThem) {
  EXPECT_EQ(listed({}), "");
  EXPECT_EQ(listed({"rye"}), "rye");
  EXPECT_EQ(listed({"rye", "wheat"}), "rye and wheat");
  EXPECT_EQ(listed({"rye", "wheat", "oats"}), "rye, wheat and oats");
}

TEST(CommandLine, WordsThatAreTakenUnreadMayLookLikeOptionsOfTheProgram) {
  Bakery bakery;
  CommandLine& tool = bakery.line.subcommand("tool", "of another");
  tool.take_words_unread();
  std::vector<std::string> words;
  tool.when_given([&] { words = tool.remaining(); });
  bakery.line.parse({"tool", "--oven", "old"});
  EXPECT_EQ(words, (std::vector<std::string>{"--oven", "old"}));
  EXPECT_EQ(bakery.oven, "");
}

}  // namespace
}  // namespace mrroc::test
