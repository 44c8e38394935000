#include <fmt/core.h>

#include <cmath>
#include <sstream>

#include "tasks/edge_follow/edge_follow.hpp"
#include "tasks/press/press.hpp"
#include "tasks/rubik/config.hpp"
#include "tasks/rubik/turn/tables.hpp"
#include "test/docs/paper_tables.hpp"
#include "test/tasks/drawing/coordinator_image.hpp"

namespace mrroc::test {
namespace {

constexpr std::array<const char*, 6> kNames{"x", "y", "z", "ax", "ay", "az"};

constexpr const char* kHead = R"(# The papers' tables and the code's

Made from the tables that the programs run on: the numbers of the code are what a behaviour commands when it is executed. After a change
there: `MRROC_UPDATE_DOCS=1 ./run test -R PaperTables`

A row is b, F_d [N, N m], v_d [m/s, rad/s], I [kg, kg m^2], B [s/kg, s/(kg m^2)] of one axis of E; "-" is irrelevant, and cannot be given in the code
(`u(v)`, `g(v, I, B)` and `c(F, I, B)` in `base/axis_command.hpp`). dg is the change of the jaws' distance per macrostep [m]. W is the arm that comes to
the cube, H the one that holds it at first: the paper's indices 1 and 2 contradict each other. Whatever differs says why; more of it:
[decisions.md](decisions.md).
)";

rubik::Parameters cube_task() {
  return rubik::read_parameters(Config::parse(std::string(rubik::config()), "rubik.toml"));
}

/// What the code has, the velocity of the drawing's node by name where the paper has that.
std::string code_cell(const std::string& printed, const AxisCommand& row) {
  return printed.find("node") != std::string::npos && same(printed, row) ? printed : written(row);
}

std::string verdict(const PaperTable& t, const std::string& axis, bool equal) {
  const auto note = t.notes.find(axis);
  if (note != t.notes.end()) return note->second;
  return equal ? "same" : "DIFFERS";
}

/// Axes one after the other that have the same in all columns share a line.
std::string table(const PaperTable& t) {
  const Commanded code = t.code();
  std::string text =
      fmt::format("\n### {}: {}\n\nCode: {}\n\n| axis | paper | code | |\n| --- | --- | --- | --- |\n",
                  t.name, t.what, t.source);
  std::string axes, columns;
  const auto write = [&](const std::string& axis, const std::string& cells) {
    if (cells != columns && !axes.empty()) text += fmt::format("| {} | {} |\n", axes, columns);
    axes = cells == columns ? axes + ", " + axis : axis;
    columns = cells;
  };
  for (std::size_t k = 0; k < kNames.size(); ++k) {
    const AxisCommand& row = code.frame[kAxes[k]];
    write(kNames[k], fmt::format("{} | {} | {}", t.printed[k], code_cell(t.printed[k], row),
                                 verdict(t, kNames[k], same(t.printed[k], row))));
  }
  if (!t.printed_jaws.empty()) {
    const double jaws = code.jaws.value_or(0);
    write("dg", fmt::format("{} | {:g} | {}", t.printed_jaws, jaws,
                            verdict(t, "dg", std::abs(std::stod(t.printed_jaws) - jaws) < 1e-12)));
  }
  write("", "");
  return text;
}

/// B about the face's axis as an arm commands it when m = 5 begins.
double mobility_at_first(double ordered) {
  rubik::Arm::X x;
  x.T.cube.turn = {.mobility = ordered};
  return rubik::begin_turn(x).mobility;
}

/// What the tables of the cube say of the code, and what they do not say.
std::string words_on_the_cube() {
  const rubik::Parameters cube = cube_task();
  return fmt::format(R"(
These rows are what the arms command when nothing else is ordered. In table 7(a) F_d and B about z come with the order: `./run rubik` orders {:g} N m and
B = {:g}, but B is not that from the beginning. The turn begins with B = {:g}, has that while the face resists with more than {:g} % of F_d, and otherwise
grows by {:g} % in every macrostep up to what was ordered. With the table's B = {:g} it begins with {:g} and stays there
([why](decisions-cube.md)).
)",
                     cube.torque, cube.mobility, mobility_at_first(cube.mobility), 100 * rubik::kResists,
                     100 * (rubik::kQuicken - 1), rubik::kTurn.az.mobility,
                     mobility_at_first(rubik::kTurn.az.mobility));
}

