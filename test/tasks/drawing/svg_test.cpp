#include "tasks/drawing/svg.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tasks/drawing/strokes.hpp"

namespace mrroc::drawing {
namespace {

constexpr double kPi = std::numbers::pi;

Drawing parse(const std::string& elements, double size = 120, std::string* ignored = nullptr) {
  return parse_svg("<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink'>" +
                       elements + "</svg>",
                   "test.svg", size, ignored);
}

Drawing path(const std::string& d, double size = 120) { return parse("<path d='" + d + "'/>", size); }

// Elements beside a frame from (0, 0) to (100, 100): one unit is one millimetre and the centre is (50, 50).
// The frame's stroke is dropped.
Drawing framed(const std::string& elements) {
  Drawing drawing = parse("<path d='M 0 0 H 100 V 100'/>" + elements, 100);
  drawing.erase(drawing.begin());
  return drawing;
}

void expect_same(const Drawing& a, const Drawing& b, double tolerance = 1e-9) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t s = 0; s < a.size(); ++s) {
    ASSERT_EQ(a[s].size(), b[s].size()) << s;
    for (std::size_t k = 0; k < a[s].size(); ++k) EXPECT_NEAR((a[s][k] - b[s][k]).norm(), 0, tolerance);
  }
}

// The largest distance of the polyline's points, and of the middles between them, from a circle [mm].
double off_circle(const Stroke& stroke, const Point& centre, double r) {
  double worst = 0;
  for (std::size_t k = 0; k < stroke.size(); ++k) {
    worst = std::max(worst, std::abs((stroke[k] - centre).norm() - r));
    if (k > 0) worst = std::max(worst, std::abs(((stroke[k] + stroke[k - 1]) / 2 - centre).norm() - r));
  }
  return worst;
}

TEST(Svg, LinesAreScaledCentredAndTurnedUp) {
  expect_same(path("M 0 0 L 10 0 L 10 5"), {{Point(-60, 30), Point(60, 30), Point(60, -30)}});
}

TEST(Svg, EverySubPathIsAStroke) {
  const Drawing d = framed("<path d='M 10 10 L 20 10 M 30 30 h 5 z l 0 5'/>");
  expect_same(d, {{Point(-40, 40), Point(-30, 40)},
                  {Point(-20, 20), Point(-15, 20), Point(-20, 20)},
                  {Point(-20, 20), Point(-20, 15)}});
}

TEST(Svg, RelativeCommandsDrawTheSameAsAbsoluteOnes) {
  expect_same(path("M 10 10 L 30 20 H 40 V 50 C 50 60 70 60 80 50 S 90 20 70 10 Q 60 5 50 20 T 20 30 A 30 20 "
                   "40 0 1 5 60 Z"),
              path("m10,10l20,10h10v30c10 10 30 10 40 0s10-30-10-40q-10-5-20 10t-30 10a30 20 40 01-15 30z"));
}

TEST(Svg, SmoothCommandsMirrorTheControlPointOnlyAfterTheirOwnKind) {
  expect_same(path("M 0 0 C 0 40 40 40 40 0 S 80 -40 80 0"),
              path("M 0 0 C 0 40 40 40 40 0 C 40 -40 80 -40 80 0"));
  expect_same(path("M 0 0 L 40 0 S 80 -40 80 0"), path("M 0 0 L 40 0 C 40 0 80 -40 80 0"));
  expect_same(path("M 0 0 Q 20 40 40 0 T 80 0"), path("M 0 0 Q 20 40 40 0 Q 60 -40 80 0"));
  expect_same(path("M 0 0 C 0 40 40 40 40 0 T 80 50"), path("M 0 0 C 0 40 40 40 40 0 Q 40 0 80 50"));
}

TEST(Svg, NumbersAfterAMoveAreLines) { expect_same(path("M 0 0 10 0 10 10"), path("M 0 0 L 10 0 L 10 10")); }

TEST(Svg, NumbersNeedNoSpaceBetweenThem) {
  expect_same(path("M10-5.5L.5.5L3e1+3-.5-1E0"), path("M 10 -5.5 L 0.5 0.5 L 30 3 L -0.5 -1"));
}

