#include "tasks/rex_drive/plan/built_in_plans.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

namespace mrroc::rex_drive {
namespace {

using std::numbers::pi;

/// x = 2 sin s, y = sin 2 s: one lap from the crossing back to it.
PlanList figure_eight() {
  constexpr int kPoints = 24, kFine = 2400;
  MapPoints lap;
  const auto at = [](double s) { return MapPoint{2 * std::sin(s), std::sin(2 * s)}; };
  const auto length = [&](int k) {
    const MapPoint a = at(2 * pi * (k - 1) / kFine), b = at(2 * pi * k / kFine);
    return std::hypot(b.x - a.x, b.y - a.y);
  };
  double whole = 0, way = 0;
  for (int k = 1; k <= kFine; ++k) whole += length(k);
  for (int k = 1; k <= kFine; ++k) {
    way += length(k);
    if (way >= whole * static_cast<double>(lap.size() + 1) / kPoints - 1e-9)
      lap.push_back(at(2 * pi * k / kFine));
  }
  return {.start = {0, 0, pi / 4}, .plans = {lap, lap}};
}

PlanList corner() {
  constexpr double kRadius = 0.4;
  constexpr int kOfTurn = 2;
  MapPoints points{{0.5, 0}, {1.0, 0}};
  for (int k = 1; k <= kOfTurn; ++k) {
    const double angle = k * pi / 2 / kOfTurn;
    points.push_back({1.0 + kRadius * std::sin(angle), kRadius * (1 - std::cos(angle))});
  }
  points.push_back({1.0 + kRadius, 0.8});
  points.push_back({1.0 + kRadius, 1.3});
  return {.plans = {points}};
}

PlanList slalom() {
  constexpr int kHalfWaves = 4, kPerHalfWave = 3, kOfTurn = 4;
  constexpr double kHalfWave = 0.875, kHeight = 0.2, kTurn = 0.45;
  MapPoints there, back;
  for (int k = 1; k <= kHalfWaves * kPerHalfWave; ++k)
    there.push_back({-1.75 + k * kHalfWave / kPerHalfWave, -0.6 + kHeight * std::sin(k * pi / kPerHalfWave)});
  for (int k = 1; k <= kOfTurn; ++k)
    back.push_back(
        {1.75 + kTurn * std::sin(k * pi / kOfTurn), -0.6 + kTurn * (1 - std::cos(k * pi / kOfTurn))});
  for (int k = 1; k <= 7; ++k) back.push_back({1.75 - 0.5 * k, 0.3});
  return {.start = {-1.75, -0.6, std::atan2(kHeight * pi, kHalfWave)}, .plans = {there, back}};
}

PlanList square() { return {.plans = {{{1.6, 0}, {1.6, 1.2}, {0, 1.2}, {0, 0}}}}; }

PlanList pivot() { return {.plans = {{{1, 0}, {1, 1}}}}; }

PlanList there_and_back() { return {.plans = {{{0.75, 0}, {1.5, 0}, {0.75, 0}, {0, 0}}}}; }

struct BuiltIn {
  std::string_view name;
  PlanList (*make)();
};
constexpr std::array kBuiltIn{BuiltIn{"figure_eight", figure_eight},
                              BuiltIn{"corner", corner},
                              BuiltIn{"slalom", slalom},
                              BuiltIn{"square", square},
                              BuiltIn{"pivot", pivot},
                              BuiltIn{"there_and_back", there_and_back}};

}  // namespace

std::span<const std::string_view> built_in_plan_names() {
  static constexpr auto kNames = [] {
    std::array<std::string_view, kBuiltIn.size()> names;
    std::ranges::transform(kBuiltIn, names.begin(), &BuiltIn::name);
    return names;
  }();
  return kNames;
}

bool is_built_in(std::string_view plan) {
  return std::ranges::find(built_in_plan_names(), plan) != built_in_plan_names().end();
}

PlanList built_in_plan(std::string_view name) {
  const auto found = std::ranges::find(kBuiltIn, name, &BuiltIn::name);
  if (found == kBuiltIn.end()) throw std::out_of_range("no built-in plan " + std::string(name));
  PlanList plans = found->make();
  plans.name = name;
  return plans;
}

}  // namespace mrroc::rex_drive
