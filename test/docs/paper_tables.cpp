#include "test/docs/paper_tables.hpp"

#include "tasks/rubik/turn/tables.hpp"
#include "test/tasks/drawing/coordinator_image.hpp"

namespace mrroc::test {
namespace {

const std::string kStill = "u - 0 - -";
const PrintedRows kAllStill{kStill, kStill, kStill, kStill, kStill, kStill};

/// What the coordinator of the drawing task sends to an arm. Its node has velocities that no table has.
std::function<Commanded()> drawing_order(int m, std::size_t arm) {
  return [m, arm] {
    auto x = drawing::image();
    x.c.recording = drawing::recording({m == 5 ? PenState::paper_surface : PenState::above_paper});
    return Commanded{drawing::row(m).f_cT(x)[arm].arm.frame, {}};
  };
}

/// What an arm of the cube task commands, with the jaws in the middle.
std::function<Commanded()> cube_command(const std::array<Motion<rubik::Arm>, 6>& rows, std::size_t m) {
  return [&rows, m] {
    rubik::Arm::X x;
    x.e.gripper = 0.07;
    const EffectorCommand y = rows[m - 1].f_ce(x);
    const double jaws = y.arm.gripper == 0 ? 0 : y.arm.gripper - x.e.gripper;
    return Commanded{y.arm.frame, jaws};
  };
}

const std::string kDrawing = "`tasks/drawing/tables.hpp`, ";
const std::string kCube = "`tasks/rubik/turn/tables.hpp`, ";

std::vector<PaperTable> drawing_tables() {
  const std::string free = "c 0 - 20 0.005";
  return {
      {"MS 1", "m = 1, 2: arm 2 is blocked", "", kAllStill, kDrawing + "`kBlocked`", drawing_order(1, 1), {}},
      {"MS 2",
       "m = 1, 2, arm 1, and m = 3, both: compliant along lines",
       "",
       {free, free, free, kStill, kStill, kStill},
       kDrawing + "`kCompliant`",
       drawing_order(1, 0),
       {}},
      {"MS 3(a)",
       "m = 4: lowering",
       "",
       {kStill, kStill, "g - 0.01 20 0.005", kStill, kStill, kStill},
       kDrawing + "`kLowering`",
       drawing_order(4, 0),
       {}},
      {"MS 3(b)",
       "m = 6: lift-off",
       "",
       {kStill, kStill, "u - -0.01 - -", kStill, kStill, kStill},
       kDrawing + "`kLiftOff`",
       drawing_order(6, 0),
       {}},
      {"MS 4(a)",
       "m = 5: on the paper; along x and y the velocity of the node",
       "",
       {"u - node - -", "u - node - -", "c 1 - 20 0.005", kStill, kStill, kStill},
       kDrawing + "`kOnPaper`",
       drawing_order(5, 0),
       {}},
      {"MS 4(b)",
       "m = 7: above the paper; along x and y the velocity of the node",
       "",
       {"u - node - -", "u - node - -", "u 1 0 - -", kStill, kStill, kStill},
       kDrawing + "`kAbovePaper`",
       drawing_order(7, 0),
       {{"z", "an unguarded axis has no F_d: the printed 1 has no effect in (28), and `u()` takes none"}}},
  };
}

std::vector<PaperTable> cube_tables() {
  const std::string free = "c 0 - 20 0.005";
  const auto moves = [](const char* table, const char* words, const char* jaws, const PrintedRows& rows,
                        const char* name, const auto& role, int m) {
    return PaperTable{table, words, jaws, rows, kCube + "`" + name + "`", cube_command(role, m), {}};
  };
  const auto stands = [&](const char* table, const char* words, const auto& role, int m) {
    return moves(table, words, "0", kAllStill, "kStill", role, m);
  };
  const auto& worker = rubik::kWorker;
  const auto& holder = rubik::kHolder;
  return {
      moves("MG 4(a)", "m = 1, 2: W comes to the cube", "0",
            {kStill, kStill, "g - 0.01 5 0.0025", kStill, kStill, kStill}, "kApproach", worker, 1),
      stands("MG 4(b)", "m = 1, 2: H stands", holder, 1),
      stands("MG 5(a)", "m = 3: H stands", holder, 3),
      moves("MG 5(b)", "m = 3: W closes, compliant along y", "-0.001",
            {kStill, free, kStill, kStill, kStill, kStill}, "kCloseY", worker, 3),
      stands("MG 6(a)", "m = 4: H stands", holder, 4),
      moves("MG 6(b)", "m = 4: W closes, compliant along x and y", "-0.001",
            {free, free, kStill, kStill, kStill, kStill}, "kCloseXY", worker, 4),
      moves("MG 7(a)", "m = 5: H turns the face", "0", {free, free, free, kStill, kStill, "c 5 - 0.5 0.025"},
            "kTurn", holder, 5),
      stands("MG 7(b)", "m = 5: W stands", worker, 5),
      moves("MG 8(a)", "m = 6: H opens", "0.001", kAllStill, "kStill", holder, 6),
      stands("MG 8(b)", "m = 6: W stands", worker, 6),
  };
}

}  // namespace

std::vector<PaperTable> paper_tables() {
  auto all = drawing_tables();
  for (PaperTable& t : cube_tables()) all.push_back(std::move(t));
  return all;
}

}  // namespace mrroc::test
