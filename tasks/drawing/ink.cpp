#include "tasks/drawing/ink.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/fault.hpp"
#include "base/text_file.hpp"

namespace mrroc::drawing {
namespace {

constexpr std::string_view kHeader = "stroke,t,x,y";
constexpr std::size_t kMaxInkBytes = 200'000'000;

}  // namespace

Drawing strokes_of(const Ink& ink) {
  Drawing drawing;
  for (const InkPoint& p : ink) {
    const auto stroke = static_cast<std::size_t>(p.stroke);
    if (stroke >= drawing.size()) drawing.resize(stroke + 1);
    drawing[stroke].emplace_back(p.x, p.y);
  }
  return drawing;
}

Ink without_hops(Ink ink) {
  int joined = 0;
  for (std::size_t k = 0; k < ink.size(); ++k) {
    InkPoint& p = ink[k];
    if (k > 0 && p.stroke - joined != ink[k - 1].stroke && p.t - ink[k - 1].t < kHopTime) ++joined;
    p.stroke -= joined;
  }
  return ink;
}

Ink ink_of(const Drawing& drawing) {
  Ink ink;
  for (std::size_t k = 0; k < drawing.size(); ++k)
    for (const Point& p : drawing[k]) ink.push_back({static_cast<int>(k), 0, p.x(), p.y()});
  return ink;
}

void write_ink(const std::filesystem::path& file, const Ink& ink) {
  std::string text = fmt::format("{}\n", kHeader);
  for (const InkPoint& p : ink) {
    if (!std::isfinite(p.t) || !std::isfinite(p.x) || !std::isfinite(p.y))
      throw FaultError(FaultCode::internal_error, file.string() + ": ink with a number that is not finite");
    text += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", p.stroke, p.t, p.x, p.y);
  }
  write_text_file(file, text);
}

Ink read_ink(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, kMaxInkBytes);
  Lines lines(text, file.string());
  if (lines.next() != kHeader)
    lines.fail(fmt::format("the header is not '{}'", kHeader), "give an ink table");
  Ink ink;
  while (!lines.done()) append_ink_row(ink, lines, lines.next(), ',');
  return ink;
}

void append_ink_row(Ink& ink, const Lines& lines, std::string_view row, char separator) {
  const std::string_view stroke = row.substr(0, row.find(separator));
  InkPoint p;
  p.stroke = static_cast<int>(lines.count(stroke, kMaxStrokes));
  row.remove_prefix(std::min(stroke.size() + 1, row.size()));
  std::array<double, 3> txy{};
  if (!lines.numbers(row, separator, txy).empty()) lines.fail("more than four fields");
  p.t = txy[0];
  p.x = txy[1];
  p.y = txy[2];
  if (!ink.empty() && p.stroke < ink.back().stroke) lines.fail("the stroke number goes back");
  if (!ink.empty() && p.stroke == ink.back().stroke && p.t < ink.back().t)
    lines.fail("time goes back within a stroke");
  ink.push_back(p);
}

}  // namespace mrroc::drawing
