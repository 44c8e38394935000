#include "sim/strokes_file.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>
#include <utility>

#include "base/fault.hpp"

namespace mrroc::sim {

std::vector<Polyline> read_strokes(const std::filesystem::path& file) {
  std::vector<Polyline> strokes;
  if (file.empty()) return strokes;
  std::ifstream in(file);
  if (!in) throw FaultError(FaultCode::bad_drawing, fmt::format("cannot read {}", file.string()));
  std::string line;
  std::getline(in, line);
  int last = -1;
  for (int number = 2; std::getline(in, line); ++number) {
    int stroke = 0;
    double t = 0, x = 0, y = 0;
    const bool complete = std::sscanf(line.c_str(), "%d,%lf,%lf,%lf", &stroke, &t, &x, &y) == 4;
    if (!complete || !std::isfinite(x) || !std::isfinite(y))
      throw FaultError(FaultCode::bad_drawing,
                       fmt::format("{}:{}: a row is stroke,t,x,y", file.string(), number));
    if (stroke != last || strokes.empty()) strokes.emplace_back();
    last = stroke;
    strokes.back().emplace_back(x, y);
  }
  return strokes;
}

bool is_hand_track(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string headings;
  return std::getline(in, headings) && headings == "t,x,y,z";
}

HandTrack read_hand_track(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<TrackPoint> points;
  for (int number = 2; std::getline(in, line); ++number) {
    TrackPoint point;
    const bool complete =
        std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf", &point.t, &point.p.x(), &point.p.y(), &point.p.z()) == 4;
    if (!complete || !point.p.allFinite() || !std::isfinite(point.t))
      throw FaultError(FaultCode::bad_drawing, fmt::format("{}:{}: a row is t,x,y,z", file.string(), number));
    if (points.empty() ? point.t < 0 : point.t <= points.back().t)
      throw FaultError(FaultCode::bad_drawing,
                       fmt::format("{}:{}: times grow from row to row, from 0 on", file.string(), number));
    point.p *= 1e-3;
    points.push_back(point);
  }
  if (points.empty())
    throw FaultError(FaultCode::bad_drawing, fmt::format("{}: the track has no row", file.string()));
  return HandTrack(std::move(points));
}

}  // namespace mrroc::sim
