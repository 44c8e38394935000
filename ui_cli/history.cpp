#include "ui_cli/history.hpp"

#include <algorithm>
#include <limits>

namespace mrroc::ui {
namespace {

bool is_force(Quantity q) { return q <= Quantity::F_y; }
bool is_place(Quantity q) { return q >= Quantity::x && q <= Quantity::z; }

}  // namespace

std::span<const Quantity> quantities_of(EffectorKind kind) {
  static constexpr std::array kArm{Quantity::F_z, Quantity::F_x, Quantity::F_y,
                                   Quantity::x,   Quantity::y,   Quantity::z};
  static constexpr std::array kPlatform{Quantity::v, Quantity::w, Quantity::x, Quantity::y};
  if (kind == EffectorKind::arm) return kArm;
  if (kind == EffectorKind::platform) return kPlatform;
  return {};
}

std::string_view unit_of(Quantity q) {
  return is_force(q) ? "N" : is_place(q) ? "mm" : q == Quantity::v ? "m/s" : "rad/s";
}

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
    case Quantity::v:
      return "v";
    case Quantity::w:
      return "w";
  }
  return "?";
}

void History::add(const Snapshot& s) {
  for (const AgentView& a : s.agents) {
    auto& samples = agents_[a.name];
    samples.push_back({.value = {a.F_a[2], a.F_a[0], a.F_a[1], 1e3 * a.T_0E[0], 1e3 * a.T_0E[1],
                                 1e3 * a.T_0E[2], a.velocity[0], a.velocity[2]},
                       .begun = a.m != 0 || (!samples.empty() && samples.back().begun)});
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
    const bool told = !is_force(q) || s.begun || !begun;
    return told ? s.value[static_cast<std::size_t>(q)] : std::numeric_limits<double>::quiet_NaN();
  };
  std::vector<double> values;
  for (std::size_t k = all.size() - count; k < all.size(); ++k) values.push_back(value(all[k]));
  if (is_place(q)) {
    const double first = value(all[all.size() - count]);
    for (double& v : values) v -= first;
  }
  return values;
}

}  // namespace mrroc::ui