/// Instants and thresholds of the terminal conditions.
std::string conditions() {
  const rubik::Parameters cube = cube_task();
  const drawing::Coordinator::X x = drawing::image();
  return fmt::format(R"(
## What ends the behaviours

| equation | paper | code | |
| --- | --- | --- | --- |
| MS 2 | F_d = 0 along z, and 1 N in the text | m = 2: {:g} N while the pen is on the paper, else 0; `task.teach_force` | 1 N in the air would sink at 5 mm/s |
| MS (45) | both pens on the paper | and {} macrosteps since, `task.settle` | without it the pen bounces |
| MS (50) | i_d macrosteps, no number | {}, `task.lift_off` | |
| MG (66) | F_z > 4 N | F_z > {:g} N, `kApproachForce` | 4 N is what v/B settles at, and would not be crossed on soft contacts |
| MG (69) | i_d macrosteps, no number | {}, `kSettling` | |
| MG (71) | 0.06 m | {:g} m, `kNarrow` | |
| MG (72) | the jaws are blocked | the same | |
| MG (75) | 90 degrees, magnitude | {:g} degrees, signed and unwrapped | a magnitude ends at 180 degrees |
| MG (77) | opened by 0.02 m | {:g} m, `kRelease` | |
| MG 7(a) | 5 N m, B = 0.025 for the whole task | `./run rubik`: {:g} N m, B from {:g} to {:g}; `task.torque`, `task.mobility` | four times as fast; contact forces stay below the drivers' limit |
| MG 6(b) | dg = 0.001 m | `./run rubik`: {:g} m per macrostep; `task.grip_step` | the gear of the jaws keeps what an impact presses |
| MG 8(a) | dg = 0.001 m | `./run rubik`: {:g} m per macrostep; `task.opening_step` | opens as fast as the drive can |
)",
                     x.c.k.teach_force, x.c.k.settle, x.c.k.lift_off, rubik::kApproachForce, rubik::kSettling,
                     rubik::kNarrow, rubik::TurnOrder{}.angle * 180 / M_PI, rubik::kRelease, cube.torque,
                     mobility_at_first(cube.mobility), cube.mobility, cube.grip_step, cube.opening_step);
}

/// Axes of a command that do more than stand still.
std::string acting(const EffectorCommand& y) {
  std::string text;
  for (std::size_t k = 0; k < kNames.size(); ++k)
    if (const AxisCommand& row = y.arm.frame[kAxes[k]]; row != u())
      text += fmt::format("{}{}: {}", text.empty() ? "" : "; ", kNames[k], written(row));
  return text.empty() ? "all axes stand" : text;
}

template <class A, std::size_t n>
std::string behaviours(const std::string& name, const std::string& file,
                       const std::array<Motion<A>, n>& rows) {
  std::string text =
      fmt::format("\n### {}\n\n`{}`\n\n| m | name | at the beginning |\n| --- | --- | --- |\n", name, file);
  for (const Motion<A>& row : rows)
    text += fmt::format("| {} | {} | {} |\n", row.m, row.name, acting(row.f_ce(typename A::X{})));
  return text;
}

}  // namespace

std::string written(const AxisCommand& row) {
  switch (row.b) {
    case Behaviour::unguarded:
      return fmt::format("u - {:g} - -", row.velocity);
    case Behaviour::guarded:
      return fmt::format("g - {:g} {:g} {:g}", row.velocity, row.inertia, row.mobility);
    case Behaviour::contact:
      break;
  }
  return fmt::format("c {:g} - {:g} {:g}", row.force, row.inertia, row.mobility);
}

bool same(const std::string& printed, const AxisCommand& row) {
  std::istringstream paper(printed), code(written(row));
  std::string p, c;
  bool equal = true;
  while (paper >> p && code >> c) equal = equal && (p == c || (p == "node" && std::stod(c) != 0));
  return equal;
}

std::string tables_document() {
  std::string text = kHead;
  text += "\n## Drawing: MS tables 1-4\n";
  for (const PaperTable& t : paper_tables()) {
    if (t.name == "MG 4(a)") text += "\n## The cube: MG tables 4-8\n" + words_on_the_cube();
    text += table(t);
  }
  text += conditions();
  text += "\n## Behaviours without a table in the papers\n";
  text += behaviours("press", "tasks/press/press.cpp", press::kPress);
  text += behaviours("edge_follow", "tasks/edge_follow/edge_follow.cpp", edge_follow::kEdgeFollow);
  return text;
}

}  // namespace mrroc::test
