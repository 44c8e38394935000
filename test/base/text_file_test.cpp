// Files of people: what is no file, or too much of one, is named and hangs nobody.
#include "base/text_file.hpp"

#include <gtest/gtest.h>
#include <sys/fsuid.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <span>
#include <tuple>
#include <vector>

#include "base/config.hpp"
#include "base/fault.hpp"

namespace mrroc::test {
namespace {

namespace fs = std::filesystem;

class TextFile : public ::testing::Test {
 protected:
  TextFile() {
    std::string pattern = (fs::temp_directory_path() / "text_file_test.XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    std::ofstream(folder_ / "five") << "12345";
    std::ofstream(folder_ / "empty") << "";
    fs::create_symlink("five", folder_ / "link");
    fs::create_symlink("nowhere", folder_ / "dangling");
    fs::create_symlink("circle", folder_ / "circle");
    if (::mkfifo((folder_ / "pipe").c_str(), 0600) != 0) ADD_FAILURE() << "no pipe";
  }
  ~TextFile() override { fs::remove_all(folder_); }

  std::string error_of(const fs::path& file, std::size_t limit = 100) const {
    try {
      (void)read_text_file(folder_ / file, limit);
    } catch (const FileError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with((folder_ / file).string())) << error.what();
      EXPECT_FALSE(error.remedy().empty());
      return error.wrong().substr((folder_ / file).string().size());
    }
    return {};
  }

