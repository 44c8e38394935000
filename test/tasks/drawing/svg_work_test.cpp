// Short files that ask for much: reading them ends soon, with an error that says so.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <ctime>

#include "tasks/drawing/svg.hpp"
#include "test/tasks/drawing/folder.hpp"

namespace mrroc::drawing {
namespace {

std::string repeated(const std::string& text, std::size_t count) {
  std::string result;
  result.reserve(text.size() * count);
  for (std::size_t k = 0; k < count; ++k) result += text;
  return result;
}

std::string svg(const std::string& elements) { return "<svg>" + elements + "</svg>"; }

/// @return what the error says; empty: there is none
std::string error_of(const std::string& text) {
  constexpr double kLongest = 30;  // [s] of the processor, also on a slow one and with sanitizers
  const std::clock_t begin = std::clock();
  std::string error;
  try {
    (void)parse_svg(text, "f.svg");
  } catch (const FileError& e) {
    error = e.what();
  }
  EXPECT_LT(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC, kLongest);
  return error;
}

constexpr const char* kTooMuch = "f.svg: reading it would take over 200 million steps; use fewer style rules";

void expect_too_much(const std::string& text) {
  EXPECT_EQ(error_of(text).substr(0, std::string_view(kTooMuch).size()), kTooMuch);
}

TEST(SvgWork, StyleRulesTimesElementsAreBounded) {
  std::string rules;
  for (int k = 0; k < 60'000; ++k) rules += ".c" + std::to_string(k) + "{display:inline}";
  expect_too_much(svg("<style>" + rules + "</style>" + repeated("<line class='a' x2='9'/>", 5000)));
}

TEST(SvgWork, StyleRulesThemselvesAreBounded) {
  expect_too_much(svg("<style>" + repeated("a{display:none}", 300'000) + "</style><line x2='9'/>"));
  // The declarations of a list are not kept once per selector.
  EXPECT_EQ(error_of(svg("<style>" + repeated("a,", 100'000) + "b{display:none;" +
                         std::string(5'000'000, 'x') + "}</style><line x2='9'/>")),
            "");
}

TEST(SvgWork, SelectorsWithManyPartsAreNotUnderstood) {
  std::string ignored;
  (void)parse_svg(svg("<style>" + repeated("#a", 1'000'000) + "{display:none}</style><line id='a' x2='9'/>"),
                  "f.svg", kDefaultSize, &ignored);
  EXPECT_EQ(ignored, "style rule (1)");
}

TEST(SvgWork, ClassesTimesRulesAreBounded) {
  expect_too_much(svg("<style>" + repeated(".b{display:none}", 1000) + "</style><line class='" +
                      repeated("a ", 200'000) + "' x2='9'/>"));
}

TEST(SvgWork, WhatUseRepeatsIsBounded) {
  const std::string uses = repeated("<use href='#a'/>", 10'000);
  expect_too_much(svg("<g id='a'>" + repeated("<z:z/>", 50'000) + "</g>" + uses));
  expect_too_much(svg("<line id='a' x2='9' " + repeated("b='' ", 50'000) + "/>" + uses));
  expect_too_much(svg("<path id='a' d='" + repeated("M1 1", 50'000) + "'/>" + uses));
  expect_too_much(svg("<line id='a' x2='9' style='" + repeated("a:b;", 50'000) + "'/>" + uses));
  expect_too_much(svg("<line id='a' x2='9' transform='" + repeated("scale(1)", 50'000) + "'/>" + uses));
  std::string laughs = "<g id='g0'><line x2='9' stroke='" + std::string(1000, 'x') + "'/></g>";
  for (int k = 1; k < 40; ++k)
    laughs += "<g id='g" + std::to_string(k) + "'>" +
              repeated("<use href='#g" + std::to_string(k - 1) + "'/>", 10) + "</g>";
  EXPECT_NE(error_of(svg(laughs)), "");
}

TEST(SvgWork, CurvesOfOneElementAreBounded) {
  EXPECT_NE(error_of(svg("<path d='M0 0" + repeated("L1 1", 2'000'000) + "'/>")).find("over 100000 curves"),
            std::string::npos);
  EXPECT_NE(
      error_of(svg("<polyline points='" + repeated("1 1 ", 2'000'000) + "'/>")).find("over 100000 curves"),
      std::string::npos);
}

TEST(SvgWork, EntitiesAreNotExpanded) {
  std::string laughs = "<!DOCTYPE svg [<!ENTITY l0 'M0 0'>";
  for (int k = 1; k < 30; ++k)
    laughs +=
        "<!ENTITY l" + std::to_string(k) + " '" + repeated("&l" + std::to_string(k - 1) + ";", 10) + "'>";
  const std::string error = error_of(laughs + "]>" + svg("<path d='&l29;'/>"));
  EXPECT_NE(error.find("path data has to begin with M or m"), std::string::npos) << error;
  EXPECT_EQ(error_of("<!DOCTYPE svg [<!ENTITY f SYSTEM 'file:///etc/passwd'>]>" + svg("<text>&f;</text>"))
                .find("root:"),
            std::string::npos);
}

TEST(SvgWork, ErrorsAndRemarksAreShortAndCannotSpeakToTheTerminal) {
  const std::string many(1'000'000, 'n');
  for (const std::string& text :
       {"<" + many + "/>", svg("<use href='#" + many + "'/>"), svg("<line x2='9" + many + "'/>"),
        svg("<g transform='" + many + "(1)'/>"), svg("<" + many + " transform='x'/>"),
        svg("<path id='" + many + "' d='" + many + "'/>"), svg("<path d='M1 1 \x1b[2J'/>")}) {
    const std::string error = error_of(text);
    EXPECT_FALSE(error.empty()) << text.substr(0, 40);
    EXPECT_LT(error.size(), 300U) << text.substr(0, 40);
    EXPECT_EQ(error.find('\x1b'), std::string::npos);
  }
  std::string kinds = "<line x2='9'/>", ignored;
  for (int k = 0; k < 50'000; ++k) kinds += "<a\xc2\x9b" + std::to_string(k) + "/>";
  (void)parse_svg(svg(kinds), "f.svg", kDefaultSize, &ignored);
  EXPECT_LT(ignored.size(), 1000U);
  EXPECT_NE(ignored.find("other elements (49984)"), std::string::npos) << ignored;
  EXPECT_EQ(ignored.find('\x9b'), std::string::npos);
}

TEST(SvgWork, NumbersBeyondAllMeasureAreNamed) {
  for (const char* element : {"<line x1='-1e308' x2='1e308'/>", "<path d='M1e308 0 l1e308 0'/>",
                              "<circle r='1e308'/>", "<path d='M0 0 A 1e-300 1e300 7 1 1 9 9'/>",
                              "<line x2='1e-320'/>", "<path d='M0 0 C 1e308 1 -1e308 2 3 3'/>",
                              "<g transform='scale(1e200)'><line x2='9' transform='scale(1e200)'/></g>",
                              "<g transform='skewX(90)'><line x2='9' y2='1e300'/></g>",
                              "<svg viewBox='0 0 1e-310 1' width='9' height='9'><line x2='9'/></svg>"}) {
    const std::string error = error_of(svg(element));
    EXPECT_TRUE(error.empty() || error.starts_with("f.svg:")) << element << ": " << error;
  }
}

TEST(SvgWork, WhatIsNoFileHangsNobody) {
  const Folder folder;
  ASSERT_EQ(::mkfifo((folder / "pipe.svg").c_str(), 0600), 0);
  for (const std::filesystem::path& file :
       {folder / "pipe.svg", folder.path(), std::filesystem::path("/dev/zero")})
    EXPECT_THROW((void)read_svg(file), FileError) << file;
}

}  // namespace
}  // namespace mrroc::drawing
