#include "tasks/haptic/record.hpp"

#include <fmt/core.h>

#include <string>

#include "base/latency.hpp"
#include "base/text_file.hpp"

namespace mrroc::haptic {

void note(HapticRecord& record, int m, const Coordinator::X& x) {
  if (m != kCoupled) return;
  const Sides now = sides(x);
  const Coupling& c = x.c.coupling;
  const double dt = x.c.k.law.macrostep;
  const Report& master = x.T.agent[kMaster];
  record.push_back({.t = static_cast<double>(x.i - latency::kMotionToReport) * dt,
                    .x_m = now.x_m,
                    .x_s = now.x_s,
                    .F_m = -(pose_of(master).R * master.F_a.linear()),
                    .F_s = now.F_s,
                    .E_m = c.master.observed(),
                    .E_s = c.slave.observed(),
                    .kept = c.master.kept_back + c.slave.kept_back,
                    .age = static_cast<double>(c.age) * dt});
}

void write_record(const std::filesystem::path& file, const HapticRecord& record) {
  std::string text = "t,xm,ym,zm,xs,ys,zs,Fxm,Fym,Fzm,Fxs,Fys,Fzs,Em,Es,kept,age\n";
  const auto add = [&](const Vector3& v, double unit) {
    for (const double number : v) text += fmt::format(",{:.4f}", unit * number);
  };
  for (const HapticRow& row : record) {
    text += fmt::format("{:.4f}", row.t);
    add(row.x_m, 1e3);
    add(row.x_s, 1e3);
    add(row.F_m, 1);
    add(row.F_s, 1);
    text += fmt::format(",{:.4f},{:.4f},{:.4f},{:.1f}\n", 1e3 * row.E_m, 1e3 * row.E_s, 1e3 * row.kept,
                        1e3 * row.age);
  }
  write_text_file(file, text);
}

}  // namespace mrroc::haptic