TEST(Svg, CurvesStayWithinTheFlatnessOfTheSheet) {
  for (const double size : {20.0, 120.0, 200.0}) {
    const Drawing circle = parse("<circle cx='3' cy='4' r='5000'/>", size);
    ASSERT_EQ(circle.size(), 1u);
    EXPECT_LE(off_circle(circle[0], Point(0, 0), size / 2), kFlatness);
    EXPECT_NEAR((circle[0].front() - circle[0].back()).norm(), 0, 1e-6);
    EXPECT_LE(circle[0].size(), 150u) << "far more points than the flatness needs";
  }
  // A cubic against a hundred times finer sampling of its own formula.
  const Drawing cubic = path("M 0 0 C 0 100 200 -100 100 50");
  Stroke exact;
  for (int k = 0; k <= 20000; ++k) {
    const double t = k / 20000.0;
    const double u = 1 - t;
    exact.emplace_back(600 * u * t * t + 100 * t * t * t,
                       -(300 * u * u * t - 300 * u * t * t + 50 * t * t * t));
  }
  const Drawing reference = fitted({exact}, 120);
  const NearestPoint flat(cubic[0]);
  for (const Point& p : reference[0]) ASSERT_LE(flat.distance(p), kFlatness);
}

TEST(Svg, ArcFlagsChooseOneOfFourArcs) {
  // From (40, 50) to (60, 50) with r = 20: centres lie 17.32 above and below the chord's middle.
  const double h = std::sqrt(300.0);
  struct Case {
    const char* flags;
    double centre_y;  // on the sheet
    double length;
  };
  const double angle = 2 * std::asin(0.5);
  for (const Case& c : {Case{"0 0", h, 20 * angle}, Case{"0 1", -h, 20 * angle},
                        Case{"1 0", -h, 20 * (2 * kPi - angle)}, Case{"1 1", h, 20 * (2 * kPi - angle)}}) {
    const Drawing d = framed(std::string("<path d='M 40 50 A 20 20 0 ") + c.flags + " 60 50'/>");
    EXPECT_LE(off_circle(d[0], Point(0, c.centre_y), 20), kFlatness) << c.flags;
    EXPECT_NEAR(length(d[0]), c.length, 0.5) << c.flags;
    EXPECT_NEAR((d[0].front() - Point(-10, 0)).norm(), 0, 1e-9);
    EXPECT_NEAR((d[0].back() - Point(10, 0)).norm(), 0, 1e-9);
  }
}

TEST(Svg, RandomArcsEndWhereTheyShouldAndLieOnTheirEllipse) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(20, 80);
  std::uniform_real_distribution<double> radius(2, 40);
  std::uniform_real_distribution<double> degrees(-400, 400);
  for (int round = 0; round < 200; ++round) {
    const Point a(place(random), place(random));
    const Point b(place(random), place(random));
    const double rx = radius(random);
    const double ry = radius(random);
    const double turn = degrees(random);
    const std::string arc = "<path d='M " + std::to_string(a.x()) + " " + std::to_string(a.y()) + " A " +
                            std::to_string(rx) + " " + std::to_string(ry) + " " + std::to_string(turn) +
                            (round % 2 ? " 1" : " 0") + (round % 4 > 1 ? " 1 " : " 0 ") +
                            std::to_string(b.x()) + " " + std::to_string(b.y()) + "'/>";
    // The frame is far larger than any arc can be.
    const Drawing d = parse("<path d='M -1000 -1000 L 1000 1000'/>" + arc, 200);
    const Stroke& s = d[1];
    const auto on_sheet = [](const Point& p) { return Point(p.x() / 10, -p.y() / 10); };
    EXPECT_NEAR((s.front() - on_sheet(a)).norm(), 0, 1e-6);
    EXPECT_NEAR((s.back() - on_sheet(b)).norm(), 0, 1e-6);
    // Turned and squeezed so that the ellipse is a circle, all points have one centre: that of the first
    // three.
    const Eigen::Matrix2d R = Eigen::Rotation2Dd(turn * kPi / 180).toRotationMatrix();
    const auto unit = [&](const Point& p) {
      return Point((R.transpose() * Point(p.x(), -p.y())).cwiseQuotient(Point(rx, ry)));
    };
    if (s.size() < 5) continue;
    const Point p = unit(s[0]), q = unit(s[s.size() / 2]), r = unit(s.back());
    Eigen::Matrix2d M;
    M.row(0) = 2 * (q - p).transpose();
    M.row(1) = 2 * (r - p).transpose();
    const Point centre =
        M.inverse() * Point(q.squaredNorm() - p.squaredNorm(), r.squaredNorm() - p.squaredNorm());
    for (const Point& point : s)
      EXPECT_NEAR((unit(point) - centre).norm(), (p - centre).norm(), 1e-4 * (p - centre).norm());
  }
}

