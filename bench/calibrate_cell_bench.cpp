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
  set("sim.artefact.place_error=" + displacement(cell, 0.02, 0.005));
  set(fmt::format("sim.sensor.force_noise={:.4f}", cell.between(0.02, 0.15)));
  set(fmt::format("sim.paper.friction={:.3f}", cell.between(0.05, 0.3)));
  set(fmt::format("sim.paper.stiffness={:.1f}", std::exp(cell.between(std::log(5000), std::log(40000)))));
  return a;
}

}  // namespace

Figures run_calibrate_cell_group() {
  const ScratchFolder scratch;
  double failed = 0, mm = 0, deg = 0, before = 0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    const fs::path folder = scratch.path() / "run";
    TaskProcess task("calibrate_cell", arguments(folder, seed));
    failed += task.wait() != 0;
    const nlohmann::json summary = run_summary(folder);
    if (!summary.is_null() && summary.at("figures").contains("base_err_mm")) {
      const nlohmann::json& figures = summary.at("figures");
      const auto take = [&](double& worst, const char* key) {
        if (figures.at(key).is_number()) worst = std::max(worst, figures.at(key).get<double>());
      };
      take(mm, "base_err_mm");
      take(deg, "base_err_deg");
      take(before, "base_before_mm");
    }
    fs::remove_all(folder);
  }
  const std::string runs =
      fmt::format("of {} cells whose bases were believed up to 5 mm and 0.5 degrees wrong", kRuns);
  return {{"calibrate_failed", failed, "", runs + ", those that were not calibrated"},
          {"base_err_mm", mm, "mm", "base of arm2 from that of arm1 afterwards, off the truth, worst"},
          {"base_err_deg", deg, "deg", "its direction, worst"},
          {"base_before_mm", before, "mm", "the same before, worst"}};
}

}  // namespace mrroc::bench
