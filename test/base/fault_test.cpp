#include "base/fault.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <utility>

#include "test/base/fault_document.hpp"

namespace mrroc::test {
namespace {

const std::string kDocument = std::string(MRROC_SOURCE_DIR) + "/docs/faults.md";

Fault example() {
  return {.code = FaultCode::out_of_limits,
          .process = "edp arm1",
          .axis = 4,
          .value = 6.25,
          .limit = 4.712,
          .text = "joint position, rad"};
}

bool is_lower_case_name(std::string_view name) {
  for (const char c : name)
    if (c != '_' && std::islower(static_cast<unsigned char>(c)) == 0) return false;
  return !name.empty();
}

TEST(FaultTable, HasAUniqueNameATextAndARemedyForEveryCode) {
  std::set<std::string_view> names;
  std::set<std::string_view> texts;
  for (const FaultEntry& entry : all_faults()) {
    EXPECT_TRUE(is_lower_case_name(entry.name)) << entry.name;
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_TRUE(texts.insert(entry.text).second) << entry.name;
    EXPECT_FALSE(entry.remedy.empty()) << entry.name;
    for (const std::string_view part : {entry.text, entry.remedy})
      EXPECT_EQ(part.find_first_of("|\n"), std::string_view::npos) << entry.name;
  }
}

/// All of the project's own sources but the table itself.
std::string sources() {
  std::ostringstream all;
  for (const char* folder : {"base", "edp", "ecp", "mp", "vsp", "robots", "sim", "tasks", "ui_cli"})
    for (const auto& entry :
         std::filesystem::recursive_directory_iterator(std::filesystem::path(MRROC_SOURCE_DIR) / folder)) {
      const auto& file = entry.path();
      if (file.stem() == "fault" || file.stem() == "fault_table" || file.stem() == "vocabulary") continue;
      if (file.extension() == ".cpp" || file.extension() == ".hpp") all << std::ifstream(file).rdbuf();
    }
  return all.str();
}

/// @return how a task calls its code "lost_tool": kLostTool
std::string constant(const std::string& name) {
  std::string result = "k";
  bool first = true;
  for (const char c : name) {
    if (c != '_') result += static_cast<char>(first ? std::toupper(static_cast<unsigned char>(c)) : c);
    first = c == '_';
  }
  return result;
}

TEST(FaultTable, HasNoCodeThatNobodyRaises) {
  const std::string text = sources();
  for (const FaultEntry& entry : all_faults()) {
    const std::string name(entry.name);
    EXPECT_TRUE(text.find("FaultCode::" + name) != std::string::npos ||
                text.find("F::" + name) != std::string::npos ||
                text.find(constant(name)) != std::string::npos)
        << name;
  }
}

TEST(FaultTable, FindsEveryCodeByNumberAndByName) {
  for (const FaultEntry& entry : all_faults()) {
    EXPECT_EQ(fault_code(static_cast<std::int64_t>(entry.code)), entry.code);
    EXPECT_EQ(fault_code(entry.name), entry.code);
    EXPECT_EQ(to_string(entry.code), entry.name);
  }
}

TEST(FaultTable, RefusesNumbersAndNamesThatAreNotThere) {
  const auto size = static_cast<std::int64_t>(kFaultNumbers);
  for (const std::int64_t number :
       {std::int64_t{-1}, static_cast<std::int64_t>(kFirstTaskFault) - 1, size, size + 65536,
        std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()})
    EXPECT_EQ(fault_code(number), std::nullopt) << number;
  EXPECT_EQ(fault_code("lost_comand"), std::nullopt);
  EXPECT_EQ(fault_entry(static_cast<FaultCode>(9999)).code, FaultCode::internal_error);
}

// Numbers travel in messages and stand in logs: those of the tasks stay, wherever their rows are.
TEST(FaultTable, ErrorsOfTasksAreFoundByTheNumbersThatTheyAlwaysHad) {
  for (const auto& [number, name] :
       {std::pair(34, "no_plan"), std::pair(35, "grasp_missed"), std::pair(36, "face_jammed"),
        std::pair(37, "cube_slipped"), std::pair(38, "cube_dropped"), std::pair(39, "cube_misread"),
        std::pair(40, "start_failed"), std::pair(67, "bad_cube"), std::pair(68, "no_such_session"),
        std::pair(75, "excessive_torque")}) {
    ASSERT_TRUE(fault_code(std::int64_t{number})) << name;
    EXPECT_EQ(to_string(*fault_code(std::int64_t{number})), name);
    EXPECT_EQ(fault_code(std::string_view(name)), fault_code(std::int64_t{number}));
  }
  EXPECT_EQ(exit_status(*fault_code(std::string_view("bad_cube"))), 2) << "as other wrong input";
  EXPECT_EQ(exit_status(*fault_code(std::string_view("face_jammed"))), 1);
}

TEST(FaultTableDeathTest, ANumberOrANameThatIsTakenEndsTheProgramAtItsStart) {
  const auto registers = [](FaultCode code, std::string_view name) {
    const std::array rows{FaultEntry{code, name, FaultClass::non_fatal, "it", "mend it", "it broke"}};
    const RegisteredFaults registered{rows};
  };
  EXPECT_DEATH(registers(FaultCode{34}, "another"), "another");
  EXPECT_DEATH(registers(FaultCode::over_current, "another"), "another");
  EXPECT_DEATH(registers(FaultCode{300}, "over_current"), "over_current");
  EXPECT_DEATH(registers(FaultCode{512}, "another"), "too large");
}

TEST(Fault, ARemedyBehindAQuestionIsASentenceOfItsOwn) {
  EXPECT_EQ(with_remedy("it broke", "mend it"), "it broke; mend it");
  EXPECT_EQ(with_remedy("no 'a'; did you mean 'b'?", "look at `x --help`"),
            "no 'a'; did you mean 'b'? Look at `x --help`");
  EXPECT_EQ(with_remedy("no 'a'; did you mean 'b'?", "`x` lists them"),
            "no 'a'; did you mean 'b'? `x` lists them");
  EXPECT_EQ(FaultError(FaultCode::bad_usage, "did you mean 'b'?", "give it").error_line(),
            "error: bad_usage: did you mean 'b'? Give it");
}

TEST(FaultTable, IsWhatTheDocumentSays) {
  if (std::getenv("MRROC_UPDATE_DOCS") != nullptr) std::ofstream(kDocument) << fault_document();
  std::stringstream text;
  text << std::ifstream(kDocument).rdbuf();
  EXPECT_TRUE(text.str() == fault_document()) << "run: MRROC_UPDATE_DOCS=1 ./run test -R FaultTable";
}

TEST(FaultTable, GivesTheExitStatusThatScriptsRelyOn) {
  EXPECT_EQ(exit_status(FaultCode::none), 0);
  EXPECT_EQ(exit_status(FaultCode::operator_stop), 1);
  EXPECT_EQ(exit_status(FaultCode::following_error), 1);
  EXPECT_EQ(exit_status(FaultCode::unreachable_pose), 1);
  EXPECT_EQ(exit_status(FaultCode::bad_usage), 2);
  EXPECT_EQ(exit_status(FaultCode::bad_drawing), 2);
  for (int code = static_cast<int>(FaultCode::bad_usage);
       code <= static_cast<int>(FaultCode::no_such_session); ++code)
    EXPECT_EQ(exit_status(static_cast<FaultCode>(code)), 2) << code;
  for (const FaultEntry& entry : all_faults()) {
    if (entry.code == FaultCode::none || exit_status(entry.code) == 2) continue;
    EXPECT_TRUE(entry.code < FaultCode::bad_usage || entry.code > FaultCode::no_such_session) << entry.name;
    EXPECT_EQ(exit_status(entry.code), entry.fault_class == FaultClass::system ? 3 : 1) << entry.name;
  }
  EXPECT_EQ(exit_status(FaultCode::bad_plan), 2);
  EXPECT_EQ(exit_status(FaultCode::bad_fragment), 1);
  EXPECT_EQ(exit_status(FaultCode::process_died), 3);
  EXPECT_EQ(exit_status(FaultCode::no_multicast), 3);
}

TEST(FaultTable, ClassesHaveTheirNames) {
  EXPECT_EQ(to_string(FaultClass::non_fatal), "non-fatal");
  EXPECT_EQ(to_string(FaultClass::fatal), "fatal");
  EXPECT_EQ(to_string(FaultClass::system), "system");
}

TEST(Fault, IsFalseOnlyWithoutACode) {
  EXPECT_FALSE(Fault{});
  EXPECT_TRUE(example());
}

TEST(Fault, IsDescribedWithClassCodeProcessAxisFiguresAndRemedy) {
  EXPECT_EQ(describe(example()),
            "non-fatal out_of_limits: edp arm1: a value of the command is outside its limits "
            "(axis 4, value 6.25, limit 4.712, joint position, rad); "
            "keep the command within the limits of the robot's configuration");
}

TEST(Fault, MakesTheLastLineOnStandardError) {
  EXPECT_EQ(error_line({.code = FaultCode::operator_stop}),
            "error: operator_stop: the operator stopped the task; start it again when ready");
}

TEST(Fault, SaysNothingAboutFiguresThatItDoesNotHave) {
  EXPECT_EQ(what_happened({.code = FaultCode::lost_command}), "a command is missing before this one");
  EXPECT_EQ(what_happened({.code = FaultCode::out_of_limits, .value = -0.5}),
            "a value of the command is outside its limits (value -0.5, limit 0)");
  EXPECT_EQ(what_happened({.code = FaultCode::not_finite, .axis = 0, .value = std::nan("")}),
            "a value of the command is not a finite number (axis 0, value nan)");
}

TEST(Fault, CannotSpeakToTheTerminal) {
  Fault fault = example();
  fault.process = "\x1b[2J";
  fault.text = "a\nerror: \x07\x9b";
  for (const std::string& line : {describe(fault), error_line(fault)})
    for (const char c : line) EXPECT_TRUE(c >= ' ' && c <= '~') << line;
}

TEST(Fault, CutsTextsThatAreTooLong) {
  const std::string long_text(500, 't');
  const Fault fault{.code = FaultCode::bad_usage, .process = long_text.c_str(), .text = long_text.c_str()};
  EXPECT_EQ(fault.process.view(), std::string(32, 't'));
  EXPECT_EQ(fault.text.view(), std::string(160, 't'));
}

TEST(FaultError, CarriesTheFaultAndItsWholeText) {
  const std::string long_text(300, 'x');
  const FaultError with_text(FaultCode::bad_configuration, long_text);
  EXPECT_EQ(with_text.what(), long_text);
  EXPECT_EQ(with_text.fault().code, FaultCode::bad_configuration);
  EXPECT_EQ(with_text.error_line(),
            "error: bad_configuration: " + long_text + "; correct the file or the --set option named");
  EXPECT_EQ(FaultError(example()).error_line(), error_line(example()));
}

TEST(FaultError, HasARemedyOfItsOwnWhereTheTableDoesNotFit) {
  const FaultError own(FaultCode::bad_script, "cannot read a", "check the name");
  EXPECT_EQ(own.error_line(), "error: bad_script: cannot read a; check the name");
  EXPECT_EQ(own.remedy(), "check the name");
  const FaultError none(FaultCode::bad_script, "cannot read a", "");
  EXPECT_EQ(none.remedy(), fault_entry(FaultCode::bad_script).remedy);
}

TEST(FixedText, ComparesByItsCharactersOnly) {
  FixedText<8> text = "abcdef";
  text = "ab";
  EXPECT_EQ(text, FixedText<8>("ab"));
  EXPECT_EQ(text.view(), "ab");
  EXPECT_TRUE(FixedText<8>{}.empty());
  EXPECT_EQ(FixedText<2>("abc").view(), "ab");
}

TEST(FaultError, ShowsNoControlCharactersOfWhatOthersWrote) {
  const FaultError error(FaultCode::bad_script, "a\x1b[2J.txt:1: '\xc2\x9b-\n-\x7f' of \xc3\xa4", "mend it");
  EXPECT_STREQ(error.what(), "a?[2J.txt:1: '?-?-?' of \xc3\xa4");
  EXPECT_EQ(error.error_line(), "error: bad_script: a?[2J.txt:1: '?-?-?' of \xc3\xa4; mend it");
}

}  // namespace
}  // namespace mrroc::test