TEST(Svg, ArcRadiiThatAreTooSmallGrow) {
  const Drawing d = framed("<path d='M 40 50 A 1 1 0 0 1 60 50'/>");
  EXPECT_LE(off_circle(d[0], Point(0, 0), 10), kFlatness);
  expect_same(framed("<path d='M 40 50 A 0 1 0 0 1 60 50'/>"), {{Point(-10, 0), Point(10, 0)}});
}

TEST(Svg, ShapesDrawTheirOutline) {
  expect_same(framed("<line x1='10' y1='20' x2='30' y2='40'/>"), {{Point(-40, 30), Point(-20, 10)}});
  expect_same(framed("<polyline points='10,20 30,40, 50 20'/>"),
              {{Point(-40, 30), Point(-20, 10), Point(0, 30)}});
  expect_same(framed("<polygon points='10,20 30,40 50 20'/>"),
              {{Point(-40, 30), Point(-20, 10), Point(0, 30), Point(-40, 30)}});
  expect_same(framed("<rect x='10' y='20' width='30' height='40'/>"),
              {{Point(-40, 30), Point(-10, 30), Point(-10, -10), Point(-40, -10), Point(-40, 30)}});
  const Drawing ellipse = framed("<ellipse cx='50' cy='50' rx='20' ry='10'/>");
  for (const Point& p : ellipse[0]) EXPECT_NEAR(p.cwiseQuotient(Point(20, 10)).norm(), 1, 1e-9);
  EXPECT_NEAR(bounds(ellipse).sizes().y(), 20, 0.1);
}

TEST(Svg, RoundedRectanglesAreClosedAndTheirCornersRound) {
  const Drawing d = framed("<rect x='20' y='30' width='60' height='40' rx='10'/>");
  EXPECT_NEAR((d[0].front() - d[0].back()).norm(), 0, 1e-9);
  EXPECT_NEAR(length(d[0]), 2 * (40 + 20) + 2 * kPi * 10, 0.2);
  const NearestPoint outline(d[0]);
  for (const double sx : {-1.0, 1.0})
    for (const double sy : {-1.0, 1.0}) {
      EXPECT_NEAR(outline.distance(Point(sx * 30, sy * 20)), 10 * (std::sqrt(2.0) - 1), kFlatness);
      EXPECT_LE(outline.distance(Point(sx * 30, 0)) + outline.distance(Point(0, sy * 20)), 1e-9);
    }
  // Radii are cut to half the side.
  EXPECT_LE(off_circle(framed("<rect x='30' y='30' width='40' height='40' rx='99'/>")[0], Point(0, 0), 20),
            kFlatness);
}

TEST(Svg, TransformsApplyFromTheOutsideIn) {
  const std::string line = "<line x1='1' y1='0' x2='2' y2='0'";
  const Drawing want{{Point(-30, 40), Point(-10, 40)}};  // (20, 10) to (40, 10)
  expect_same(framed(line + " transform='translate(0 10) scale(20)'/>"), want);
  expect_same(framed(line + " transform='matrix(20 0 0 20 0 10)'/>"), want);
  expect_same(framed("<g transform='translate(0,10)'><g transform='scale(20)'>" + line + "/></g></g>"), want);
  expect_same(framed(line + " transform='rotate(90 20 10), translate(20,-30) scale(20)'/>"),
              {{Point(10, 20), Point(10, 0)}});
  expect_same(framed("<line x1='10' y1='10' x2='20' y2='10' transform='skewY(45)'/>"),
              {{Point(-40, 30), Point(-30, 20)}});
  expect_same(framed("<line x1='10' y1='10' x2='10' y2='20' transform='skewX(45)'/>"),
              {{Point(-30, 40), Point(-20, 30)}});
}

