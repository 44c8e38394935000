// Turns of a face of the cube between two grippers, over seeds of friction, face, direction and grasp error.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <future>
#include <numbers>
#include <vector>

#include "bench/figures.hpp"
#include "test/rig/cube_turn.hpp"

namespace mrroc::bench {
namespace {

constexpr int kTurns = 100;
constexpr int kAtOnce = 2;
constexpr double kDegrees = 180 / std::numbers::pi;
constexpr int kKinds = 12;  // six faces in two directions

/// Faces and directions in order, everything else drawn from the seed.
rig::TurnPlan plan_of(int k) {
  rig::TurnPlan plan = rig::random_turn(static_cast<std::uint64_t>(k + 1));
  plan.cell.face = static_cast<cube::Face>(k % cube::kFaces);
  plan.quarters = k / cube::kFaces % 2 == 0 ? 1 : -1;
  return plan;
}

/// Does every kAtOnce-th turn. @param all  gets each at its place
void turn(int first, std::vector<rig::TurnFigures>& all) {
  for (int k = first; k < kTurns; k += kAtOnce) {
    rig::TurnFigures& f = all[static_cast<std::size_t>(k)];
    f = rig::turn_face(plan_of(k), static_cast<std::uint64_t>(k + 1));
    std::fprintf(stderr, "cube: turn %d of %d, %s: %.2f mm, %.2f deg, %.1f N, %.1f N m\n", k + 1, kTurns,
                 f.turned && f.done ? f.attempts == 1 ? "turned" : "turned at a later attempt" : "NOT TURNED",
                 1e3 * f.slip, kDegrees * f.angle_error, f.lateral_peak, f.torque_peak);
  }
}

bool at_once(const rig::TurnFigures& f) { return f.turned && f.done && f.attempts == 1 && f.grips == 1; }

/// Of one face and direction.
struct Kind {
  int turns{};
  double share{100};  // that is turned at once [%]
};

/// @return the face and direction that succeed least
Kind worst_kind(const std::vector<rig::TurnFigures>& all) {
  std::array<int, kKinds> tried{}, good{};
  for (std::size_t k = 0; k < all.size(); ++k) {
    ++tried[k % kKinds];
    good[k % kKinds] += at_once(all[k]);
  }
  Kind least;
  for (std::size_t k = 0; k < kKinds; ++k)
    if (const double share = 100. * good[k] / tried[k]; least.turns == 0 || share < least.share)
      least = {tried[k], share};
  return least;
}

}  // namespace

Figures run_cube_group() {
  const auto begin = std::chrono::steady_clock::now();
  std::vector<rig::TurnFigures> all(kTurns);
  std::vector<std::future<void>> shares;
  for (int k = 0; k < kAtOnce; ++k) shares.push_back(std::async(std::launch::async, turn, k, std::ref(all)));
  for (auto& share : shares) share.get();
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();

  const auto mean = [&](double rig::TurnFigures::*figure) {
    double sum = 0;
    for (const auto& f : all) sum += f.*figure;
    return sum / static_cast<double>(all.size());
  };
  const auto most = [&](double rig::TurnFigures::*figure) {
    return std::ranges::max(all, {}, figure).*figure;
  };
  using F = rig::TurnFigures;
  const auto share = [&](auto is_so) {
    return 100. * static_cast<double>(std::ranges::count_if(all, is_so)) / kTurns;
  };
  const Kind least = worst_kind(all);
  const double good = share([](const F& f) { return f.turned && f.done; });
  return {
      {"turn_first_try_pct", share(at_once), "%",
       "quarter turns that end well at once, over faces, directions, friction, 1 mm and 1 deg, wanted >= 99"},
      {"turn_worst_case_pct", least.share, "%",
       fmt::format("the same for the face and direction where it is least: of {} turns, one is {:.3g} %",
                   least.turns, 100. / least.turns)},
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
