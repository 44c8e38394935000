#include "ui_cli/history.hpp"

#include <algorithm>
#include <limits>

namespace mrroc::ui {

std::string_view to_string(Quantity q) {
  switch (q) {
    case Quantity::F_z:
      return "F_z";
    case Quantity::F_x:
      return "F_x";
    case Quantity::F_y:
      return "F_y";
    case Quantity::x:
      return "x";
    case Quantity::y:
      return "y";
    case Quantity::z:
      return "z";
  }
  return "?";
}

void History::add(const Snapshot& s) {
  for (const AgentView& a : s.agents) {
    auto& samples = agents_[a.name];
    Sample sample{.begun = a.m != 0 || (!samples.empty() && samples.back().begun)};
    for (std::size_t k = 0; k < 3; ++k) {
      sample.F[k] = a.F_a[k];
      sample.p[k] = 1e3 * a.T_0E[k];
    }
    samples.push_back(sample);
    if (samples.size() > kKept) samples.pop_front();
  }
}

std::vector<double> History::samples(const std::string& agent, Quantity q, int width) const {
  const auto it = agents_.find(agent);
  if (it == agents_.end() || width <= 0) return {};
  const auto& all = it->second;
  const auto count = std::min(all.size(), static_cast<std::size_t>(width));
  const bool begun = all.back().begun;
  const auto value = [q, begun](const Sample& s) {
    constexpr std::array<std::size_t, kQuantities.size()> kAxis{2, 0, 1, 0, 1, 2};
    const std::size_t axis = kAxis[static_cast<std::size_t>(q)];
    if (q > Quantity::F_y) return s.p[axis];
    return s.begun || !begun ? s.F[axis] : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<double> values;
  for (std::size_t k = all.size() - count; k < all.size(); ++k) values.push_back(value(all[k]));
  if (q > Quantity::F_y) {
    const double first = value(all[all.size() - count]);
    for (double& v : values) v -= first;
  }
  return values;
}

}  // namespace mrroc::ui
