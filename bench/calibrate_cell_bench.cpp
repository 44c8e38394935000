// The task calibrate_cell over cells: bases, balls and sensors that nobody tells the arms.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "base/spatial.hpp"
#include "bench/figures.hpp"
#include "bench/run_summary.hpp"
#include "bench/task_process.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kRuns = 50;
constexpr double kFar = 0.005;                // of a base from where it is believed [m]
constexpr double kTurned = 0.5 * M_PI / 180;  // the same [rad]

class Cell {
 public:
  explicit Cell(unsigned seed) : random_(seed) {}

  /// @return a number from low to high, the same on every machine
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(random_()) / 4294967296.0;
  }
  /// @return a vector of that length, or shorter
  Vector3 vector(double longest) {
    Vector3 v;
    for (double& x : v) x = between(-1, 1);
    return between(0.5, 1) * longest * v.normalized();
  }

 private:
  std::mt19937 random_;
};

/// @return a displacement as a table @param turn, shift  lengths of the longest [rad], [m]
std::string displacement(Cell& cell, double turn, double shift) {
  const Vector3 a = cell.vector(turn), p = cell.vector(shift);
  return fmt::format("{{ x = {:.7f}, y = {:.7f}, z = {:.7f}, ax = {:.7f}, ay = {:.7f}, az = {:.7f} }}", p.x(),
                     p.y(), p.z(), a.x(), a.y(), a.z());
}

/// Errors of cameras and board, which leave those of the rest of the cell as they were.
struct Displacements {
  explicit Displacements(unsigned seed) {
    Cell cell(seed + kRuns);
    board = displacement(cell, 2 * kTurned, kFar);
    hand = displacement(cell, kTurned, 0.003);
    fixed = displacement(cell, kTurned, 0.003);
  }
  std::string board, hand, fixed;
};

std::vector<std::string> arguments(const fs::path& folder, unsigned seed) {
  Cell cell(seed);
  std::vector<std::string> a{"--seed", std::to_string(seed), "--processes",
                             "one",    "--run-dir",          folder.string()};
  const auto set = [&](const std::string& what) { a.insert(a.end(), {"--set", what}); };
  for (const char* arm : {"arm1", "arm2"}) {
    set(fmt::format("sim.robots.{}.base_error={}", arm, displacement(cell, kTurned, kFar)));
    set(fmt::format("sim.robots.{}.tool.mass_scale={:.3f}", arm, cell.between(0.9, 1.1)));
    set(fmt::format("sim.robots.{}.sensor.gain={:.3f}", arm, cell.between(0.97, 1.03)));
    set(fmt::format("sim.robots.{}.friction_scale={:.3f}", arm, cell.between(0.5, 2)));
  }
  const Displacements more(seed);
  set("sim.object.place_error=" + more.board);
  set("sim.cameras.eih.place_error=" + more.hand);
  set("sim.cameras.sac.place_error=" + more.fixed);
  set("sim.artefact.place_error=" + displacement(cell, 0.02, 0.005));
  set(fmt::format("sim.sensor.force_noise={:.4f}", cell.between(0.02, 0.15)));
  set(fmt::format("sim.paper.friction={:.3f}", cell.between(0.05, 0.3)));
  set(fmt::format("sim.paper.stiffness={:.1f}", std::exp(cell.between(std::log(5000), std::log(40000)))));
  return a;
}

}  // namespace

Figures run_calibrate_cell_group() {
  const ScratchFolder scratch;
  struct Worst {
    const char* key;
    const char* unit;
    const char* words;
    double value{};
  };
  std::vector<Worst> worst{
      {"base_err_mm", "mm", "base of arm2 from that of arm1 afterwards, off the truth, worst"},
      {"base_err_deg", "deg", "its direction, worst"},
      {"base_before_mm", "mm", "the same before, worst"},
      {"camera_base_err_mm", "mm", "the same base by pictures, worst"},
      {"camera_base_err_deg", "deg", "its direction, worst"},
      {"way_difference_mm", "mm", "between both ways, worst"},
      {"way_difference_deg", "deg", "their directions, worst"},
      {"camera_place_err_mm", "mm", "camera in the hand, believed up to 3 mm and 0.5 degrees wrong, worst"},
      {"camera_place_err_deg", "deg", "its direction, worst"},
      {"fixed_camera_err_mm", "mm", "camera that stands alone, worst"},
      {"fixed_camera_err_deg", "deg", "its direction, worst"}};
  double failed = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const fs::path folder = scratch.path() / "run";
    TaskProcess task("calibrate_cell", arguments(folder, seed));
    failed += task.wait() != 0;
    const nlohmann::json summary = run_summary(folder);
    if (!summary.is_null())
      for (Worst& w : worst)
        if (const auto value = summary.at("figures").value(w.key, nlohmann::json()); value.is_number())
          w.value = std::max(w.value, value.get<double>());
    fs::remove_all(folder);
  }
  const std::string runs =
      fmt::format("of {} cells whose bases were believed up to 5 mm and 0.5 degrees wrong", kRuns);
  Figures all{{"calibrate_failed", failed, "", runs + ", those that were not calibrated"}};
  for (const Worst& w : worst) all.push_back({w.key, w.value, w.unit, w.words});
  return all;
}

}  // namespace mrroc::bench
