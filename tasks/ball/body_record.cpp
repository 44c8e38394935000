#include "tasks/ball/body_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "mp/run_folder.hpp"
#include "tasks/ball/ball.hpp"

namespace mrroc::ball {

void BodyRecord::collect(std::int64_t i, int m, const Vector3& wanted, const Vector3& yielded) {
  stages_.push_back({i, m, wanted, yielded});
  while (const free_body_truth_t* const truth = in_->next(rows_.empty() ? 0 : rows_.back().i + 1)) {
    BodyRow row;
    row.i = truth->header.stamp;
    const auto stage = std::ranges::lower_bound(stages_, row.i, {}, &Stage::i);
    if (stage != stages_.end()) {
      row.m = stage->m;
      row.wanted = stage->wanted;
      row.yielded = stage->yielded;
    }
    for (int r = 0; r < 3; ++r) {
      for (int column = 0; column < 3; ++column) row.T_UO.R(r, column) = truth->T_UO[4 * r + column];
      row.T_UO.p[r] = truth->T_UO[4 * r + 3];
    }
    std::ranges::copy(truth->press, row.press.begin());
    row.on_pedestal = truth->on_pedestal != 0;
    row.on_floor = truth->on_floor != 0;
    rows_.push_back(row);
  }
}

void write_body_table(const std::filesystem::path& file, const std::vector<BodyRow>& rows) {
  std::string text = "t,m,x,y,z,ax,ay,az,wanted_x,wanted_y,wanted_z,press1,press2,on_pedestal,on_floor\n";
  for (const BodyRow& r : rows) {
    const AngleAxisPose p = angle_axis_from_pose(r.T_UO);
    const Vector3 led = r.wanted + r.yielded;
    text += fmt::format("{:.2f},{}", static_cast<double>(r.i) * kPacing.macrostep_s(), r.m);
    for (const double v : p) text += fmt::format(",{:.6f}", v);
    text += fmt::format(",{:.6f},{:.6f},{:.6f},{:.3f},{:.3f},{:d},{:d}\n", led.x(), led.y(), led.z(),
                        r.press[0], r.press[1], r.on_pedestal, r.on_floor);
  }
  mp::write_text(file, text);
}

}  // namespace mrroc::ball