TEST(Svg, ACircleUnderAnyTransformIsTheTransformedCircle) {
  const Drawing d = framed(
      "<circle cx='50' cy='50' r='10' transform='rotate(30 50 50) translate(50 50) scale(3 1) translate(-50 "
      "-50)'/>");
  const Eigen::Matrix2d R = Eigen::Rotation2Dd(-kPi / 6).toRotationMatrix();  // y is up here
  for (const Point& p : d[0])
    EXPECT_NEAR(Point(R.transpose() * p).cwiseQuotient(Point(30, 10)).norm(), 1, 1e-9);
}

TEST(Svg, UseDrawsWhatIsDefinedAndDefinitionsAloneDrawNothing) {
  const std::string defs = "<defs><g id='a'><line x1='0' y1='0' x2='10' y2='0'/></g></defs>";
  EXPECT_TRUE(framed(defs).empty());
  expect_same(
      framed(defs +
             "<use href='#a' x='10' y='20'/><use xlink:href='#a' transform='translate(50,50)' x='5'/>"),
      {{Point(-40, 30), Point(-30, 30)}, {Point(5, 0), Point(15, 0)}});
}

TEST(Svg, SymbolsAndNestedDrawingsHaveAViewport) {
  const std::string symbol =
      "<symbol id='s' viewBox='0 0 10 5'><line x1='0' y1='0' x2='10' y2='5'/></symbol>";
  EXPECT_TRUE(framed(symbol).empty());
  const Drawing want{{Point(-40, 25), Point(-20, 15)}};  // 20 x 10 in the middle of 20 x 20
  expect_same(framed(symbol + "<use href='#s' x='10' y='20' width='20' height='20'/>"), want);
  expect_same(framed("<svg x='10' y='20' width='20' height='20' viewBox='0 0 10 5'><line x1='0' y1='0' "
                     "x2='10' y2='5'/></svg>"),
              want);
  expect_same(framed("<svg x='10' y='20' width='20' height='20' viewBox='0 0 10 5' "
                     "preserveAspectRatio='none'><line x2='100%' y2='5'/></svg>"),
              {{Point(-40, 30), Point(-20, 10)}});
}

TEST(Svg, HiddenElementsAreLeftOut) {
  const std::string line = "<line x1='10' y1='10' x2='20' y2='10' ";
  EXPECT_TRUE(framed(line + "display='none'/>").empty());
  EXPECT_TRUE(framed(line + "style='stroke:red; display : none !important'/>").empty());
  EXPECT_TRUE(framed("<g style='display:none'>" + line + "/></g>").empty());
  EXPECT_TRUE(framed("<g visibility='hidden'>" + line + "/></g>").empty());
  EXPECT_EQ(framed("<g visibility='hidden'>" + line + "visibility='visible'/></g>").size(), 1u);
  EXPECT_TRUE(framed("<clipPath>" + line + "/></clipPath><mask>" + line + "/></mask>").empty());
}

TEST(Svg, StyleSheetsHideWhatTheySay) {
  const auto drawn = [](const std::string& css, const std::string& element, std::string* ignored = nullptr) {
    return parse("<style>" + css + "</style><path d='M0 0H9V9'/>" + element, 120, ignored).size() == 2;
  };
  const std::string line = "<line id='b' class='a h' x2='5'/>";
  EXPECT_TRUE(drawn(".other{display:none}", line));
  EXPECT_TRUE(drawn(".h{stroke:none;fill:red}", line));
  EXPECT_FALSE(drawn(".h{display:none}", line));
  EXPECT_FALSE(drawn("/* .h{} */ .x, line.a.h { stroke: red; display : none !important }", line));
  EXPECT_FALSE(drawn("#b{visibility:hidden}", line));
  EXPECT_FALSE(drawn("line{display:none}", line));
  EXPECT_FALSE(drawn("<![CDATA[ @media print{line{display:inline}} line{display:none} ]]>", line));
  EXPECT_FALSE(drawn(".h{display:none}", "<g class='h'><line x2='5'/></g>"));
  EXPECT_TRUE(drawn("*{visibility:hidden}.h{visibility:visible}path{visibility:visible}", line));
  EXPECT_TRUE(drawn("#b{display:inline}.h{display:none}line{display:none}", line)) << "an id counts more";
  EXPECT_FALSE(drawn(".h{display:inline}.a{display:none}", line)) << "the later one of equals counts";
  EXPECT_TRUE(drawn(".h{display:none}", "<line class='h' style='display:inline' x2='5'/>"));
  EXPECT_FALSE(drawn(".h{display:none}", "<line class='h' display='inline' x2='5'/>"));
  for (const char* broken : {"{", "}", ".h{display:none", "@", "@media{", ".{display:none}", ",,{}", "/*"})
    EXPECT_NO_THROW(drawn(broken, line)) << broken;
}