  fs::path folder_;
};

TEST_F(TextFile, IsReadWholeAlsoByALink) {
  EXPECT_EQ(read_text_file(folder_ / "five", 5), "12345");
  EXPECT_EQ(read_text_file(folder_ / "link", 5), "12345");
  EXPECT_EQ(read_input_file(folder_ / "empty", 5, FaultCode::bad_script), "");
}

TEST_F(TextFile, WhatIsNoFileIsNamedAndNobodyWaitsForIt) {
  EXPECT_EQ(error_of("pipe"), ": this is not a file");
  EXPECT_EQ(error_of("/dev/zero"), ": this is not a file");
  EXPECT_EQ(error_of("."), ": this is not a file but a folder");
  for (const char* missing : {"nothing", "dangling", "circle", "five/x"})
    EXPECT_EQ(error_of(missing), ": there is no such file") << missing;
  EXPECT_EQ(error_of("empty"), ": the file is empty");
  EXPECT_EQ(error_of("five", 4), ": 5 bytes are over the limit of 4");
}

TEST_F(TextFile, ThatIsThereAndCannotBeOpenedIsToldFromOneThatEndsTooEarly) {
  fs::permissions(folder_, fs::perms::all);
  fs::permissions(folder_ / "five", fs::perms::none);
  // Permissions stop nobody who is root, so that root opens files as somebody else.
  constexpr uid_t kNobody = 65534;
  const auto self = static_cast<uid_t>(::setfsuid(kNobody));
  const std::string error = error_of("five");
  ::setfsuid(self);
  EXPECT_EQ(error, ": the file cannot be read");
}

TEST_F(TextFile, FaultsHaveTheCodeThatIsAskedFor) {
  for (const char* file : {"pipe", "/dev/zero", ".", "nothing", "dangling"}) {
    try {
      (void)read_input_file(folder_ / file, 100, FaultCode::bad_script);
      ADD_FAILURE() << file;
    } catch (const FaultError& error) {
      EXPECT_EQ(error.fault().code, FaultCode::bad_script) << file;
      EXPECT_NE(std::string(error.what()).find((folder_ / file).string()), std::string::npos) << error.what();
    }
    EXPECT_THROW((void)Config::load(folder_ / file), FaultError) << file;
  }
}

TEST_F(TextFile, IsWrittenWholeOverTheOneBefore) {
  write_text_file(folder_ / "five", std::string("a\0b\n", 4));
  EXPECT_EQ(read_text_file(folder_ / "five", 4), std::string("a\0b\n", 4));
  EXPECT_FALSE(fs::exists(folder_ / "five.part"));
}

TEST_F(TextFile, WhatCannotBeWrittenIsAFaultAndLeavesNothing) {
  fs::create_directory(folder_ / "full");
  std::ofstream(folder_ / "full" / "x") << "x";
  for (const fs::path& file : {folder_ / "no" / "such", folder_ / "full"}) {
    try {
      write_text_file(file, "text");
      ADD_FAILURE() << file;
    } catch (const FaultError& error) {
      EXPECT_EQ(error.fault().code, FaultCode::cannot_write);
      EXPECT_NE(std::string(error.what()).find(file.string()), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(file.string() + ".part"));
  }
}

/// @return the line and what is wrong there, as f says it; empty: nothing is
template <class F>
std::string error_text(F f) {
  try {
    f();
  } catch (const FileError& error) {
    return error.wrong();
  }
  return {};
}

TEST(Lines, AreGivenOneByOneAndCountedFromOne) {
  Lines lines("one\n\nthree\nrest", "file");
  EXPECT_FALSE(lines.done());
  EXPECT_EQ(lines.next(), "one");
  EXPECT_EQ(lines.next(), "");
  EXPECT_EQ(lines.next(), "three");
  EXPECT_EQ(error_text([&] { lines.fail("it is odd"); }), "file:3: it is odd");
  EXPECT_EQ(error_text([&] { lines.next(); }), "file:4: the file ends too early");
  Lines all("one\n", "file");
  all.next();
  EXPECT_TRUE(all.done());
}

TEST(Lines, NumbersAreAsManyAsAreAskedForAndTheRestIsReturned) {
  const Lines lines("", "file");
  std::vector<double> v(3);
  EXPECT_EQ(lines.numbers("1,-2.5,3e2", ',', v), "");
  EXPECT_EQ(v, (std::vector<double>{1, -2.5, 300}));
  EXPECT_EQ(lines.numbers("4,5,6,7", ',', v), ",7");
  EXPECT_EQ(v, (std::vector<double>{4, 5, 6}));
  EXPECT_EQ(lines.numbers("anything", ',', std::span<double>()), "anything");
  const auto wrong = [&](const char* text) { return error_text([&] { lines.numbers(text, ',', v); }); };
  EXPECT_EQ(wrong("1,2"), "file: 2 numbers instead of 3");
  EXPECT_EQ(wrong("1"), "file: 1 numbers instead of 3");
  for (const auto& [text, field] :
       {std::pair("1,,3", ""), std::pair("1,x,3", "x"), std::pair("1,2 ,3", "2 "),
        std::pair("nan,2,3", "nan"), std::pair("1,inf,3", "inf"), std::pair("1,2,1e999", "1e999")})
    EXPECT_EQ(wrong(text), "file: '" + std::string(field) + "' is not a finite number") << text;
}

TEST(Lines, CountsAreWholeNumbersUpToALimit) {
  const Lines lines("", "file");
  EXPECT_EQ(lines.count("0", 7), 0U);
  EXPECT_EQ(lines.count("7", 7), 7U);
  for (const char* text : {"8", "-1", "", "1.5", "7 ", " 7", "99999999999999999999999"})
    EXPECT_EQ(error_text([&] { std::ignore = lines.count(text, 7); }),
              "file: '" + std::string(text) + "' is not a whole number from 0 to 7");
}

TEST_F(TextFile, AnErrorShowsNoControlCharacters) {
  const FileError error("a\x1b]0;x\a.svg", 3, "'\xc2\x9b' of \xc3\xa4", "");
  EXPECT_STREQ(error.what(), "a?]0;x?.svg:3: '?' of \xc3\xa4");
  EXPECT_EQ(error.line(), 3);
  EXPECT_STREQ(FileError("f", 0, "is odd", "mend it").what(), "f: is odd; mend it");
  EXPECT_EQ(FileError("f", 0, "is odd", "mend it").wrong(), "f: is odd");
  EXPECT_EQ(FileError("f", 0, "is odd", "mend it").remedy(), "mend it");
}

}  // namespace
}  // namespace mrroc::test
