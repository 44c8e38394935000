#include "sim/strokes_file.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

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

}  // namespace mrroc::sim