TEST(Svg, StyleRulesThatAreNotUnderstoodAreTold) {
  std::string ignored;
  EXPECT_EQ(
      parse("<style>g > line{display:none} g line{stroke:red}</style><line x2='5'/>", 120, &ignored).size(),
      1u);
  EXPECT_EQ(ignored, "style rule (1)");
}

TEST(Svg, PointsWithoutExtentAreDots) {
  const Drawing d = framed(
      "<path d='M 10 10 z M 20 20 l 0 0 M 30 30 M 40 40 c 0 0 0 0 0 0'/><line x1='50' x2='50'/><polyline "
      "points='60 60'/>");
  ASSERT_EQ(d.size(), 5u);  // the bare move to (30, 30) draws nothing
  for (const Stroke& s : d) EXPECT_EQ(s.size(), 1u);
  expect_same(path("M 5 5 z"), {{Point(0, 0)}});
}

TEST(Svg, ShapesOfSizeZeroDrawNothing) {
  EXPECT_TRUE(framed("<circle cx='5' cy='5' r='0'/><rect x='1' width='0' height='9'/><ellipse rx='3' "
                     "ry='0'/><polyline points=''/><path d=''/><path d='none'/><path/>")
                  .empty());
}

TEST(Svg, LengthsHaveUnits) {
  expect_same(framed("<line x1='1in' y1='72pt' x2='25.4mm' y2='0'/>"),
              framed("<line x1='96' y1='96' x2='96px' y2='0'/>"));
}

TEST(Svg, PrefixedElementsCountAndForeignOnesDoNot) {
  const Drawing d = parse_svg(
      "<s:svg xmlns:s='http://www.w3.org/2000/svg' xmlns:i='urn:i'><i:path d='broken'/><path d='M'/><s:path "
      "d='M 0 0 L 9 9'/></s:svg>",
      "f");
  EXPECT_EQ(d.size(), 1u);
}

TEST(Svg, TellsWhatHasNoOutline) {
  std::string ignored;
  EXPECT_EQ(parse("<line x2='9'/><text>a</text><text>b</text><image/><title>t</title>", 120, &ignored).size(),
            1u);
  EXPECT_EQ(ignored, "image (1), text (2)");
}

TEST(Svg, SaysNothingOfWhatNeverDrawsAnything) {
  std::string ignored;
  for (const char* name : {"defs",
                           "symbol",
                           "title",
                           "desc",
                           "metadata",
                           "style",
                           "script",
                           "linearGradient",
                           "clipPath",
                           "radialGradient",
                           "mask",
                           "marker",
                           "pattern",
                           "filter",
                           "view",
                           "animate",
                           "animateTransform",
                           "set",
                           "cursor",
                           "font"}) {
    const std::string element = std::string("<") + name + "/><line x2='9'/>";
    EXPECT_EQ(parse(element, 120, &ignored).size(), 1U) << name;
    EXPECT_EQ(ignored, "") << name;
  }
  for (const char* name : {"text", "image", "foreignObject", "video"}) {
    const std::string element = std::string("<") + name + "/><line x2='9'/>";
    EXPECT_EQ(parse(element, 120, &ignored).size(), 1U) << name;
    EXPECT_EQ(ignored, std::string(name) + " (1)");
  }
}

TEST(Svg, EverySizeUpToTheSheetFits) {
  for (const double size : {0.5, 1.0, 50.0, 200.0}) {
    const Drawing d = parse("<circle r='3'/><path d='M 0 0 C 9 1 -4 7 8 9'/>", size);
    EXPECT_NEAR(bounds(d).sizes().maxCoeff(), size, 1e-9);
  }
}

}  // namespace
}  // namespace mrroc::drawing
