// Plans of grasps for solutions of random cubes, beside the fixed table of face changes that the original used.
#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <random>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "bench/meeting_search.hpp"
#include "sim/cube_cell.hpp"
#include "sim/plan_cell.hpp"
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
      case kUp:
        return change(kUpToFront);
      case kDown:
        return change(kDownToFront);
      case kLeft:
        return change(kLeftToFront);
      case kRight:
        return change(kRightToFront);
      default:
        // A change, a turn by nothing, and the face is up or down.
        change(kLeftToFront);
        ++empty_turns;
        return change(where == kFront ? kUpToFront : kDownToFront);
    }
  }

  int changes{};      ///< of the face
  int empty_turns{};  ///< in which the cube is only handed over

 private:
  enum Place { kUp, kDown, kFront, kRear, kLeft, kRight };
  using Change = std::array<int, kFaces>;  // where the faces come from
  static constexpr Change kUpToFront{kLeft, kRight, kUp, kDown, kFront, kRear};
  static constexpr Change kDownToFront{kRight, kLeft, kDown, kUp, kFront, kRear};
  static constexpr Change kLeftToFront{kFront, kRear, kLeft, kRight, kUp, kDown};
  static constexpr Change kRightToFront{kFront, kRear, kRight, kLeft, kDown, kUp};

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

}  // namespace

Figures run_plan_group() {
  TableProgress progress(stderr);
  constexpr int kThreadsForTables = 2;
  const CubeSolver solver(TableSet::standard, table_folder(), kThreadsForTables, progress.watch());
  const sim::WorldParameters world = sim::cube_cell({});
  const sim::CubePlanCell cell(world, sim::viewing_place());
  Planner planner(cell);
  PlanStart start{{Hand::postument, Face::F, Face::R}, cell.meeting().joints};
  const Pose back =
      cell.forward(Hand::track, start.joints[1]) * Pose{Matrix3::Identity(), {0, 0, -kRetreatDistance}};
  start.joints[1] = cell.inverse(Hand::track, back, start.joints[1]).value();

  Mean turns, regrasps, seconds, changes, wall, longest, turn_step, hand_over, side;
  std::vector<std::pair<OriginalTable, Plan>> all;
  for (int k = 0; k < kCubes; ++k) {
    std::mt19937_64 random(static_cast<std::uint64_t>(k + 1));
    const Cube cube = after({}, random_moves(kScramble, random));
    const Moves moves = solver.solve_in_two_phases(cube, {.nodes = kNodes}).moves;
    const auto begin = steady_clock::now();
    const Planned planned = planner.make_plan(start, moves);
    wall.add(std::chrono::duration<double>(steady_clock::now() - begin).count());
    if (!planned.plan) throw FaultError(FaultCode::internal_error, "no plan of grasps: " + planned.text);
    const Plan& plan = *planned.plan;
    if (after(cube, plan.turns) != Cube{})
      throw FaultError(FaultCode::internal_error, "a plan of grasps does other turns");
    OriginalTable original;
    for (const Move m : moves) original.turn(m.face());
    turns.add(static_cast<double>(plan.turns.size()));
    regrasps.add(plan.regrasps);
    seconds.add(plan.seconds);
    changes.add(original.changes + original.empty_turns);
    for (const Step& s : plan.steps) {
      Mean& kind = s.turn ? turn_step : s.comes == Hand::track ? side : hand_over;
      kind.add(s.seconds);
    }
    all.emplace_back(original, plan);
  }
  // The same times for the same kinds of step.
  Mean table;
  for (const auto& [original, plan] : all)
    table.add(static_cast<double>(plan.turns.size()) * turn_step.value() + original.changes * side.value() +
              original.empty_turns * hand_over.value());

  const Planned reading = planner.make_reading_plan(start);
  if (!reading.plan)
    throw FaultError(FaultCode::internal_error, "no plan to show all faces: " + reading.text);
  const MeetingCandidate found = search_meeting(cell, kPlaces, 1);
  return {
      {"meeting_reach", meeting_reach(cell, cell.meeting()), "",
       "least margin at the place where the arms meet, from limits and the wrist's singularity"},
      {"meeting_reach_found", found.reach, "",
       "the same of the best place of 60,000 at random, bettered, without collisions"},
      {"plan_turns", turns.value(), "", "mean over 100 cubes of 20 random turns, solved in two phases"},
      {"plan_regrasps", regrasps.value(), "",
       "steps in which the cube changes hands and nothing is turned, mean"},
      {"plan_regrasps_table", changes.value(), "", "the same with the original's table of face changes"},
      {"plan_s", seconds.value(), "s", "estimated time of a solution, mean"},
      {"plan_table_s", table.value(), "s", "the same with the original's table"},
      {"plan_wall_s", wall.value(), "s", "time to plan a solution, mean"},
      {"plan_reading_s", reading.plan->seconds, "s", "estimated time to show all six faces"},
      {"plan_reading_grips", static_cast<double>(reading.plan->grips), "", "grips while they are shown"},
  };
}

}  // namespace mrroc::bench
