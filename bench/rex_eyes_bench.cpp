// The platform with eyes: the figure eight with cameras, and without the map for a while and for ever.
#include <nlohmann/json.hpp>

#include "bench/rex_drives.hpp"

namespace mrroc::bench {
namespace {

Figures eyes_figures(Summaries runs) {
  const Summaries seeing = seeds(runs, 0), slippery = seeds(runs, 1), ice = seeds(runs, 2);
  const Summaries lost = seeds(runs, 3), alone = seeds(runs, 4), displaced = seeds(runs, 5);
  return {
      {"track_rms_mm_eyes", most(seeing, "track_rms_mm"), "mm",
       "with cameras, worst of five seeds, wanted <= 10"},
      {"track_max_mm_eyes", most(seeing, "track_max_mm"), "mm", "  at most, wanted <= 40"},
      {"estimate_rms_mm_eyes", most(seeing, "estimate_rms_mm"), "mm", "  error of the estimate, wanted <= 8"},
      {"ellipse_95_pct_eyes", least(seeing, "ellipse_95_pct"), "%",
       "  truth within its ellipse, wanted >= 80"},
      {"odometry_valid_pct", least(seeing, "odometry_valid_pct"), "%", "  pairs with a motion, wanted >= 95"},
      {"real_time_factor_eyes", pace(seeing), "", "  wanted >= 1.2"},
      {"track_rms_mm_slippery_eyes", most(slippery, "track_rms_mm"), "mm", "ground slippery, wanted <= 15"},
      {"track_rms_mm_ice_right_eyes", most(ice, "track_rms_mm"), "mm", "ground ice_right, wanted <= 15"},
      {"map_lost_10s_mm", most(lost, "estimate_max_mm"), "mm",
       "map lost for 10 s, largest error of the estimate, wanted <= 60"},
      {"odometry_only_mm", most(alone, "estimate_max_mm"), "mm",
       "map lost from 6 s on, two laps, wanted <= 60"},
      {"return_kick_mps", most(displaced, "return_kick_mps"), "m/s",
       "change of speed when it comes back 0.2 m away, wanted <= 0.1"}};
}

}  // namespace

RexPart rex_eyes() {
  RexPart part{.drives = {}, .figures = eyes_figures};
  const Arguments lost{"--set", "motion_capture.lost=[6, 16]"};
  add_seeds(part.drives, {.eyes = true, .timed = true});
  for (const char* ground : {"slippery", "ice_right"})
    add_seeds(part.drives, {.more = {"--ground", ground}, .eyes = true});
  add_seeds(part.drives, {.more = lost, .eyes = true});
  add_seeds(part.drives, {.more = {"--set", "motion_capture.lost=[6, 1000]"}, .eyes = true});
  add_seeds(part.drives, {.more = lost + Arguments{"--set", "motion_capture.displaced=[16, 1000]", "--set",
                                                   "motion_capture.offset=[0.2, 0, 0]"},
                          .eyes = true});
  return part;
}

}  // namespace mrroc::bench
