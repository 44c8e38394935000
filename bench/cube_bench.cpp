// Turns of a face of the cube between two grippers, over seeds of friction, face, direction and grasp error.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <future>
#include <numbers>
#include <vector>

#include "bench/figures.hpp"
#include "sim/cube_turn.hpp"

namespace mrroc::bench {
namespace {

constexpr int kTurns = 100;
constexpr int kAtOnce = 2;

std::vector<sim::TurnFigures> turns(int first) {
  std::vector<sim::TurnFigures> all;
  for (int k = first; k < kTurns; k += kAtOnce) {
    const auto seed = static_cast<std::uint64_t>(k + 1);
    all.push_back(sim::turn_face(sim::random_turn(seed), seed));
    std::fprintf(stderr, "cube: turn %d of %d\n", k + 1, kTurns);
  }
  return all;
}

}  // namespace

Figures run_cube_group() {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<std::future<std::vector<sim::TurnFigures>>> shares;
  for (int k = 0; k < kAtOnce; ++k) shares.push_back(std::async(std::launch::async, turns, k));
  std::vector<sim::TurnFigures> all;
  for (auto& share : shares) {
    const auto part = share.get();
    all.insert(all.end(), part.begin(), part.end());
  }
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const auto mean = [&](double sim::TurnFigures::*figure) {
    double sum = 0;
    for (const auto& f : all) sum += f.*figure;
    return sum / static_cast<double>(all.size());
  };
  const auto most = [&](double sim::TurnFigures::*figure) {
    return std::ranges::max(all, {}, figure).*figure;
  };
  using F = sim::TurnFigures;
  const auto share = [&](auto is_so) {
    return 100. * static_cast<double>(std::ranges::count_if(all, is_so)) / kTurns;
  };
  const double good = share([](const F& f) { return f.turned && f.done; });
  const double at_once = share([](const F& f) { return f.turned && f.done && f.attempts == 1; });
  constexpr double kDegrees = 180 / std::numbers::pi;
  return {
      {"turn_first_try_pct", at_once, "%",
       "quarter turns that end well at once, over faces, directions, friction, 1 mm and 1 deg, wanted >= 99"},
      {"turn_final_pct", good, "%", "the same after the task's three attempts, wanted 100"},
      {"turn_approach_settled_N", mean(&F::approach_settled), "N", "F_z of the worker at the end of m = 2"},
      {"turn_approach_peak_N", most(&F::approach_peak), "N", "F_z of the worker, impact, largest"},
      {"turn_lateral_std_N", most(&F::lateral_std), "N", "x, y, z of the holder in m = 5, worst"},
      {"turn_steady_std_N", most(&F::steady_std), "N", "the same without the first 0.5 s"},
      {"turn_lateral_peak_N", most(&F::lateral_peak), "N", "the same, largest force"},
      {"turn_torque_peak_Nm", most(&F::torque_peak), "N m", "about the face's axis, largest"},
      {"turn_angle_err_deg", kDegrees * most(&F::angle_error), "deg",
       "face behind tool before its seat, largest"},
      {"turn_slip_mm", 1e3 * most(&F::slip), "mm", "of the cube in the holder, largest"},
      {"turn_squeeze_N", most(&F::squeeze), "N", "of a pad on the cube, largest"},
      {"turn_s", mean(&F::turn_s), "s", "m = 5"},
      {"turn_cycle_s", mean(&F::cycle_s), "s", "m = 1..6"},
      {"turn_real_time_factor", kTurns * mean(&F::cycle_s) / wall, "x",
       "both cores together, preparation not counted"},
  };
}

}  // namespace mrroc::bench
