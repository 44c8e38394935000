#include "tasks/box_push/push_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "base/link/take_all.hpp"
#include "base/planar.hpp"
#include "mp/run_folder.hpp"
#include "tasks/box_push/keys.hpp"

namespace mrroc::box_push {
namespace {

/// @return force and moment on the box along its own axes
std::array<double, 3> push_in_box(const BoxTruth& box) {
  const double c = std::cos(box.p.phi), s = std::sin(box.p.phi);
  return {c * box.push[0] + s * box.push[1], c * box.push[1] - s * box.push[0], box.push[2]};
}

/// Turns of the box from its goal [rad]: without jumps by a whole turn, within half a one at the end.
std::vector<double> turns_of(const PushTable& table, const PlanarPose& goal) {
  std::vector<double> turned(table.size());
  double after = 0;
  for (std::size_t n = table.size(); n > 0; --n)
    after = turned[n - 1] = after + wrap_angle(table[n - 1].box.p.phi - goal.phi - after);
  return turned;
}

std::string line_of(const PushRow& row, const PlanarPose& goal, double turned, double macrostep) {
  const PlanarPose e = seen_from(goal, row.box.p);
  const auto push = push_in_box(row.box);
  const PlanarPose& b = row.box.p;
  std::string line = fmt::format("{:.2f},{},{}", static_cast<double>(row.stage.macrostep) * macrostep,
                                 row.stage.m, row.stage.push);
  line +=
      fmt::format(",{:.5f},{:.5f},{:.5f},{:.2f},{:.2f},{:.2f}", b.x, b.y, b.phi, push[0], push[1], push[2]);
  line += fmt::format(",{:.2f},{:.3f}", 1e3 * std::hypot(e.x, e.y), turned * 180 / std::numbers::pi);
  for (std::size_t k = 0; k < kPlatforms; ++k) {
    const PlanarPose& p = row.platform[k];
    line += fmt::format(",{:.5f},{:.5f},{:.5f},{:.3f}", p.x, p.y, p.phi, row.torque[k]);
  }
  return line + "\n";
}

/// @return the message of that macrostep; null: it has not come
template <class M>
const M* of_macrostep(const std::vector<M>& messages, std::int64_t macrostep) {
  const auto found =
      std::ranges::lower_bound(messages, macrostep, {}, [](const M& m) { return m.header.stamp; });
  return found != messages.end() && found->header.stamp == macrostep ? &*found : nullptr;
}

}  // namespace

void write_push_table(const std::filesystem::path& file, const PushTable& table, const PlanarPose& goal,
                      double macrostep) {
  std::string text =
      "t,m,push,box_x,box_y,box_phi,push_x,push_y,push_moment,error_mm,error_deg,x1,y1,phi1,torque1,x2,y2,"
      "phi2,torque2\n";
  const std::vector<double> turned = turns_of(table, goal);
  for (std::size_t n = 0; n < table.size(); ++n) text += line_of(table[n], goal, turned[n], macrostep);
  mp::write_text(file, text);
}

PushRecord::PushRecord(link::Process& process)
    : box_in_(process.inbox<box_truth_t>(std::string(kBox) + ".truth")) {
  for (std::size_t k = 0; k < kPlatforms; ++k)
    truth_in_[k] = process.inbox<platform_truth_t>(std::string(kKeys[k]) + ".truth");
}

void PushRecord::collect(const PushStage& stage) {
  link::take_all(*box_in_, boxes_);
  for (std::size_t k = 0; k < kPlatforms; ++k) link::take_all(*truth_in_[k], truths_[k]);
  stages_.push_back(stage);
}

PushTable PushRecord::table(std::int64_t last) const {
  PushTable table;
  for (const PushStage& stage : stages_) {
    const box_truth_t* const box = of_macrostep(boxes_, stage.macrostep);
    if (!box || stage.macrostep > last) continue;
    PushRow row{.stage = stage, .box = from_message(*box)};
    bool complete = true;
    for (std::size_t k = 0; k < kPlatforms; ++k) {
      const platform_truth_t* const m = of_macrostep(truths_[k], stage.macrostep);
      complete = complete && m;
      if (!m) break;
      const PlatformTruth truth = from_message(*m);
      row.platform[k] = truth.p;
      row.torque[k] = std::accumulate(truth.torque.begin(), truth.torque.end(), 0.0);
    }
    if (complete) table.push_back(row);
  }
  return table;
}

}  // namespace mrroc::box_push
