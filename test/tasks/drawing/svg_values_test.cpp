// Values of SVG attributes by themselves: numbers, lengths, transforms, and where an error is.
#include "tasks/drawing/svg_values.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace mrroc::drawing::svg {
namespace {

using Point = Eigen::Vector2d;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// @return what the error says; empty: there is none
std::string error_of(const std::function<void()>& read) {
  try {
    read();
  } catch (const BadValue& bad) {
    return bad.what();
  }
  return "";
}
std::string number_error(std::string_view text) {
  return error_of([&] { Scanner(text).number(); });
}
std::string transform_error(std::string_view text) {
  return error_of([&] { static_cast<void>(transform(text)); });
}

void expect_moved(std::string_view text, const Point& from, const Point& to) {
  EXPECT_LT((transform(text) * from - to).norm(), 1e-12) << text;
}

TEST(SvgNumbers, HaveSignsFractionsAndExponents) {
  const auto number = [](std::string_view text) { return Scanner(text).number(); };
  EXPECT_EQ(number("5"), 5);
  EXPECT_EQ(number("+5"), 5);
  EXPECT_EQ(number("-5.25"), -5.25);
  EXPECT_EQ(number("-.5"), -0.5);
  EXPECT_EQ(number("+.5e1"), 5);
  EXPECT_EQ(number("09"), 9);
  EXPECT_EQ(number("9e-1x"), 0.9);
}

TEST(SvgNumbers, OneThatIsNoneIsNamedWithItsPlace) {
  for (const char* const text : {"inf", "nan", "-inf", "-nan", "+-5", "-+5", "++5", "--5", "x", "/", ":"})
    EXPECT_EQ(number_error(text), std::string("expected a number at character 1: '") + text + "'");
  EXPECT_EQ(number_error(""), "expected a number at its end");
  for (const char* const text : {"+", "-", ".", "-.", "+.", "-.e1"})
    EXPECT_NE(number_error(text), "") << text;
  for (const char* const text : {"1e999", "-1e999", "1e-999"})
    EXPECT_EQ(number_error(text).substr(0, 27), "a number too large or too s") << text;
}

TEST(SvgNumbers, BeginWithADigitASignOrAPoint) {
  for (const char* const text : {"0", "9", "5", "+", "-", "."})
    EXPECT_TRUE(Scanner(text).at_number()) << text;
  for (const char* const text : {"", "/", ":", ",", "e", " 1", "*"})
    EXPECT_FALSE(Scanner(text).at_number()) << text;
}

TEST(SvgNumbers, AreSeparatedByWhiteSpaceAndAtMostOneComma) {
  EXPECT_EQ(numbers(" 1,2 3 ,\t4\r\n5\f-6"), (std::vector<double>{1, 2, 3, 4, 5, -6}));
  EXPECT_TRUE(numbers("").empty());
  EXPECT_TRUE(numbers(" \n").empty());
  for (const char* const text : {"1,,2", "1 ,, 2", "1,", "1 , ", ",1", "1 x"})
    EXPECT_NE(error_of([&] { static_cast<void>(numbers(text)); }), "") << text;
}

TEST(SvgScanner, TellsWhereItFailedAndTheNextTwentyCharacters) {
  Scanner s("ab");
  EXPECT_EQ(error_of([] { Scanner("x").fail("wrong"); }), "wrong at character 1: 'x'");
  const std::string text = "12345678901234567890123";
  Scanner longer(text);
  longer.take();
  longer.take();
  EXPECT_EQ(error_of([&] { longer.fail("wrong"); }), "wrong at character 3: '" + text.substr(2, 20) + "'");
  EXPECT_EQ(s.word(), "ab");
  EXPECT_EQ(error_of([&] { s.fail("wrong"); }), "wrong at its end");
}

TEST(SvgScanner, AWordIsOfLettersAndPerCent) {
  for (const char* const text : {"a", "z", "A", "Z", "%", "azAZ%"}) EXPECT_EQ(Scanner(text).word(), text);
  for (const char* const text : {"@", "[", "`", "{", "1", " ", ""})
    EXPECT_EQ(Scanner(text).word(), "") << text;
  Scanner s("mm 3");
  EXPECT_EQ(s.word(), "mm");
  EXPECT_FALSE(s.done());
  EXPECT_EQ(s.number(), 3);
  EXPECT_TRUE(s.done());
}

TEST(SvgScanner, AFlagIsOneDigit) {
  Scanner s("015");
  EXPECT_FALSE(s.flag());
  EXPECT_TRUE(s.flag());
  EXPECT_EQ(s.number(), 5);
  EXPECT_EQ(error_of([&] { s.flag(); }), "expected an arc flag, 0 or 1 at its end");
  EXPECT_EQ(error_of([] { Scanner("2").flag(); }), "expected an arc flag, 0 or 1 at character 1: '2'");
}

TEST(SvgScanner, PassesOneCharacterBehindWhiteSpaceAndNoOther) {
  Scanner s(" \t\r\n\f((");
  EXPECT_FALSE(s.pass(')'));
  EXPECT_TRUE(s.pass('('));
  EXPECT_TRUE(s.pass('('));
  EXPECT_FALSE(s.pass('('));
}

TEST(SvgLengths, AnInchIsAsLongInEveryUnit) {
  for (const char* const inch : {"96", "96px", "1in", "2.54cm", "25.4mm", "101.6Q", "72pt", "6pc", " 1in\n"})
    EXPECT_NEAR(length_of(inch, kUnknown), 96, 1e-12) << inch;
}

TEST(SvgLengths, PerCentAreOfTheWhole) {
  EXPECT_DOUBLE_EQ(length_of("25%", 40), 10);
  EXPECT_DOUBLE_EQ(length_of("-150%", 40), -60);
  EXPECT_EQ(error_of([] { static_cast<void>(length_of("25%", kUnknown)); }),
            "per cent of a page whose size is not given");
}

TEST(SvgLengths, WhatBelongsToNoneIsRefused) {
  const auto error = [](std::string_view text) {
    return error_of([&] { static_cast<void>(length_of(text, 40)); });
  };
  EXPECT_EQ(error("9em"), "the unit 'em' is not supported");
  EXPECT_EQ(error("9%%"), "the unit '%%' is not supported");
  EXPECT_EQ(error("9 mm"), "unexpected text at character 3: 'mm'");
  EXPECT_EQ(error("9mm,"), "unexpected text at character 4: ','");
  EXPECT_EQ(error(""), "expected a number at its end");
}

TEST(SvgTransforms, MoveAPointAsTheirNamesSay) {
  expect_moved("matrix(1 2 3 4 5 6)", {1, 0}, {6, 8});
  expect_moved("matrix(1 2 3 4 5 6)", {0, 1}, {8, 10});
  expect_moved("translate(3)", {1, 1}, {4, 1});
  expect_moved("translate(3 4)", {1, 1}, {4, 5});
  expect_moved("scale(2)", {1, 3}, {2, 6});
  expect_moved("scale(2 -3)", {1, 3}, {2, -9});
  expect_moved("rotate(90)", {1, 0}, {0, 1});
  expect_moved("rotate(90 1 2)", {3, 2}, {1, 4});
  expect_moved("skewX(45)", {1, 2}, {3, 2});
  expect_moved("skewY(45)", {1, 2}, {1, 3});
  for (const char* const text : {"", " ", "none", " none\n"}) expect_moved(text, {1, 2}, {1, 2});
}

TEST(SvgTransforms, OfAListTheLastIsDoneFirst) {
  expect_moved("translate(1 0) scale(2)", {1, 1}, {3, 2});
  expect_moved("scale(2),translate(1 0)", {1, 1}, {4, 2});
  expect_moved(" scale ( 2 , 3 ) translate(1,0) ", {1, 1}, {4, 3});
}

TEST(SvgTransforms, HaveAsManyNumbersAsTheyNeed) {
  for (const char* const wrong :
       {"matrix(1 2 3 4 5)", "matrix(1 2 3 4 5 6 7)", "translate(1 2 3)", "scale(1 2 3)", "rotate(1 2)",
        "rotate(1 2 3 4)", "skewX(1 2)", "skewY(1 2)", "turn(1)", "skewx(1)"}) {
    const std::string_view text = wrong;
    EXPECT_NE(transform_error(text).find("is not a transform at its end"), std::string::npos) << text;
  }
  EXPECT_EQ(transform_error("rotate(1 2)"), "'rotate' with 2 numbers is not a transform at its end");
  for (const char* const name : {"matrix", "translate", "scale", "rotate", "skewX", "skewY"})
    EXPECT_NE(transform_error(std::string(name) + "()"), "") << name;
}

TEST(SvgTransforms, WithoutTheirBracketsOrWithEmptyPlacesAreRefused) {
  for (const char* const text : {"scale", "scale 2", "(2)", "scale(2", "scale(2))", "scale(2) x", "2"})
    EXPECT_NE(transform_error(text), "") << text;
  for (const char* const text : {"scale(2,)", "scale(,2)", "scale(1,,2)"})
    EXPECT_EQ(transform_error(text).substr(0, 17), "expected a number") << text;
  EXPECT_EQ(transform_error("scale 2"), "expected a transform such as rotate(30) at character 7: '2'");
}

/// Where corners of a box {10, 20, 100, 50} are seen in a viewport of 200 x 400 or 400 x 150.
struct Seen {
  std::string_view preserve;
  double width, height;
  Point low, high;
};

TEST(SvgViewBox, IsFittedIntoItsViewportAndAlignedInIt) {
  const std::vector<double> box{10, 20, 100, 50};
  for (const Seen& seen : {Seen{"", 200, 400, {0, 150}, {200, 250}},
                           {"xMidYMid meet", 200, 400, {0, 150}, {200, 250}},
                           {"xMinYMin", 200, 400, {0, 0}, {200, 100}},
                           {"xMaxYMax meet", 200, 400, {0, 300}, {200, 400}},
                           {"xMinYMax", 400, 150, {0, 0}, {300, 150}},
                           {"xMaxYMin", 400, 150, {100, 0}, {400, 150}},
                           {"", 400, 150, {50, 0}, {350, 150}},
                           {"none", 400, 150, {0, 0}, {400, 150}},
                           {"none", 200, 400, {0, 0}, {200, 400}},
                           {"slice", 400, 150, {0, -25}, {400, 175}},
                           {"xMinYMin slice", 200, 400, {0, 0}, {800, 400}},
                           {"xMaxYMin slice", 200, 400, {-600, 0}, {200, 400}}}) {
    const Affine T = view_box(box, seen.preserve, seen.width, seen.height);
    EXPECT_LT((T * Point(10, 20) - seen.low).norm(), 1e-12) << seen.preserve << seen.width;
    EXPECT_LT((T * Point(110, 70) - seen.high).norm(), 1e-12) << seen.preserve << seen.width;
    EXPECT_EQ(T.matrix().row(2), Eigen::RowVector3d(0, 0, 1)) << "of an affine map";
    EXPECT_EQ(T.matrix()(0, 1), 0);
    EXPECT_EQ(T.matrix()(1, 0), 0);
  }
}

TEST(SvgStyles, TheLastValueOfAPropertyCounts) {
  EXPECT_EQ(style_property("display:none", "display"), "none");
  EXPECT_EQ(style_property("a:b; display : none ;c:d", "display"), "none");
  EXPECT_EQ(style_property("display:none;display:inline;a:b", "display"), "inline");
  EXPECT_EQ(style_property("display: none !important", "display"), "none");
  EXPECT_EQ(style_property("src:a:b", "src"), "a:b");
  for (const char* const style : {"", ";", "display", "xdisplay:none", "displayx:none", "none:display"})
    EXPECT_EQ(style_property(style, "display"), "") << style;
  EXPECT_EQ(style_property("display:", "display"), "");
}

}  // namespace
}  // namespace mrroc::drawing::svg
