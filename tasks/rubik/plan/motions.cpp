#include "tasks/rubik/plan/motions.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace mrroc::rubik {
namespace {

constexpr double kDelayStep = 0.25;  // of the delays that are tried, as a share of the first motion
constexpr double kLatest = 0.8;      // of them that pays

constexpr std::array kKinds{MotionKind::carry, MotionKind::reach, MotionKind::turn, MotionKind::retreat};

/// @return turns of the last joint from one posture to the other
double turns_between(const ArmConfiguration& a, const ArmConfiguration& b) {
  const Eigen::Index last = a.hold.size() - 1;
  return (b.hold[last] - a.hold[last]) / (2 * std::numbers::pi);
}
bool is_whole(double turns) { return std::abs(turns - std::round(turns)) < 1e-3; }

std::size_t at(MotionKind kind) { return static_cast<std::size_t>(kind); }

}  // namespace

Motions::Motions(const PlanCell& cell) : cell_(cell), paths_(cell) {
  for (const Hand hand : kHands) {
    configurations_[index(hand)] = find_configurations(cell, hand);
    configurations_[index(hand)].push_back(
        {Place::start, cell.meeting().joints[index(hand)], {}, Vector3::Zero()});
  }
  start_at(cell.meeting().joints);
}

void Motions::start_at(const ArmJoints& joints) {
  std::erase_if(known_, [this](const auto& entry) {
    const ArmTransfer& m = entry.first;
    return m.from == start(m.hand) || m.others == start(other(m.hand));
  });
  std::erase_if(delays_, [this](const auto& entry) {
    const auto& [carry, reach] = entry.first;
    return carry.from == start(carry.hand) || reach.from == start(reach.hand);
  });
  for (const Hand hand : kHands) {
    ArmConfiguration& s = configurations_[index(hand)].back();
    s.hold = joints[index(hand)];
    s.path = {s.hold};
    sort_into_classes(hand);
    R_UE_[index(hand)].clear();
    for (const auto& members : classes(hand))
      R_UE_[index(hand)].push_back(cell_.forward(hand, configuration(hand, members.front()).hold).R);
  }
  for (const MotionKind kind : kKinds)
    for (const Hand hand : kHands) {
      Table& table = tables_[at(kind)][index(hand)];
      table = {};
      for (int from = 0; from <= start(hand); ++from)
        for (int to = 0; to <= start(hand); ++to) table.lines.push_back(line_seconds(kind, hand, from, to));
      const int count = static_cast<int>(classes(hand).size());
      const int others = static_cast<int>(classes(other(hand)).size());
      for (int from = 0; from < count; ++from)
        for (int to = 0; to < count; ++to)
          for (int k = 0; k < others; ++k)
            table.classes.push_back(least_of_members({kind, hand, from, to, k}));
    }
}

void Motions::sort_into_classes(Hand hand) {
  const auto& configurations = configurations_[index(hand)];
  auto& classes = classes_[index(hand)];
  auto& class_of = class_of_[index(hand)];
  classes.clear();
  class_of.clear();
  for (int k = 0; k < static_cast<int>(configurations.size()); ++k) {
    const ArmConfiguration& s = configurations[static_cast<std::size_t>(k)];
    int found = 0;
    for (; found < static_cast<int>(classes.size()); ++found) {
      const ArmConfiguration& example = this->example(hand, found);
      const bool fixed = s.place == Place::start || s.place == Place::shown;
      if (!fixed && example.place == s.place && is_whole(turns_between(example, s))) break;
    }
    if (found == static_cast<int>(classes.size())) classes.emplace_back();
    classes[static_cast<std::size_t>(found)].push_back(k);
    class_of.push_back(found);
  }
}

std::optional<int> Motions::turned_class(int of_class, int quarters) const {
  const ArmConfiguration& from = example(Hand::track, of_class);
  const int count = static_cast<int>(classes(Hand::track).size());
  for (int k = 0; k < count; ++k) {
    const ArmConfiguration& to = example(Hand::track, k);
    if (from.place == Place::front && to.place == Place::front &&
        is_whole(turns_between(from, to) - quarters / 4.0))
      return k;
  }
  return {};
}

double Motions::line_seconds(MotionKind kind, Hand hand, int number, int target) const {
  const ArmConfiguration &from = configuration(hand, number), &to = configuration(hand, target);
  std::vector<AxisVector> points;
  if (kind == MotionKind::reach) {
    points = to.path;
    points.insert(points.begin(), from.back());
  } else if (kind == MotionKind::retreat) {
    points = {from.hold, from.back()};
  } else {
    points = {from.hold, to.hold};
  }
  return seconds_along(cell_, hand, points);
}

double Motions::seconds(const ArmTransfer& m) const {
  if (const auto found = known_.find(m); found != known_.end())
    return found->second ? found->second->seconds : std::numeric_limits<double>::infinity();
  return tables_[at(m.kind)][index(m.hand)]
      .lines[static_cast<std::size_t>(m.from * (start(m.hand) + 1) + m.to)];
}

std::size_t Motions::slot(const ArmTransfer& m) const {
  const auto count = classes(m.hand).size(), others = classes(other(m.hand)).size();
  const auto row = static_cast<std::size_t>(m.from) * count + static_cast<std::size_t>(m.to);
  return row * others + static_cast<std::size_t>(m.others);
}

