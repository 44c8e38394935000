#include "tasks/rubik/plan/motions.hpp"

#include <limits>

namespace mrroc::rubik {
namespace {

constexpr double kHolding = 0.057;  // distance between the jaws at the cube [m]

std::size_t at(MotionKind kind) { return static_cast<std::size_t>(kind); }

}  // namespace

Motions::Motions(const PlanCell& cell) : cell_(cell), paths_(cell) {
  for (const Hand hand : kHands) {
    stances_[index(hand)] = find_stances(cell, hand);
    stances_[index(hand)].push_back({Place::start, cell.meeting().joints[index(hand)], {}, Vector3::Zero()});
  }
  start_at(cell.meeting().joints);
}

void Motions::start_at(const ArmJoints& joints) {
  std::erase_if(known_, [this](const auto& entry) {
    const Motion& m = entry.first;
    return m.from == start(m.hand) || m.others == start(other(m.hand));
  });
  for (const Hand hand : kHands) {
    const std::size_t h = index(hand);
    stances_[h].back().hold = joints[h];
    stances_[h].back().way = {joints[h]};
    R_UE_[h].clear();
    for (const Stance& s : stances_[h]) R_UE_[h].push_back(cell_.forward(hand, s.hold).R);
    const int count = static_cast<int>(stances_[h].size());
    for (const MotionKind kind :
         {MotionKind::carry, MotionKind::reach, MotionKind::turn, MotionKind::retreat}) {
      auto& table = straight_[at(kind)][h];
      table.clear();
      for (int from = 0; from < count; ++from)
        for (int to = 0; to < count; ++to) table.push_back(straight_seconds({kind, hand, from, to, 0}));
    }
  }
}

double Motions::straight_seconds(const Motion& m) const {
  const Stance &from = stance(m.hand, m.from), &to = stance(m.hand, m.to);
  std::vector<AxisVector> points;
  if (m.kind == MotionKind::reach) {
    points = to.way;
    points.insert(points.begin(), from.back());
  } else if (m.kind == MotionKind::retreat) {
    points = {from.hold, from.back()};
  } else {
    points = {from.hold, to.hold};
  }
  return seconds_along(points, cell_.limits(m.hand));
}

double Motions::seconds(const Motion& m) const {
  if (!known_.empty()) {
    if (const auto found = known_.find(m); found != known_.end())
      return found->second ? found->second->seconds : std::numeric_limits<double>::infinity();
  }
  return straight_[at(m.kind)][index(m.hand)][static_cast<std::size_t>(m.from) * stances(m.hand).size() +
                                              static_cast<std::size_t>(m.to)];
}

const FreeMotion* Motions::find(const Motion& m) {
  auto [place, is_new] = known_.try_emplace(m);
  if (is_new) place->second = look_for(m);
  return place->second ? &*place->second : nullptr;
}

std::optional<FreeMotion> Motions::look_for(const Motion& m) const {
  const Stance &from = stance(m.hand, m.from), &to = stance(m.hand, m.to);
  const Stance& others = stance(other(m.hand), m.others);
  const bool carries = m.kind == MotionKind::carry || m.kind == MotionKind::turn;
  CellState state;
  state.grasp = {carries ? m.hand : other(m.hand), Face::D, Face::B};
  state.joints[index(other(m.hand))] = m.kind == MotionKind::carry ? others.back() : others.hold;
  state.jaws[index(m.hand)] = carries ? kHolding : kOpenJaws;
  state.jaws[index(other(m.hand))] = m.kind == MotionKind::carry ? kOpenJaws : kHolding;
  state.touched = m.kind == MotionKind::turn || m.kind == MotionKind::retreat;

  std::vector<AxisVector> points;
  switch (m.kind) {
    case MotionKind::carry: {
      const auto way = paths_.find(m.hand, from.hold, to.hold, state);
      if (!way) return {};
      points = *way;
      break;
    }
    case MotionKind::reach: {
      const auto way = paths_.find(m.hand, from.back(), to.back(), state);
      if (!way) return {};
      points = *way;
      for (std::size_t k = 1; k < to.way.size(); ++k) {
        if (!paths_.is_free(m.hand, points.back(), to.way[k], state)) return {};
        points.push_back(to.way[k]);
      }
      state.touched = true;
      if (!paths_.is_free(m.hand, points.back(), to.hold, state)) return {};
      break;
    }
    case MotionKind::turn:
      points = {from.hold, to.hold};
      if (!paths_.is_free(m.hand, from.hold, to.hold, state)) return {};
      break;
    case MotionKind::retreat:
      points = {from.hold};
      for (auto p = from.way.rbegin(); p != from.way.rend(); ++p) {
        if (!paths_.is_free(m.hand, points.back(), *p, state)) return {};
        points.push_back(*p);
        state.touched = false;
      }
      break;
  }
  const double seconds = seconds_along(points, cell_.limits(m.hand));
  return FreeMotion{m.hand, std::move(points), carries, seconds};
}

Grasp Motions::seen_from(Hand hand, int stance, const Grasp& grasp, int others) const {
  const Matrix3& R_UE = R_UE_[index(hand)][static_cast<std::size_t>(stance)];
  const Matrix3& R_UO = R_UE_[index(grasp.hand)][static_cast<std::size_t>(others)];
  return grasp_from(hand, R_UE.transpose() * R_UO * cube_in_hand(grasp).R);
}

}  // namespace mrroc::rubik
