#include "ecp/generators/nurbs.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/fault.hpp"

namespace mrroc::ecp {
namespace {

constexpr int kMaxDegree = 5;

void demand(bool good, const char* what) {
  if (!good) throw FaultError(FaultCode::bad_trajectory, what);
}

std::vector<double> clamped_knots(int degree, std::size_t points) {
  std::vector<double> knots(static_cast<std::size_t>(degree) + 1, 0);
  const std::size_t sections = points - static_cast<std::size_t>(degree);
  for (std::size_t k = 1; k < sections; ++k)
    knots.push_back(static_cast<double>(k) / static_cast<double>(sections));
  knots.insert(knots.end(), static_cast<std::size_t>(degree) + 1, 1);
  return knots;
}

void check(const NurbsShape& s) {
  const auto p = static_cast<std::size_t>(s.degree);
  demand(s.weights.size() == s.control.size(), "NURBS: one weight per control point is needed");
  for (std::size_t k = 0; k < s.control.size(); ++k) {
    demand(s.control[k].size() == s.control[0].size(), "NURBS: control points of different sizes");
    demand(s.control[k].allFinite(), "NURBS: a control point has a number that is not finite");
    demand(s.weights[k] > 0 && std::isfinite(s.weights[k]), "NURBS: a weight is not above zero");
  }
  demand(s.knots.size() == s.control.size() + p + 1, "NURBS: the number of knots is not points + degree + 1");
  demand(std::ranges::all_of(s.knots, [](double u) { return std::isfinite(u); }),
         "NURBS: a knot is not finite");
  demand(std::ranges::is_sorted(s.knots), "NURBS: the knots fall");
  demand(s.knots[p] < s.knots[s.control.size()], "NURBS: the knots leave no room for a curve");
  for (std::size_t k = 1; k + p + 1 < s.knots.size(); ++k)
    demand(s.knots[k] < s.knots[k + p] || s.knots[k] <= s.knots[p] || s.knots[k] >= s.knots[s.control.size()],
           "NURBS: an inner knot more than degree times");
}

}  // namespace

Nurbs::Nurbs(NurbsShape shape, double time) : shape_(std::move(shape)), time_(time) {
  demand(time > 0 && std::isfinite(time), "NURBS: the time must be above zero");
  demand(shape_.degree >= 1 && shape_.degree <= kMaxDegree, "NURBS: the degree must lie between 1 and 5");
  demand(shape_.control.size() > static_cast<std::size_t>(shape_.degree),
         "NURBS: degree + 1 control points are needed");
  if (shape_.weights.empty()) shape_.weights.assign(shape_.control.size(), 1);
  if (shape_.knots.empty()) shape_.knots = clamped_knots(shape_.degree, shape_.control.size());
  check(shape_);
}

Coordinates Nurbs::at(double t) const {
  const double first = shape_.knots[static_cast<std::size_t>(shape_.degree)];
  const double last = shape_.knots[shape_.control.size()];
  const double share = std::clamp(t / time_, 0.0, 1.0);
  return point(share >= 1 ? last : first + share * (last - first));
}

Coordinates Nurbs::point(double u) const {
  const auto p = static_cast<std::size_t>(shape_.degree);
  const auto begin = shape_.knots.begin() + shape_.degree + 1;
  const auto end = shape_.knots.begin() + static_cast<std::ptrdiff_t>(shape_.control.size());
  const auto span = static_cast<std::size_t>(std::upper_bound(begin, end, u) - shape_.knots.begin()) - 1;
  std::array<Coordinates, kMaxDegree + 1> d;
  std::array<double, kMaxDegree + 1> w{};
  for (std::size_t j = 0; j <= p; ++j) {
    w[j] = shape_.weights[span - p + j];
    d[j] = w[j] * shape_.control[span - p + j];
  }
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double low = shape_.knots[span - p + j];
      const double high = shape_.knots[span + 1 + j - r];
      const double share = (u - low) / (high - low);
      d[j] = ((1 - share) * d[j - 1] + share * d[j]).eval();
      w[j] = (1 - share) * w[j - 1] + share * w[j];
    }
  return d[p] / w[p];
}

}  // namespace mrroc::ecp
