#include "tasks/rex_drive/drive_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text_file.hpp"

namespace mrroc::rex_drive {
namespace {

double distance(const PlanarPose& a, const PlanarPose& b) { return std::hypot(a.x - b.x, a.y - b.y); }

std::string joined(std::initializer_list<double> numbers) {
  std::string text;
  for (const double n : numbers) text += fmt::format(",{:.6g}", n);
  return text;
}
template <std::size_t N>
std::string joined(const std::array<double, N>& numbers) {
  std::string text;
  for (const double n : numbers) text += fmt::format(",{:.6g}", n);
  return text;
}

}  // namespace

double tracking_error(const DriveRow& row) { return distance(row.truth.p, row.reference); }

double estimation_error(const DriveRow& row) { return distance(row.truth.p, row.estimate.p); }

bool is_pivot(const Fragment& fragment) {
  const auto turns_only = [](const PathPoint& p) { return p.v == 0; };
  return std::ranges::all_of(fragment.knot, turns_only) &&
         fragment.knot.front().p.phi != fragment.knot.back().p.phi;
}

Slip true_slip(const PlatformTruth& truth) {
  std::array<double, 2> left{}, right{};
  for (std::size_t along = 0; along < 2; ++along) {
    left[along] = (truth.friction[0][along] + truth.friction[2][along]) / 2;
    right[along] = (truth.friction[1][along] + truth.friction[3][along]) / 2;
  }
  const double sum = left[0] + right[0];
  return {sum / 2, (left[1] + right[1]) / 2, sum > 0 ? (left[0] - right[0]) / sum : 0};
}

void write_drive_table(const std::filesystem::path& file, const DriveTable& table) {
  std::string text =
      "t,x_d,y_d,phi_d,x,y,phi,vx,vy,w,x_e,y_e,phi_e,var_x,cov_xy,var_y,var_phi,mu_x,mu_y,split,sd_mu_x,sd_"
      "mu_y,sd_"
      "split,true_mu_x,true_mu_y,true_split,tau_FL,tau_FR,tau_RL,tau_RR,N_FL,N_FR,N_RL,N_RR,track_mm,"
      "estimate_mm,"
      "fragment,remaining\n";
  for (const DriveRow& r : table) {
    const Slip slip = true_slip(r.truth);
    const auto& P = r.estimate.covariance;
    text += fmt::format("{:.3f}", r.t);
    text += joined({r.reference.x, r.reference.y, r.reference.phi, r.truth.p.x, r.truth.p.y, r.truth.p.phi});
    text += joined({r.truth.v.vx, r.truth.v.vy, r.truth.v.w});
    text += joined({r.estimate.p.x, r.estimate.p.y, r.estimate.p.phi, P[0], P[1], P[4], P[8]});
    text += joined({r.slip.mu_x, r.slip.mu_y, r.slip.split, r.slip_sd.mu_x, r.slip_sd.mu_y, r.slip_sd.split});
    text += joined({slip.mu_x, slip.mu_y, slip.split});
    text += joined(r.torque) + joined(r.truth.load);
    text += fmt::format(",{:.3f},{:.3f},{},{}\n", 1e3 * tracking_error(r), 1e3 * estimation_error(r),
                        r.executing, r.remaining);
  }
  write_text_file(file, text);
}

void write_fragment_table(const std::filesystem::path& file, const FragmentTable& fragments,
                          const DriveTable& table) {
  std::string text = "number,plan,steps,notify,handed_s,begun_s,ended_s,v_end,v_end_true,ready_s\n";
  const std::vector<Stay> times = stays(fragments, table);
  for (std::size_t k = 0; k < fragments.size(); ++k) {
    const auto& [fragment, handed_in, plan] = fragments[k];
    text +=
        fmt::format("{},{},{},{},{:.2f},{:.2f},{:.2f},{:.4f},{:.4f},{:.2f}\n", fragment.number, plan,
                    fragment.steps, fragment.notify, static_cast<double>(handed_in) * kPlatformPeriod,
                    times[k].begun, times[k].ended, fragment.knot.back().v, times[k].speed, times[k].ready);
  }
  write_text_file(file, text);
}

std::vector<Stay> stays(const FragmentTable& fragments, const DriveTable& table) {
  std::vector<Stay> result(fragments.size());
  const auto stay_of = [&](std::int64_t number) -> Stay* {
    const auto found =
        std::ranges::find(fragments, number, [](const FragmentRow& f) { return f.fragment.number; });
    return found == fragments.end() ? nullptr : &result[static_cast<std::size_t>(found - fragments.begin())];
  };
  std::int64_t before = 0, ready = 0;
  for (const DriveRow& row : table) {
    for (; ready < row.notified; ++ready)
      if (Stay* const notified = stay_of(ready + 1)) notified->ready = row.t;
    if (row.executing == before) continue;
    if (Stay* const ended = stay_of(before)) {
      ended->ended = row.t;
      ended->speed = row.truth.v.vx;
    }
    if (Stay* const begun = stay_of(row.executing)) begun->begun = row.t;
    before = row.executing;
  }
  return result;
}

}  // namespace mrroc::rex_drive
