#include "tasks/rubik/cube_record.hpp"

#include <algorithm>
#include <cmath>

namespace mrroc::rubik {

void CubeRecord::collect() {
  while (const cube_truth_t* const m = in_->next(rows_.empty() ? 0 : rows_.back().i + 1)) {
    CubeRow& row = rows_.emplace_back();
    row.i = m->header.stamp;
    for (int r = 0; r < 3; ++r) {
      for (int column = 0; column < 3; ++column) row.T_UC.R(r, column) = m->T_UC[4 * r + column];
      row.T_UC.p[r] = m->T_UC[4 * r + 3];
    }
    for (std::size_t hand = 0; hand < row.in_hand.size(); ++hand)
      row.in_hand[hand] = Eigen::Map<const Vector3>(m->in_hand[hand]);
    row.facelets.assign(std::begin(m->facelets), std::end(m->facelets));
    row.angle = std::abs(m->angle[0]) > std::abs(m->angle[1]) ? m->angle[0] : m->angle[1];
    row.squeeze = m->squeeze;
    row.on_floor = m->on_floor != 0;
  }
}

const CubeRow* CubeRecord::at(std::int64_t i) const {
  const auto after = std::ranges::upper_bound(rows_, i, {}, &CubeRow::i);
  return after == rows_.begin() ? nullptr : &*(after - 1);
}

}  // namespace mrroc::rubik
