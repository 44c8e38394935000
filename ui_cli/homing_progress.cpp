#include "ui_cli/homing_progress.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace mrroc::ui {
namespace {

constexpr double kMoved = 1;  // of a motor [rad]: more than one that only holds its axis

}  // namespace

std::vector<ManualArm> arms_to_home(const std::string& instruction, std::vector<ManualArm> arms) {
  std::string verb, whom;
  std::istringstream(instruction) >> verb >> whom;
  if (verb != "home") return {};
  std::erase_if(arms, [&](const ManualArm& a) { return whom != "all" && whom != a.name; });
  return arms;
}

HomingProgress::HomingProgress(const std::vector<ManualArm>& arms) {
  for (const ManualArm& a : arms) followed_.push_back({.arm = a.name, .axes = a.axes});
}

void HomingProgress::see(const std::string& arm, const EffectorReply& reading) {
  const auto f = std::ranges::find(followed_, arm, &Followed::arm);
  if (f == followed_.end()) return;
  if (reading.state != DriverState::homing) {
    *f = {.arm = f->arm, .axes = f->axes};
    return;
  }
  if (!f->begun) f->begun = reading.motors;
  for (std::size_t k = 0; k < f->moved.size(); ++k)
    f->moved[k] = f->moved[k] || std::abs(reading.motors[k] - (*f->begun)[k]) > kMoved;
}

std::string HomingProgress::text() const {
  std::string text;
  for (const Followed& f : followed_) {
    if (!f.begun) continue;
    const auto at = std::clamp(static_cast<int>(std::ranges::count(f.moved, true)), 1, std::max(1, f.axes));
    text += fmt::format("{}{} axis {} of {}", text.empty() ? "" : ", ", f.arm, at, f.axes);
  }
  return text;
}

}  // namespace mrroc::ui