double Motions::class_seconds(const ArmTransfer& motion) const {
  return tables_[at(motion.kind)][index(motion.hand)].classes[slot(motion)];
}

double Motions::least_of_members(const ArmTransfer& m) const {
  double least = std::numeric_limits<double>::infinity();
  for (const int from : classes(m.hand)[static_cast<std::size_t>(m.from)])
    for (const int to : classes(m.hand)[static_cast<std::size_t>(m.to)])
      for (const int others : classes(other(m.hand))[static_cast<std::size_t>(m.others)])
        least = std::min(least, seconds({m.kind, m.hand, from, to, others}));
  return least;
}

double Motions::straight_seconds(MotionKind kind, Hand hand, int from, int to) const {
  double least = std::numeric_limits<double>::infinity();
  for (const int a : classes(hand)[static_cast<std::size_t>(from)])
    for (const int b : classes(hand)[static_cast<std::size_t>(to)])
      least = std::min(
          least, tables_[at(kind)][index(hand)].lines[static_cast<std::size_t>(a * (start(hand) + 1) + b)]);
  return least;
}

ArmTransfer Motions::classified(const ArmTransfer& m) const {
  const auto& own = class_of_[index(m.hand)];
  const auto& others = class_of_[index(other(m.hand))];
  return {m.kind, m.hand, own[static_cast<std::size_t>(m.from)], own[static_cast<std::size_t>(m.to)],
          others[static_cast<std::size_t>(m.others)]};
}

const FreeMotion* Motions::find(const ArmTransfer& m) {
  auto [place, is_new] = known_.try_emplace(m);
  if (is_new) {
    place->second = look_for(m);
    const ArmTransfer of_classes = classified(m);
    tables_[at(m.kind)][index(m.hand)].classes[slot(of_classes)] = least_of_members(of_classes);
  }
  return place->second ? &*place->second : nullptr;
}

std::optional<FreeMotion> Motions::look_for(const ArmTransfer& m) const {
  const ArmConfiguration &from = configuration(m.hand, m.from), &to = configuration(m.hand, m.to);
  const ArmConfiguration& others = configuration(other(m.hand), m.others);
  const bool carries = m.kind == MotionKind::carry || m.kind == MotionKind::turn;
  CellState state;
  state.grasp = {carries ? m.hand : other(m.hand), Face::D, Face::B};
  state.joints[index(other(m.hand))] = m.kind == MotionKind::carry ? others.back() : others.hold;
  state.jaws[index(m.hand)] = carries ? kEdge : kOpenJaws;
  state.jaws[index(other(m.hand))] = m.kind == MotionKind::carry ? kOpenJaws : kEdge;
  state.touched = m.kind == MotionKind::turn || m.kind == MotionKind::retreat;

  std::vector<AxisVector> points;
  switch (m.kind) {
    case MotionKind::carry: {
      const auto path = paths_.find(m.hand, from.hold, to.hold, state);
      if (!path) return {};
      points = *path;
      if (to.place != Place::shown) break;
      state.joints[index(m.hand)] = to.hold;
      state.looked_at = true;
      if (!cell_.is_free(state)) return {};
      break;
    }
    case MotionKind::reach: {
      const auto path = paths_.find(m.hand, from.back(), to.back(), state);
      if (!path) return {};
      points = *path;
      for (std::size_t k = 1; k < to.path.size(); ++k) {
        if (!paths_.is_free(m.hand, points.back(), to.path[k], state)) return {};
        points.push_back(to.path[k]);
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
      for (std::size_t k = from.path.size(); k-- > 0;) {
        if (!paths_.is_free(m.hand, points.back(), from.path[k], state)) return {};
        points.push_back(from.path[k]);
        state.touched = false;
      }
      break;
  }
  FreeMotion motion{.hand = m.hand, .points = path_through(cell_, m.hand, points), .carries = carries};
  motion.seconds = seconds_along(motion.points, cell_.limits(m.hand).motors);
  return motion;
}

std::optional<double> Motions::look_for_delay(const FreeMotion& carry, const FreeMotion& reach) const {
  CellState state;
  state.grasp = {carry.hand, Face::D, Face::B};
  state.jaws[index(carry.hand)] = kEdge;
  state.jaws[index(reach.hand)] = kOpenJaws;
  // The hand that comes is where its approach begins when the cube has been there for a while.
  const double least = std::max(0.0, carry.seconds + kLag - reach.seconds);
  for (double share = 0; share < kLatest; share += kDelayStep) {
    const double delay = std::max(least, share * carry.seconds);
    if (delay < kLatest * carry.seconds && paths_.are_free(carry, reach, delay, state)) return delay;
  }
  return {};
}

std::optional<double> Motions::delay(const ArmTransfer& carry, const ArmTransfer& reach) {
  const FreeMotion *first = find(carry), *second = find(reach);
  if (!first || !second) return {};
  const auto [place, is_new] = delays_.try_emplace({carry, reach});
  if (is_new) place->second = look_for_delay(*first, *second);
  return place->second;
}

Grasp Motions::seen_from(Hand hand, int of_class, const Grasp& grasp, int others) const {
  const Matrix3& R_UE = R_UE_[index(hand)][static_cast<std::size_t>(of_class)];
  const Matrix3& R_UO = R_UE_[index(grasp.hand)][static_cast<std::size_t>(others)];
  return grasp_from(hand, R_UE.transpose() * R_UO * cube_in_hand(grasp).R);
}

}  // namespace mrroc::rubik
