#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <random>

#include "tasks/drawing/svg.hpp"
#include "test/tasks/drawing/folder.hpp"

namespace mrroc::drawing {
namespace {

std::string svg(const std::string& elements) { return "<svg>\n" + elements + "\n</svg>\n"; }

std::string error_of(const std::string& text, double size = 120) {
  try {
    (void)parse_svg(text, "f.svg", size);
  } catch (const FileError& error) {
    return error.what();
  }
  return "";
}

void expect_error(const std::string& text, const std::vector<std::string>& parts) {
  const std::string error = error_of(text);
  for (const std::string& part : parts)
    EXPECT_NE(error.find(part), std::string::npos)
        << "'" << error << "' lacks '" << part << "' for " << text.substr(0, 200);
}

TEST(SvgErrors, NameTheFileTheLineAndTheElement) {
  expect_error(svg("<g>\n<path id='leaf' d='M 1 1 L 2'/></g>"),
               {"f.svg:3: <path id=\"leaf\">: expected a number at its end; "});
  expect_error(svg("<path d='M 1 1 L 2 x'/>"), {"f.svg:2: <path>: ", "at character 11", "'x'"});
  expect_error(svg("<path d='L 1 1'/>"), {":2:", "M"});
  expect_error(svg("<path d='M 1 1 K 2 2'/>"), {":2:", "'K'"});
  expect_error(svg("<path d='M 1 1 A 5 5 0 2 0 9 9'/>"), {":2:", "flag"});
  expect_error(svg("<path d='M 1,,1'/>"), {":2:"});
  expect_error(svg("<path d='M 1 1 z 5'/>"), {":2:"});
  expect_error(svg("<path d='M 1 1 L nan 2'/>"), {":2:", "number"});
  expect_error(svg("<path d='M 1 1 L inf 2'/>"), {":2:", "number"});
  expect_error(svg("<path d='M 1 1 L 1e999 2'/>"), {":2:", "too large"});
  expect_error(svg("<line x2='1e308' transform='scale(1e10)'/>"), {":2:", "too large"});
  expect_error(svg("<line x2='9em'/>"), {":2: <line>:", "x2=\"9em\"", "'em'"});
  expect_error(svg("<line x2='50%'/>"), {":2:", "per cent"});
  expect_error(svg("<polyline points='1 2 3'/>"), {":2:", "odd"});
  expect_error(svg("<polygon points='1 2 a'/>"), {":2:", "'a'"});
  expect_error(svg("<circle r='-3'/>"), {":2:", "negative"});
  expect_error(svg("<rect width='9' height='9' rx='-1'/>"), {":2:", "negative"});
  expect_error(svg("<g transform='spin(3)'><line x2='9'/></g>"), {":2: <g>:", "spin"});
  expect_error(svg("<g transform='scale(1 2 3)'><line x2='9'/></g>"), {":2: <g>:", "scale"});
  expect_error(svg("<g transform='scale(1'><line x2='9'/></g>"), {":2: <g>:"});
  expect_error("<svg transform='x'><line x2='9'/></svg>", {":1: <svg>:"});
  expect_error(svg("<use href='#gone'/>"), {":2: <use>:", "'#gone'"});
  expect_error(svg("<use href='other.svg#a'/>"), {":2: <use>:", "other.svg"});
}

TEST(SvgErrors, SayWhatIsMissing) {
  expect_error("hello", {"no XML element"});
  expect_error("<html><body/></html>", {":1:", "<html>"});
  expect_error("<svg>\n<g>\n<path", {":3:", "not well-formed"});
  expect_error("<svg><g></svg>", {":1:", "not well-formed"});
  expect_error(svg(""), {"nothing to draw"});
  expect_error(svg("<text>a</text><text>b</text>"), {"text (2)", "convert text to paths"});
  expect_error(svg("<path d='M 1 1'/>"), {"nothing to draw"});
  expect_error("\x1f\x8b\x08", {"gunzip"});
}

TEST(SvgErrors, HaveTheNumberOfTheirLineOrNone) {
  const auto line_of = [](const std::string& text) {
    try {
      (void)parse_svg(text, "f.svg");
    } catch (const FileError& error) {
      return error.line();
    }
    return -100;
  };
  EXPECT_EQ(line_of("hello"), 0);
  EXPECT_EQ(line_of("\x1f\x8b\x08"), 0);
  EXPECT_EQ(line_of(svg("")), 0);
  EXPECT_EQ(line_of("<html><body/></html>"), 1);
  EXPECT_EQ(line_of("<svg>\n<g>\n<path"), 3);
  EXPECT_EQ(line_of(svg("<g>\n\n<path d='M 1 1 L 2'/></g>")), 4);
}

TEST(SvgErrors, RefuseSizesThatDoNotFitTheSheet) {
  for (const double size : {0.0, -5.0, 200.5, 1e9})
    EXPECT_NE(error_of(svg("<line x2='9'/>"), size).find("200 mm"), std::string::npos) << size;
}

TEST(SvgErrors, RefuseTooMuch) {
  std::string points;
  for (int k = 0; k < 10'001; ++k) points += std::to_string(k) + " " + std::to_string(k % 7) + " ";
  expect_error(svg("<polyline points='" + points + "'/>"), {"f.svg: 10001 points", "10000"});
  points.erase(0, 4);
  EXPECT_EQ(error_of(svg("<polyline points='" + points + "'/>")), "");
  std::string circles;
  for (int k = 0; k < 200; ++k) circles += "<circle r='9'/>";
  expect_error(svg(circles), {"points after flattening"});
}

TEST(SvgErrors, EndUsesThatRepeatThemselves) {
  expect_error(svg("<g id='a'><use href='#a'/></g>"), {"nested deeper", "<use>"});
  std::string doubling = "<g id='g0'><line x2='9'/></g>";
  std::string empty = "<g id='e0'/>";
  for (int k = 1; k < 40; ++k) {
    const std::string before = std::to_string(k - 1);
    doubling +=
        "<g id='g" + std::to_string(k) + "'><use href='#g" + before + "'/><use href='#g" + before + "'/></g>";
    empty +=
        "<g id='e" + std::to_string(k) + "'><use href='#e" + before + "'/><use href='#e" + before + "'/></g>";
  }
  EXPECT_NE(error_of(svg(doubling)), "");
  expect_error(svg(empty), {"elements"});
}

TEST(SvgErrors, FilesThatCannotBeReadAreNamed) {
  const Folder folder;
  const auto error = [](const std::filesystem::path& file) -> std::string {
    try {
      (void)read_svg(file);
    } catch (const FileError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(error(folder / "no.svg").find("no.svg: there is no such file"), std::string::npos);
  EXPECT_NE(error(folder.path()).find("not a file"), std::string::npos);
  std::ofstream(folder / "empty.svg").close();
  EXPECT_NE(error(folder / "empty.svg").find("empty.svg: the file is empty"), std::string::npos);
  std::ofstream(folder / "huge.svg").close();
  std::filesystem::resize_file(folder / "huge.svg", kMaxSvgBytes + 1);
  EXPECT_NE(error(folder / "huge.svg").find("over the limit"), std::string::npos);
  std::ofstream(folder / "good.svg") << svg("<line x2='9'/>");
  EXPECT_EQ(read_svg(folder / "good.svg").size(), 1u);
}

// Whatever the bytes, the reader returns a drawing that can be drawn or throws FileError.
void survive(const std::string& text) {
  try {
    check(parse_svg(text, "fuzz"), "fuzz");
  } catch (const FileError&) {
  }
}

TEST(SvgErrors, NoBytesMakeTheReaderFailOtherwise) {
  const std::string good =
      "<?xml version='1.0'?>\n<svg viewBox='0 0 9 9'><defs><g id='a'><path d='M1 2c3-4 5 6 7 8s9-1 2 3q4 5 6 "
      "7t8 9a1 2 3 0 1 4 5z'/></g></defs>"
      "<use href='#a' x='3%'/><rect x='1' y='2' width='3mm' height='4' rx='1' transform='rotate(30 1 2) "
      "skewX(3)'/>"
      "<circle r='3' style='display:inline'/><polygon points='1,2 3,4 5 6'/><!-- c --><svg viewBox='1 2 3 4' "
      "width='5'><ellipse rx='1' ry='2'/></svg></svg>";
  ASSERT_EQ(error_of(good), "");
  for (std::size_t cut = 0; cut < good.size(); ++cut) survive(good.substr(0, cut));
  std::mt19937 random(5);
  const std::string tokens = "0123456789.-+eE,MmLlCcAaZzQqTtSsHhVv<>/='\" #%()&;\n";
  for (int round = 0; round < 20'000; ++round) {
    std::string text = good;
    for (auto k = 1 + random() % 4; k > 0; --k) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random() % 256);
          break;
        case 1:
          text[at] = tokens[random() % tokens.size()];
          break;
        case 2:
          text.erase(at, random() % 9);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 20));
      }
    }
    survive(text);
  }
  for (int round = 0; round < 5'000; ++round) {
    std::string d;
    for (auto k = random() % 40; k > 0; --k) d += tokens[random() % 37];
    survive(svg("<path d='M 0 0" + d + "'/>"));
    std::string noise(random() % 100, '\0');
    for (char& c : noise) c = static_cast<char>(random() % 256);
    survive(noise);
  }
}

}  // namespace
}  // namespace mrroc::drawing
