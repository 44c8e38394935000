#include "bench/latency_samples.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace mrroc::bench {
namespace {

std::vector<std::string> fields(const std::string& line) {
  std::vector<std::string> found;
  std::istringstream in(line);
  for (std::string field; std::getline(in, field, ',');) found.push_back(field);
  return found;
}

}  // namespace

std::vector<Step> read_steps(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  const auto header = fields(line);
  const auto x = static_cast<std::size_t>(std::ranges::find(header, "set_x") - header.begin());
  std::vector<Step> steps;
  while (std::getline(in, line)) {
    const auto field = fields(line);
    if (field.size() != header.size() || x + 2 >= field.size()) continue;
    steps.push_back({std::stoll(field[0]),
                     field[2],
                     {std::stod(field[x]), std::stod(field[x + 1]), std::stod(field[x + 2])}});
  }
  return steps;
}

double speed(const Step& a, const Step& b) {
  double sum = 0;
  for (std::size_t l = 0; l < 3; ++l) sum += std::pow(b.set[l] - a.set[l], 2);
  return std::sqrt(sum) / kStep;
}

Latency latency(const std::vector<Step>& steps, double pressed, const Wanted& wanted) {
  constexpr double kSteps = kMacrostep / kStep;
  const auto after =
      std::ranges::find_if(steps, [&](const Step& s) { return static_cast<double>(s.k) >= pressed; });
  const auto first = static_cast<std::size_t>(after - steps.begin());
  if (first < 2 || wanted(steps[first - 2], steps[first - 1])) return {Latency::Kind::nothing_to_see, 0};
  for (std::size_t k = first; k < steps.size(); ++k) {
    const double later = (static_cast<double>(steps[k].k) - pressed) / kSteps;
    if (later > kLongest) break;
    if (wanted(steps[k - 1], steps[k])) return {Latency::Kind::measured, later};
  }
  return {Latency::Kind::never, 0};
}

bool is_undone(const std::vector<Step>& steps, double from, double to, const Wanted& wanted) {
  for (std::size_t k = 1; k < steps.size(); ++k) {
    const auto step = static_cast<double>(steps[k].k);
    if (step >= from && step <= to && !wanted(steps[k - 1], steps[k])) return true;
  }
  return false;
}

}  // namespace mrroc::bench
