// Style sheets and sizes: which rules hide an element, and what lengths are of.
#include <gtest/gtest.h>

#include <cmath>

#include "tasks/drawing/strokes.hpp"
#include "tasks/drawing/svg.hpp"

namespace mrroc::drawing {
namespace {

/// @return whether the line is drawn beside a path that always is
bool drawn(const std::string& css, const std::string& line = "<line id='b' class='a h' x2='5'/>") {
  return parse_svg(
             "<svg><style>" + css + "</style><path d='M0 0H9V9' style='display:inline'/>" + line + "</svg>",
             "f.svg")
             .size() == 2;
}

TEST(SvgStyle, CommentsAreNoPartOfIt) {
  EXPECT_FALSE(drawn("/* a */.h{/**/display:/* b */none}/* c */"));
  EXPECT_FALSE(drawn(".h/* .x */{display:none}"));
  EXPECT_TRUE(drawn("/* .h{display:none} */"));
  EXPECT_FALSE(drawn(".h{display:none} /* without an end"));
  EXPECT_TRUE(drawn("/*/ .h{display:none} /*/"));
}

TEST(SvgStyle, RulesOfMediaAndTheLikeArePassedOver) {
  EXPECT_TRUE(drawn("@media print{.a{x:y} .h{display:none}}"));
  EXPECT_FALSE(drawn("@media print{.a{x:y} .h{x:y}} .h{display:none}"));
  EXPECT_FALSE(drawn("@import 'x.css'; .h{display:none}"));
  EXPECT_FALSE(drawn("@import 'x.css';.h{display:none}"));
  EXPECT_TRUE(drawn("@import 'x.css' .h{display:none}"));
}

TEST(SvgStyle, ARuleIsForEverySelectorOfItsList) {
  for (const char* const list : {".h", ".x,.h", ".h,.x", ".x , .h , .y", ".h,", ",.h", "g,line"})
    EXPECT_FALSE(drawn(std::string(list) + "{display:none}")) << list;
  EXPECT_TRUE(drawn(".x,.y,g{display:none}"));
}

TEST(SvgStyle, AllPartsOfASelectorHaveToFit) {
  for (const char* const fits :
       {"line", ".a", ".h", ".a.h", ".h.a", "#b", "line.a", "line#b.h", "#b.a.h", "*", "*.a"})
    EXPECT_FALSE(drawn(std::string(fits) + "{display:none}")) << fits;
  for (const char* const fits_not :
       {"path#b", "g.a", ".a.x", ".x.a", "#c", "#c.a", "line#c", "lin", "lines", ".aa"})
    EXPECT_TRUE(drawn(std::string(fits_not) + "{display:none}")) << fits_not;
}

TEST(SvgStyle, ClassesAreWordsOfAList) {
  const auto of_class = [](const std::string& classes) {
    return !drawn(".h{display:none}", "<line class='" + classes + "' x2='5'/>");
  };
  for (const char* const with : {"h", " h ", "a h", "h a", "a h b", "a\th", "hh h"})
    EXPECT_TRUE(of_class(with)) << with;
  for (const char* const without : {"", " ", "hh", "a-h", "H", "ah", "h1"})
    EXPECT_FALSE(of_class(without)) << without;
}

TEST(SvgStyle, NamesHaveLettersDigitsHyphensAndWhatIsNotAscii) {
  for (const std::string name : {"a-b", "a_b", "a1", "\xc5\xbc", "-x", "Z9"})
    EXPECT_FALSE(drawn("." + name + "{display:none}", "<line class='" + name + "' x2='5'/>")) << name;
}

TEST(SvgStyle, AnIdCountsMoreThanClassesAndTheseMoreThanAName) {
  const auto wins = [](const std::string& strong, const std::string& weak) {
    const std::string hides = "{display:none}", shows = "{display:inline}";
    return !drawn(strong + hides + weak + shows) && drawn(strong + shows + weak + hides);
  };
  EXPECT_TRUE(wins("#b", ".a.h"));
  EXPECT_TRUE(wins("#b", "line.a.h"));
  EXPECT_TRUE(wins("#b.a", "#b"));
  EXPECT_TRUE(wins(".a.h", ".h"));
  EXPECT_TRUE(wins(".a", "line"));
  EXPECT_TRUE(wins("line.a", ".a"));
  EXPECT_TRUE(wins("line", "*"));
  EXPECT_FALSE(wins(".a", ".h")) << "of equals the later one";
  EXPECT_FALSE(wins("*.a", ".h")) << "any name is none";
}

TEST(SvgStyle, ARuleOfDisplayAloneSaysNothingOfVisibility) {
  EXPECT_FALSE(drawn(".h{visibility:hidden}.h{display:inline}"));
  EXPECT_FALSE(drawn(".h{display:none}.h{visibility:visible}"));
  EXPECT_FALSE(drawn(".h{visibility:hidden;display:inline}"));
  EXPECT_FALSE(drawn(".h{visibility:visible;display:none}"));
}

TEST(SvgStyle, ABlockWithoutAnEndReachesToTheEndOfTheSheet) {
  EXPECT_FALSE(drawn(".h{display:none"));
  EXPECT_FALSE(drawn(".h{display:none;"));
  EXPECT_TRUE(drawn(".x{a:b .h{display:none}"));
}

TEST(SvgStyle, ASelectorHasUpToThirtyTwoParts) {
  const auto parts = [](int count) {
    std::string selector;
    for (int k = 0; k < count; ++k) selector += ".h";
    return selector + "{display:none}";
  };
  EXPECT_FALSE(drawn(parts(32)));
  EXPECT_TRUE(drawn(parts(33)));
}

TEST(SvgStyle, WhatIsNotUnderstoodIsCounted) {
  std::string ignored;
  (void)parse_svg(
      "<svg><style>g line{display:none} a:hover,.{display:none} #{display:none} *x{display:none}"
      "g>line{stroke:red}</style><line x2='5'/></svg>",
      "f.svg", kDefaultSize, &ignored);
  EXPECT_EQ(ignored, "style rule (5)");
}

/// Beside a frame of 100 by 100 in a page of 30 by 40: one unit is a millimetre.
Drawing on_page(const std::string& element) {
  Drawing d =
      parse_svg("<svg viewBox='0 0 30 40'><path d='M 0 0 H 100 V 100'/>" + element + "</svg>", "f.svg", 100);
  d.erase(d.begin());
  return d;
}
Point size_of(const std::string& element) { return bounds(on_page(element)).sizes(); }

void expect_size(const std::string& element, double width, double height) {
  const Point size = size_of(element);
  EXPECT_NEAR(size.x(), width, 0.1) << element;
  EXPECT_NEAR(size.y(), height, 0.1) << element;
}

TEST(SvgSizes, PerCentAreOfThePagesWidthHeightAndDiagonal) {
  expect_size("<line x2='50%'/>", 15, 0);
  expect_size("<line y2='50%'/>", 0, 20);
  expect_size("<rect width='10%' height='10%'/>", 3, 4);
  expect_size("<ellipse cx='50' cy='50' rx='10%' ry='10%'/>", 6, 8);
  const double diagonal = 50 / std::sqrt(2.);
  expect_size("<circle cx='50' cy='50' r='20%'/>", 0.4 * diagonal, 0.4 * diagonal);
}

TEST(SvgSizes, OneRadiusOfAnEllipseStandsForBoth) {
  expect_size("<ellipse cx='50' cy='50' rx='5'/>", 10, 10);
  expect_size("<ellipse cx='50' cy='50' ry='7'/>", 14, 14);
  expect_size("<ellipse cx='50' cy='50' rx='auto' ry='7'/>", 14, 14);
  expect_size("<ellipse cx='50' cy='50' rx='5' ry='auto'/>", 10, 10);
  expect_size("<ellipse cx='50' cy='50' rx='5' ry='7'/>", 10, 14);
}

/// @return the way once around a rectangle of 40 by 20 mm
double length_of_rect(const std::string& radii) {
  return length(on_page("<rect x='2' y='3' width='40' height='20' " + radii + "/>")[0]);
}

TEST(SvgSizes, ARadiusOfARectangleStandsForBothAndIsAtMostHalfASide) {
  const double sharp = 120, round4 = sharp - 8 * 4 + 2 * 3.14159265 * 4;
  EXPECT_NEAR(length_of_rect(""), sharp, 1e-9);
  EXPECT_NEAR(length_of_rect("rx='4'"), round4, 0.1);
  EXPECT_NEAR(length_of_rect("ry='4'"), round4, 0.1);
  EXPECT_NEAR(length_of_rect("rx='4' ry='4'"), round4, 0.1);
  EXPECT_NEAR(length_of_rect("rx='auto' ry='4'"), round4, 0.1);
  EXPECT_NEAR(length_of_rect("rx='4' ry='0'"), sharp, 1e-9);
  EXPECT_NEAR(length_of_rect("rx='0' ry='4'"), sharp, 1e-9);
  EXPECT_NEAR(length_of_rect("rx='10' ry='99'"), length_of_rect("rx='10'"), 1e-9);
  EXPECT_NEAR(length_of_rect("rx='99' ry='10'"), length_of_rect("rx='20' ry='10'"), 1e-9);
}

TEST(SvgSizes, TheCornersOfARoundRectangleHaveBothRadii) {
  const Drawing d = on_page("<rect x='20' y='35' width='60' height='30' rx='15' ry='5'/>");
  EXPECT_EQ(d.at(0).front(), d.at(0).back()) << "closed, whatever was rounded";
  const NearestPoint outline(d[0]);
  const double r = std::sqrt(0.5);
  for (const double sx : {-1., 1.})
    for (const double sy : {-1., 1.})
      EXPECT_LT(outline.distance(Point(sx * (15 + 15 * r), sy * (10 + 5 * r))), kFlatness);
}

TEST(SvgSizes, NegativeOnesAreNamed) {
  for (const char* const element : {"<rect width='-1' height='9'/>", "<rect width='9' height='-1'/>",
                                    "<rect width='9' height='9' ry='-1'/>", "<ellipse rx='-1' ry='2'/>",
                                    "<ellipse rx='1' ry='-2'/>", "<circle r='-1'/>"}) {
    std::string error;
    try {
      (void)on_page(element);
    } catch (const FileError& e) {
      error = e.what();
    }
    EXPECT_NE(error.find("is negative"), std::string::npos) << element;
  }
}

}  // namespace
}  // namespace mrroc::drawing
