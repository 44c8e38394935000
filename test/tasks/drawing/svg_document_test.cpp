// Drawn and ignored parts of a document, and the places of errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <vector>

#include "base/text_file.hpp"
#include "tasks/drawing/svg.hpp"

namespace mrroc::drawing {
namespace {

std::string svg(const std::string& elements) { return "<svg>\n" + elements + "\n</svg>\n"; }

/// @return what was passed over; the frame of the drawing is what else there is
std::string passed_over(const std::string& elements, std::size_t strokes = 1) {
  std::string ignored;
  EXPECT_EQ(parse_svg(svg("<path d='M 0 0 H 100 V 100'/>" + elements), "f.svg", 100, &ignored).size(),
            strokes)
      << elements;
  return ignored;
}

/// @return file, line and the whole text of the error
std::tuple<std::string, int, std::string> error_of(const std::string& text) {
  try {
    (void)parse_svg(text, "f.svg");
  } catch (const FileError& e) {
    return {e.file(), e.line(), e.what()};
  }
  return {};
}

using Error = std::tuple<std::string, int, std::string>;

// The categories of SVG 1.1 whose elements are never rendered themselves, appendix N, and what chapters 5, 8 and 11-20 say
// of the others: definitions, paint servers, effects, fonts, scripts and the interface.
TEST(SvgDocument, WhatTheStandardNeverRendersIsPassedOverInSilenceWithAllThatIsInIt) {
  const std::vector<std::string> descriptive{"desc", "metadata", "title"},
      animation{"animate", "animateColor", "animateMotion", "animateTransform", "set"},
      definitions{"defs", "symbol", "marker", "view"},
      paint{"linearGradient", "radialGradient", "pattern", "color-profile"},
      effects{"clipPath", "mask", "filter"}, others{"cursor", "font", "font-face", "script", "style"};
  for (const auto* const category : {&descriptive, &animation, &definitions, &paint, &effects, &others})
    for (const std::string& name : *category)
      EXPECT_EQ(passed_over("<" + name + "><line x2='9'/></" + name + ">"), "") << name;
}

TEST(SvgDocument, WhatHasNoOutlineIsToldByItsKindUpToSixteenOfThem) {
  EXPECT_EQ(passed_over("<set2/>"), "set2 (1)");
  EXPECT_EQ(passed_over("<" + std::string(41, 'x') + "/>"), std::string(40, 'x') + " (1)");
  std::string sixteen, told;
  for (char c = 'a'; c < 'a' + 16; ++c) {
    sixteen += std::string("<k") + c + "/>";
    told += std::string(told.empty() ? "k" : ", k") + c + " (1)";
  }
  EXPECT_EQ(passed_over(sixteen), told);
  EXPECT_EQ(passed_over(sixteen + "<ka/><y/><z/>"), "ka (2)" + told.substr(6) + ", other elements (2)");
}

TEST(SvgDocument, GroupsLinksAndSwitchesAreDrawnThrough) {
  for (const char* const name : {"g", "a", "switch", "svg"})
    EXPECT_EQ(passed_over(std::string("<") + name + "><line x2='9'/></" + name + ">", 2), "") << name;
}

TEST(SvgDocument, VisibilityIsInheritedAndCanBeTakenBack) {
  EXPECT_EQ(passed_over("<g visibility='hidden'><line x2='9'/></g>"), "");
  EXPECT_EQ(passed_over("<g visibility='hidden'><line x2='9' visibility='inherit'/></g>"), "");
  EXPECT_EQ(passed_over("<g visibility='hidden'><line x2='9' visibility='visible'/></g>", 2), "");
  EXPECT_EQ(passed_over("<g visibility='collapse'><line x2='9'/></g>"), "");
  EXPECT_EQ(passed_over("<g display='none'><line x2='9' display='inline'/></g>"), "");
  EXPECT_EQ(passed_over("<defs><symbol id='s' display='none'><line x2='9'/></symbol></defs><use href='#s'/>"),
            "");
  EXPECT_EQ(passed_over("<defs><symbol id='s'><line x2='9'/></symbol></defs><use href='#s'/>", 2), "");
}

TEST(SvgDocument, AnErrorHasItsFileItsLineAndWhatToDo) {
  EXPECT_EQ(error_of("\x1f\x8b\x08"),
            (Error{"f.svg", 0, "f.svg: the file is compressed (.svgz); unpack it with gunzip"}));
  EXPECT_EQ(error_of("hello"), (Error{"f.svg", 0, "f.svg: there is no XML element in it; give an SVG file"}));
  EXPECT_EQ(error_of("\n\n<html/>"),
            (Error{"f.svg", 3, "f.svg:3: <html> is not an SVG drawing; give an SVG file"}));
  EXPECT_EQ(
      error_of("<" + std::string(41, 'x') + "/>"),
      (Error{"f.svg", 1, "f.svg:1: <" + std::string(40, 'x') + "> is not an SVG drawing; give an SVG file"}));
  EXPECT_EQ(error_of(svg("\n<line x2='9em'/>")),
            (Error{"f.svg", 3, std::get<2>(error_of(svg("\n<line x2='9em'/>")))}));
  EXPECT_TRUE(std::get<2>(error_of(svg("<line x2='9em'/>"))).ends_with("; mend the value"));
  EXPECT_TRUE(std::get<2>(error_of("<svg transform='x'/>")).ends_with("; mend the value"));
  const auto [file, line, text] = error_of("<svg>\n<g></svg>");
  EXPECT_EQ(file, "f.svg");
  EXPECT_EQ(line, 2);
  EXPECT_TRUE(text.starts_with("f.svg:2: not well-formed XML: ")) << text;
  EXPECT_TRUE(text.ends_with("; mend it or export it again")) << text;
  EXPECT_EQ(text[std::string("f.svg:2: not well-formed XML: ").size()], 's') << "in small letters: " << text;
  EXPECT_EQ(error_of(svg("<use href='#gone'/>")),
            (Error{"f.svg", 2,
                   "f.svg:2: <use>: refers to '#gone', which is not in this file; add it or remove "
                   "the <use>"}));
  EXPECT_EQ(error_of(svg("<use href='#" + std::string(50, 'x') + "'/>")),
            (Error{"f.svg", 2,
                   "f.svg:2: <use>: refers to '#" + std::string(39, 'x') +
                       "', which is not in this file; add it or remove the <use>"}));
  EXPECT_NE(std::get<2>(error_of(svg("<use/>"))).find("refers to ''"), std::string::npos);
  EXPECT_NE(std::get<2>(error_of(svg("<line id='" + std::string(50, 'y') + "' x2='9em'/>")))
                .find("<line id=\"" + std::string(40, 'y') + "\">: "),
            std::string::npos);
}

TEST(SvgDocument, ElementsMayBeNestedSoDeepAndNoDeeper) {
  const auto nested = [](int groups) {
    std::string text = "<line x2='9'/>";
    for (int k = 0; k < groups; ++k) text = "<g>" + text + "</g>";
    return error_of("<svg>" + text + "</svg>");
  };
  EXPECT_EQ(nested(254), Error{}) << "with the svg and the line there are 256";
  EXPECT_EQ(std::get<2>(nested(255)),
            "f.svg:1: <line>: nested deeper than 256 elements; look for a <use> that contains itself");
}

TEST(SvgDocument, TooManyPointsHaveNoLine) {
  std::string circles;
  for (int k = 0; k < 200; ++k) circles += "<circle r='9'/>";
  const auto [file, line, text] = error_of(svg(circles));
  EXPECT_EQ(line, 0);
  EXPECT_NE(text.find("; simplify the drawing"), std::string::npos) << text;
}

TEST(SvgDocument, ASymbolHasTheSizeThatItsUseGives) {
  const auto width = [](const std::string& use) {
    const Drawing d = parse_svg(
        svg("<path d='M 0 0 H 100 V 100'/><defs><symbol id='s' width='50' height='50' viewBox='0 0 10 10'>"
            "<line x2='10'/></symbol></defs>" +
            use),
        "f.svg", 100);
    return d.size() == 2 ? (d[1].back() - d[1].front()).norm() : -1;
  };
  EXPECT_NEAR(width("<use href='#s'/>"), 50, 1e-9);
  EXPECT_NEAR(width("<use href='#s' width='20' height='20'/>"), 20, 1e-9);
  EXPECT_NEAR(width("<use xlink:href='#s' width='20' height='20'/>"), 20, 1e-9);
  EXPECT_NEAR(width("<use href='#s' width='20' height='40'/>"), 20, 1e-9) << "it fits into both";
  for (const char* box : {"0 0 0 10", "0 0 10 0", "0 0 -1 10"}) {
    std::string ignored;
    EXPECT_EQ(parse_svg(svg(std::string("<line x2='9'/><svg viewBox='") + box + "'><line x2='9'/></svg>"),
                        "f.svg", 100, &ignored)
                  .size(),
              1U)
        << box;
  }
  EXPECT_NE(std::get<2>(error_of(svg("<svg viewBox='0 0 9'><line x2='9'/></svg>")))
                .find("viewBox needs four numbers"),
            std::string::npos);
}

}  // namespace
}  // namespace mrroc::drawing
