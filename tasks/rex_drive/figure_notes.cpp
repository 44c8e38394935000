#include "tasks/rex_drive/figure_notes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <optional>

#include "tasks/rex_drive/figures.hpp"

namespace mrroc::rex_drive {
namespace {

std::optional<double> value_of(const mp::Figures& figures, std::string_view key) {
  const auto found = figures.find(std::string(key));
  if (found == figures.end()) return std::nullopt;
  return std::get<double>(found->second);
}

bool is_unmeasured(const mp::Figures& figures, std::string_view key) {
  const std::optional<double> value = value_of(figures, key);
  return value && !std::isfinite(*value);
}

bool is_of_friction(std::string_view key) {
  return key == "friction_err" || key == "split_err" || key == "split_rms";
}

std::string note_of_friction(const mp::Figures& figures, const FigureContext& context) {
  if (is_unmeasured(figures, "friction_err") || is_unmeasured(figures, "split_err"))
    return "friction -: wheels that roll straight on tell little of it; a plan with curves shows it\n";
  if (context.smooth || !value_of(figures, "friction_err")) return "";
  return "friction: what is found is an effective value; only on --ground smooth is it the true one\n";
}

std::string note_of_eyes(const mp::Figures& figures, const FigureContext& context) {
  if (context.eyes.empty() || !value_of(figures, "odometry_valid_pct")) return "";
  return fmt::format("odometry: nothing is wanted of it, since {}{} was set\n", context.eyes.front(),
                     context.eyes.size() > 1 ? fmt::format(" and {} more", context.eyes.size() - 1) : "");
}

}  // namespace

std::vector<mp::FigureInfo> figures_of_run(DriveCase drive, const mp::Figures& figures,
                                           const FigureContext& context) {
  constexpr double kAny = std::numeric_limits<double>::infinity();
  std::vector<mp::FigureInfo> infos = figures_of_case(drive);
  for (mp::FigureInfo& info : infos) {
    const bool unseen = !context.eyes.empty() && info.key.starts_with("odometry_");
    const bool unmeasured = is_of_friction(info.key) && is_unmeasured(figures, info.key);
    if (!unseen && !unmeasured) continue;
    info.low = -kAny;
    info.high = kAny;
  }
  return infos;
}

std::string figure_notes(const mp::Figures& figures, const FigureContext& context) {
  return note_of_friction(figures, context) + note_of_eyes(figures, context);
}

}  // namespace mrroc::rex_drive
