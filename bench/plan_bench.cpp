// Plans of grasps for solutions of random cubes, beside the fixed table of face changes that the original used.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <random>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/meeting_search.hpp"
#include "tasks/rubik/cell/layout.hpp"
#include "tasks/rubik/cell/plan_cell.hpp"
#include "tasks/rubik/plan/planner.hpp"
#include "tasks/rubik/solver/solver.hpp"
#include "tasks/rubik/solver/table_progress.hpp"

namespace mrroc::bench {
namespace {

using namespace rubik;
using std::chrono::steady_clock;

constexpr int kCubes = 100;
constexpr int kScramble = 20;
constexpr int kPlaces = 60'000;
constexpr std::uint64_t kNodes = 200000;  // of the solver's search: some milliseconds

/// What the original does for one solution: the arm on the pedestal has the cube with its palm on `front`. A face change
/// brings another face there: the arm on the track takes the cube from a side, the other one comes to it anew.
class OriginalTable {
 public:
  void turn(Face face) {
    const auto where = static_cast<int>(std::ranges::find(at_, face) - at_.begin());
    switch (where) {
      case up:
        return change(kUpToFront);
      case down:
        return change(kDownToFront);
      case left:
        return change(kLeftToFront);
      case right:
        return change(kRightToFront);
      default:
        // A change, a turn by nothing, and the face is up or down.
        change(kLeftToFront);
        ++empty_turns;
        return change(where == front ? kUpToFront : kDownToFront);
    }
  }

  int changes{};      ///< of the face
  int empty_turns{};  ///< in which the cube is only handed over

 private:
  enum Place { up, down, front, rear, left, right };
  using Change = std::array<int, kFaces>;  // where the faces come from
  static constexpr Change kUpToFront{left, right, up, down, front, rear};
  static constexpr Change kDownToFront{right, left, down, up, front, rear};
  static constexpr Change kLeftToFront{front, rear, left, right, up, down};
  static constexpr Change kRightToFront{front, rear, right, left, down, up};

  void change(const Change& from) {
    const auto before = at_;
    for (std::size_t k = 0; k < at_.size(); ++k) at_[k] = before[static_cast<std::size_t>(from[k])];
    ++changes;
  }

  std::array<Face, kFaces> at_{Face::U, Face::D, Face::F, Face::B, Face::L, Face::R};
};

struct Mean {
  double sum{};
  int count{};
  void add(double x) {
    sum += x;
    ++count;
  }
  [[nodiscard]] double value() const { return count > 0 ? sum / count : 0; }
};

/// What the plans of all cubes are like.
struct PlanMeans {
  Mean turns, regrasps, seconds, changes, wall;  // of a plan
  Mean turn_step, hand_over, side;               // seconds of the kinds of step
  std::vector<std::pair<OriginalTable, Plan>> all;
};

/// @return the arms before a plan: the one on the pedestal has the cube, the other one has drawn back
PlanStart start_of_plans(const CubePlanCell& cell) {
  PlanStart start{{Hand::postument, Face::F, Face::R}, cell.meeting().joints};
  const Pose back =
      cell.forward(Hand::track, start.joints[1]) * Pose{Matrix3::Identity(), {0, 0, -kRetreatDistance}};
  start.joints[1] = cell.inverse(Hand::track, back, start.joints[1]).value();
  return start;
}

void add_plan(PlanMeans& means, const Plan& plan, const Moves& moves) {
  OriginalTable original;
  for (const Move m : moves) original.turn(m.face());
  means.turns.add(static_cast<double>(plan.turns.size()));
  means.regrasps.add(plan.regrasps);
  means.seconds.add(plan.seconds);
  means.changes.add(original.changes + original.empty_turns);
  for (const Step& s : plan.steps) {
    Mean& kind = s.turn ? means.turn_step : s.comes == Hand::track ? means.side : means.hand_over;
    kind.add(s.seconds);
  }
  means.all.emplace_back(original, plan);
}

PlanMeans plan_random_cubes(const CubeSolver& solver, Planner& planner, const PlanStart& start) {
  PlanMeans means;
  for (int k = 0; k < kCubes; ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k + 1));
    const Cube cube = after({}, random_moves(kScramble, random));
    const Moves moves = solver.solve_in_two_phases(cube, {.nodes = kNodes}).moves;
    const auto begin = steady_clock::now();
    const Planned planned = planner.make_plan(start, moves);
    means.wall.add(std::chrono::duration<double>(steady_clock::now() - begin).count());
    if (!planned.plan) throw FaultError(FaultCode::internal_error, "no plan of grasps: " + planned.text);
    if (after(cube, planned.plan->turns) != Cube{})
      throw FaultError(FaultCode::internal_error, "a plan of grasps does other turns");
    add_plan(means, *planned.plan, moves);
  }
  return means;
}

/// @return mean time with the original's table, where the same kinds of step take the same times
double seconds_with_table(const PlanMeans& means) {
  Mean table;
  for (const auto& [original, plan] : means.all)
    table.add(static_cast<double>(plan.turns.size()) * means.turn_step.value() +
              original.changes * means.side.value() + original.empty_turns * means.hand_over.value());
  return table.value();
}

}  // namespace

Figures run_plan_group() {
  TableProgress progress(stderr);
  constexpr int kThreadsForTables = 2;
  const CubeSolver solver(TableSet::standard, table_folder(), kThreadsForTables, progress.watch());
  const CubePlanCell cell(usual_cell(), viewing_place());
  Planner planner(cell);
  const PlanStart start = start_of_plans(cell);
  const PlanMeans means = plan_random_cubes(solver, planner, start);
  const Planned reading = planner.make_reading_plan(start);
  if (!reading.plan)
    throw FaultError(FaultCode::internal_error, "no plan to show all faces: " + reading.text);
  const MeetingCandidate found = search_meeting(cell, kPlaces, 1);
  return {
      {"meeting_reach", meeting_reach(cell, cell.meeting()), "",
       "least margin at the place where the arms meet, from limits and the wrist's singularity"},
      {"meeting_reach_found", found.reach, "",
       "the same of the best place of 60,000 at random, bettered, without collisions"},
      {"plan_turns", means.turns.value(), "", "mean over 100 cubes of 20 random turns, solved in two phases"},
      {"plan_regrasps", means.regrasps.value(), "",
       "steps in which the cube changes hands and nothing is turned, mean"},
      {"plan_regrasps_table", means.changes.value(), "",
       "the same with the original's table of face changes"},
      {"plan_s", means.seconds.value(), "s", "estimated time of a solution, mean"},
      {"plan_table_s", seconds_with_table(means), "s", "the same with the original's table"},
      {"plan_wall_s", means.wall.value(), "s", "time to plan a solution, mean"},
      {"plan_reading_s", reading.plan->seconds, "s", "estimated time to show all six faces"},
      {"plan_reading_grips", static_cast<double>(reading.plan->grips), "", "grips while they are shown"},
  };
}

}  // namespace mrroc::bench
