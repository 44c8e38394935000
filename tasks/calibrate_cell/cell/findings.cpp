#include "tasks/calibrate_cell/cell/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/vocabulary.hpp"

namespace mrroc::calibrate_cell {
namespace {

/// Errors of cameras of one kind, the worst of each.
PoseDistance worst_place(const ByBoard& found, const Config& config, bool in_hand) {
  PoseDistance worst{NAN, NAN};
  for (const CameraFound& c : found.cameras) {
    if ((c.camera.mount == CameraMount::robot) != in_hand) continue;
    const PoseDistance d = distance(c.place, true_camera(config, c.camera.key));
    worst.mm = std::fmax(worst.mm, d.mm);
    worst.deg = std::fmax(worst.deg, d.deg);
  }
  return worst;
}

mp::TaskFigures picture_figures(const Findings& f, const Config& config) {
  PoseDistance base{NAN, NAN}, hand{NAN, NAN}, fixed{NAN, NAN};
  double stills = 0, seen = 0;
  if (f.by_pictures()) base = distance(*f.by_pictures(), relation(true_bases(config)));
  if (f.pictured) {
    hand = worst_place(*f.pictured, config, true);
    fixed = worst_place(*f.pictured, config, false);
    for (const CameraFound& c : f.pictured->cameras) {
      stills += static_cast<double>(c.stills);
      seen += static_cast<double>(c.seen);
    }
  }
  return {{{.key = "camera_base_err_mm",
            .words = "base of arm2 by pictures, off the truth",
            .unit = "mm",
            .high = 0.5},
           base.mm},
          {{.key = "camera_base_err_deg", .words = "  its direction", .unit = "deg", .high = 0.05}, base.deg},
          {{"camera_place_err_mm", "camera in the hand, off the truth", "mm"}, hand.mm},
          {{"camera_place_err_deg", "  its direction", "deg"}, hand.deg},
          {{"fixed_camera_err_mm", "cameras that stand alone, off the truth, the worst", "mm"}, fixed.mm},
          {{"fixed_camera_err_deg", "  their direction", "deg"}, fixed.deg},
          {{"pictures", "pictures of the board that were wanted", ""}, stills},
          {{"pictures_unseen", "  that did not show it", ""}, stills - seen}};
}

mp::TaskFigures difference_figures(const Findings& f) {
  const PoseDistance d = f.difference().value_or(PoseDistance{NAN, NAN});
  return {{{.key = "way_difference_mm",
            .words = "base of arm2 by pictures from that by touching",
            .unit = "mm",
            .high = kWaysAgree.mm},
           d.mm},
          {{.key = "way_difference_deg", .words = "  its direction", .unit = "deg", .high = kWaysAgree.deg},
           d.deg}};
}

}  // namespace

std::optional<Pose> Findings::by_touch() const {
  if (!touched) return {};
  const auto& found = touched->fits[touched->chosen].found;
  return found ? std::optional(found->T_12.T_AB) : std::nullopt;
}

std::optional<Pose> Findings::by_pictures() const { return pictured ? pictured->T_12 : std::nullopt; }

std::optional<PoseDistance> Findings::difference() const {
  if (!by_touch() || !by_pictures()) return {};
  return distance(*by_touch(), *by_pictures());
}

Findings find_all(const std::vector<mp::ArmTrace>& traces, const std::vector<CameraRecord>& records,
                  const Config& config) {
  Findings f;
  const Ways ways = read_ways(config);
  if (ways.touch) f.touched = fit_sets(traces, config);
  if (!ways.board || records.empty()) return f;
  const SetNumbers sets = f.touched ? f.touched->fits[f.touched->chosen].sets : believed_sets(config);
  try {
    f.pictured =
        find_by_board(read_sight(config), stills_of(measured_with(traces, sets, config), views_of(config)),
                      records, f.by_touch(), believed_bases(config));
  } catch (const FaultError& e) {
    f.unseen = e;
  }
  return f;
}

mp::TaskFigures figures_of(const Findings& f, const std::vector<mp::ArmTrace>& traces, const Config& config) {
  const Ways ways = read_ways(config);
  mp::TaskFigures all = figures(traces, f.T_12(), believed_bases(config), true_bases(config));
  const auto add = [&](mp::TaskFigures more) { all.insert(all.end(), more.begin(), more.end()); };
  const bool pictures = ways.board && !camera_keys(config).empty();
  if (pictures) add(picture_figures(f, config));
  if (pictures && ways.touch) add(difference_figures(f));
  if (!f.touched) return all;
  add(touch_figures(f.touched->fits[f.touched->chosen].found));
  add_figures(all, *f.touched, true_sets(config));
  return all;
}

std::string describe_ways(const Findings& f) {
  const auto d = f.difference();
  if (!d) return fmt::format("the bases were found by {} alone\n", f.by_touch() ? "touching" : "pictures");
  std::string text = fmt::format(
      "the bases are those found by touching; by pictures arm2 stands {:.2f} mm and {:.3f} degrees from "
      "there\n",
      d->mm, d->deg);
  if (d->mm <= kWaysAgree.mm && d->deg <= kWaysAgree.deg) return text;
  return text +
         fmt::format(
             "BOTH WAYS DISAGREE, by more than {} mm or {} degrees: look for what is believed wrong of the "
             "tips (task.tip_radius, robots.ARM.tool.pose) or of the arms' lengths\n",
             kWaysAgree.mm, kWaysAgree.deg);
}

CellResult result_of(const Findings& f, const std::vector<mp::ArmTrace>& traces, const Config& config) {
  if (f.touched && !f.by_touch())
    throw FaultError(kTouchesDoNotFit, "the balls leave open how the bases stand");
  if (f.unseen) throw *f.unseen;
  CellResult r{.bases = believed_bases(config),
               .tools = {tool_of(traces[0]), tool_of(traces[1])},
               .sets = {},
               .cameras = {},
               .ways = describe_ways(f)};
  if (f.T_12()) r.bases = corrected(r.bases, *f.T_12());
  if (f.touched && f.touched->told_apart) r.sets = f.touched->fits[f.touched->chosen].names;
  if (f.pictured)
    for (const CameraFound& c : f.pictured->cameras) r.cameras.push_back({c.camera.key, c.place});
  return r;
}

}  // namespace mrroc::calibrate_cell
