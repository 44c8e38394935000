#include "test/system/tables.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <sstream>
#include <stdexcept>

namespace mrroc::test {
namespace {

constexpr double kTouchDown = 0.2;   // [s]
constexpr double kDeparture = 1e-3;  // [m]
constexpr double kRounding = 1e-6;   // of times [s]
constexpr double kThinning = 0.2;    // distance of the points that are judged [mm]

double distance_to_line(const Row& p, const Row& a, const Row& b) {
  const double dx = b[2] - a[2], dy = b[3] - a[3], length2 = dx * dx + dy * dy;
  const double u =
      length2 > 0 ? std::clamp(((p[2] - a[2]) * dx + (p[3] - a[3]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(p[2] - a[2] - u * dx, p[3] - a[3] - u * dy);
}

// Points at least that far apart, and the last one of each stroke.
std::vector<Row> thinned(const std::vector<Row>& ink) {
  std::vector<Row> out;
  for (std::size_t k = 0; k < ink.size(); ++k) {
    const bool last = k + 1 == ink.size() || ink[k + 1][0] != ink[k][0];
    const bool near = !out.empty() && out.back()[0] == ink[k][0] &&
                      std::hypot(out.back()[2] - ink[k][2], out.back()[3] - ink[k][3]) < kThinning;
    if (!near || last) out.push_back(ink[k]);
  }
  return out;
}

}  // namespace

std::vector<Row> read_table(const std::filesystem::path& file, const std::string& heading) {
  std::ifstream in(file);
  std::string line;
  if (!std::getline(in, line) || line != heading) throw std::runtime_error(file.string() + ": " + line);
  std::vector<Row> rows;
  while (std::getline(in, line)) {
    std::istringstream fields(line);
    Row row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(std::stod(field));
    rows.push_back(row);
  }
  return rows;
}

std::vector<std::pair<std::size_t, std::size_t>> stretches(const std::vector<Row>& arm, double m) {
  std::vector<std::pair<std::size_t, std::size_t>> all;
  for (std::size_t k = 0; k < arm.size(); ++k) {
    if (arm[k][kM] != m) continue;
    if (k > 0 && arm[k - 1][kM] == m)
      all.back().second = k;
    else
      all.emplace_back(k, k);
  }
  return all;
}

std::pair<double, double> paper_force(const std::vector<Row>& arm) {
  double n = 0, sum = 0, squares = 0;
  for (const auto& [first, last] : stretches(arm, 5))
    for (std::size_t k = first; k <= last; ++k) {
      if (arm[k][kT] - arm[first][kT] < kTouchDown - kRounding) continue;
      ++n;
      sum += arm[k][kFz];
      squares += arm[k][kFz] * arm[k][kFz];
    }
  return {sum / n, std::sqrt(std::max(0.0, squares / n - sum / n * sum / n))};
}

double travel_z(const std::vector<Row>& arm) {
  double largest = 0;
  for (const auto& [first, last] : stretches(arm, 7))
    for (std::size_t k = first; k <= last; ++k)
      for (const std::size_t j : {first, last})
        largest = std::max(largest, 1e3 * std::abs(arm[k][kZ] - arm[j][kZ]));
  return largest;
}

std::vector<double> departures(const std::vector<Row>& arm) {
  std::vector<double> all;
  for (const auto& [first, last] : stretches(arm, 5)) {
    std::size_t k = first;
    while (k < last && std::hypot(arm[k][kX] - arm[first][kX], arm[k][kY] - arm[first][kY]) < kDeparture) ++k;
    all.push_back(arm[k][kI]);
  }
  return all;
}

std::pair<double, double> distances(const std::vector<Row>& ink, const std::vector<Row>& other) {
  const std::vector<Row> points = thinned(ink), lines = thinned(other);
  double squares = 0, largest = 0;
  for (const Row& p : points) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < lines.size(); ++k) {
      const std::size_t next = k + 1 < lines.size() && lines[k + 1][0] == lines[k][0] ? k + 1 : k;
      least = std::min(least, distance_to_line(p, lines[k], lines[next]));
    }
    squares += least * least;
    largest = std::max(largest, least);
  }
  return {std::sqrt(squares / static_cast<double>(points.size())), largest};
}

int strokes(const std::vector<Row>& ink) {
  std::set<double> numbers;
  for (const Row& row : ink) numbers.insert(row[0]);
  return static_cast<int>(numbers.size());
}

}  // namespace mrroc::test
