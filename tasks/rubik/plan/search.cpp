#include "tasks/rubik/plan/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <queue>
#include <unordered_map>
#include <utility>

namespace mrroc::rubik {
namespace {

using std::numbers::pi;

constexpr int kPerGroup = 4;
constexpr double kNever = 1e6;  // [s]
constexpr int kAllFaces = (1 << kFaces) - 1;

std::uint64_t key(const Node& n) {
  const auto u = [](int x) { return static_cast<std::uint64_t>(x); };
  return u(static_cast<int>(n.grasp.hand)) | u(number(n.grasp.palm)) << 1 | u(number(n.grasp.jaw)) << 4 |
         u(n.configurations[0]) << 8 | u(n.configurations[1]) << 16 | u(n.done) << 24;
}

struct Record {
  double cost{};
  bool closed{};
  Node node, before;
  Edge edge;
};

struct Open {
  double estimate{};
  std::uint64_t number{};  // of two with one estimate the newer one comes first: it is farther
  std::uint64_t key{};
  bool operator<(const Open& o) const {
    return estimate > o.estimate || (estimate == o.estimate && number < o.number);
  }
};

}  // namespace

bool GraspSearch::is_done(const Node& node) const {
  return goal_.show_all ? node.done == kAllFaces
                        : node.done == kPerGroup * static_cast<int>(goal_.groups.size());
}

double GraspSearch::least(MotionKind kind, Hand hand, std::optional<Place> from, Place to) const {
  const int count = static_cast<int>(motions_.classes(hand).size());
  double least = kNever;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b)
      if ((!from || motions_.example(hand, a).place == *from) && motions_.example(hand, b).place == to)
        least = std::min(least, motions_.straight_seconds(kind, hand, a, b));
  return least;
}

GraspSearch::GraspSearch(const Motions& motions, const PlanOptions& options, PlanGoal goal)
    : motions_(motions), options_(options), goal_(std::move(goal)) {
  const CycleTimes& times = options_.times;
  double retreat = kNever, visit = kNever;
  for (const Hand hand : kHands) {
    for (int k = 0; k < motions_.start_class(hand); ++k)
      if (motions_.example(hand, k).place != Place::shown)
        retreat = std::min(retreat, motions_.straight_seconds(MotionKind::retreat, hand, k, k));
    // While hands meet in front only, their palms stay on the same pair of opposite faces. So one of them has to grip
    // from the side, and to come back to the front, with the cube or without.
    visit = std::min(visit, least(MotionKind::reach, hand, Place::front, Place::side) +
                                std::min(least(MotionKind::carry, hand, Place::side, Place::front),
                                         least(MotionKind::reach, hand, Place::side, Place::front)));
  }
  grip_ = times.grip + times.open + options_.grip_penalty + retreat;
  // Both palms change, and one of them comes to the front.
  new_face_ = 2 * grip_ + visit +
              std::min(least(MotionKind::reach, Hand::postument, {}, Place::front),
                       least(MotionKind::reach, Hand::track, {}, Place::front));
  rest_.assign(goal_.groups.size() + 1, 0);
  for (std::size_t g = goal_.groups.size(); g-- > 0;) {
    const auto& moves = goal_.groups[g].moves;
    rest_[g] = rest_[g + 1] + (g + 1 < goal_.groups.size() ? new_face_ : 0);
    for (const Move m : moves) rest_[g] += turning(m);
    // The palm that is to come where the other one was has to wait for it to go: three grips at least.
    if (moves.size() == 2) rest_[g] += new_face_ + grip_;
  }
}

double GraspSearch::turning(Move m) const {
  return (m.quarters() == 2 ? pi : pi / 2) / options_.times.turn_rate;
}

double GraspSearch::turning(const Edge& edge) const {
  return std::abs(edge.quarters) * pi / 2 / options_.times.turn_rate;
}

double GraspSearch::least_rest(const Node& node) const {
  if (goal_.show_all) return (kFaces - std::popcount(static_cast<unsigned>(node.done))) * options_.times.look;
  const auto g = static_cast<std::size_t>(node.done / kPerGroup);
  if (g >= goal_.groups.size()) return 0;
  double rest = grip_ + rest_[g];
  const auto& moves = goal_.groups[g].moves;
  for (std::size_t k = 0; k < moves.size(); ++k)
    if (node.done % kPerGroup & (1 << k)) rest -= turning(moves[k]);
  // One of two opposite faces has been turned: what lies between them may have been paid.
  if (node.done % kPerGroup != 0) rest -= new_face_ + grip_;
  return rest;
}

std::vector<int> GraspSearch::holder_configurations(const Node& node, Place place) const {
  const Hand holder = node.grasp.hand;
  const int now = node.configurations[index(holder)];
  if (motions_.example(holder, now).place == place) return {now};
  std::vector<int> found;
  const int count = static_cast<int>(motions_.classes(holder).size());
  for (int k = 0; k < count; ++k)
    if (motions_.example(holder, k).place == place) found.push_back(k);
  return found;
}

std::vector<ArmTransfer> motions_of(Hand holder, const Edge& e, const StepConfigurations& s) {
  const Hand h = holder, w = other(h);
  std::vector<ArmTransfer> all{
      {MotionKind::carry, h, s.before[index(h)], s.meeting[index(h)], s.before[index(w)]}};
  if (e.shows) return all;
  all.push_back({MotionKind::reach, w, s.before[index(w)], s.meeting[index(w)], s.meeting[index(h)]});
  const std::size_t T = index(Hand::track), P = index(Hand::postument);
  if (e.turn) all.push_back({MotionKind::turn, Hand::track, s.meeting[T], s.after[T], s.meeting[P]});
  const Hand leaves = e.comer_leaves ? w : h;
  const int from = s.after[index(leaves)];
  all.push_back({MotionKind::retreat, leaves, from, from, s.after[index(other(leaves))]});
  return all;
}

void GraspSearch::add(std::vector<Edge>& edges, const Node& node, Edge edge) const {
  const CycleTimes& times = options_.times;
  const Hand h = node.grasp.hand;
  StepConfigurations configurations{node.configurations, {}, edge.to.configurations};
  configurations.meeting[index(h)] = edge.holder;
  configurations.meeting[index(other(h))] = edge.shows ? node.configurations[index(other(h))] : edge.comer;
  edge.cost = edge.shows ? times.look : times.grip + times.open + options_.grip_penalty;
  for (const ArmTransfer& m : motions_of(h, edge, configurations)) {
    const double seconds = motions_.class_seconds(m);
    edge.cost += m.kind == MotionKind::turn && std::isfinite(seconds) ? turning(edge) : seconds;
  }
  if (std::isfinite(edge.cost)) edges.push_back(edge);
}

void GraspSearch::add_turns(std::vector<Edge>& edges, const Node& node, const Edge& meeting,
                            const Grasp& comer) const {
  const std::size_t g = static_cast<std::size_t>(node.done / kPerGroup);
  if (goal_.show_all || g >= goal_.groups.size()) return;
  const Hand w = comer.hand;
  const Grasp keeps = w == Hand::postument ? comer : node.grasp;
  const Grasp turns = w == Hand::postument ? node.grasp : comer;
  const auto& moves = goal_.groups[g].moves;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const int done = node.done | (1 << k);
    if (done == node.done || moves[k].face() != keeps.palm) continue;
    const auto [quarters, either_direction] = direction_of(moves[k], options_.blocked);
    const auto to = motions_.turned_class(w == Hand::track ? meeting.comer : meeting.holder, quarters);
    if (!to) continue;
    for (const bool comer_leaves : {false, true}) {
      Edge e = meeting;
      e.turn = moves[k];
      e.quarters = quarters;
      e.either_direction = either_direction;
      e.comer_leaves = comer_leaves;
      e.to.configurations[index(Hand::track)] = *to;
      const bool postument_stays = (w == Hand::postument) != comer_leaves;
      e.to.grasp = postument_stays ? turned(keeps, quarters) : turns;
      const int all = (1 << moves.size()) - 1;
      e.to.done = (done % kPerGroup) == all ? kPerGroup * static_cast<int>(g + 1) : done;
      add(edges, node, e);
    }
  }
}

void GraspSearch::add_meetings(std::vector<Edge>& edges, const Node& node, int holder, Place comes) const {
  const Hand h = node.grasp.hand, w = other(h);
  const int count = static_cast<int>(motions_.classes(w).size());
  for (int k = 0; k < count; ++k) {
    if (motions_.example(w, k).place != comes) continue;
    Edge e;
    e.holder = holder;
    e.comer = k;
    e.to = node;
    e.to.configurations[index(h)] = holder;
    e.to.configurations[index(w)] = k;
    const Grasp comer = motions_.seen_from(w, k, node.grasp, holder);
    if (comes == Place::front) add_turns(edges, node, e, comer);
    e.to.grasp = comer;
    add(edges, node, e);
  }
}

void GraspSearch::add_looks(std::vector<Edge>& edges, const Node& node) const {
  const Hand h = node.grasp.hand;
  const Matrix3 R_CE = cube_in_hand(node.grasp).R.transpose();
  const int count = static_cast<int>(motions_.classes(h).size());
  for (int k = 0; k < count; ++k) {
    const ArmConfiguration& s = motions_.example(h, k);
    if (s.place != Place::shown) continue;
    const Face face = face_along(R_CE * s.shown);
    if (node.done & (1 << number(face))) continue;
    Edge e;
    e.holder = k;
    e.shows = face;
    e.to = node;
    e.to.configurations[index(h)] = k;
    e.to.done |= 1 << number(face);
    add(edges, node, e);
  }
}

std::vector<Edge> GraspSearch::edges(const Node& node) const {
  std::vector<Edge> edges;
  for (const int holder : holder_configurations(node, Place::front))
    add_meetings(edges, node, holder, Place::front);
  for (const int holder : holder_configurations(node, Place::offered))
    add_meetings(edges, node, holder, Place::side);
  if (goal_.show_all) add_looks(edges, node);
  return edges;
}

std::optional<std::vector<Edge>> GraspSearch::run(const Node& start) const {
  std::unordered_map<std::uint64_t, Record> records;
  std::priority_queue<Open> open;
  std::uint64_t count = 0;
  records[key(start)] = {0, false, start, start, {}};
  open.push({least_rest(start), count++, key(start)});
  while (!open.empty()) {
    const std::uint64_t best = open.top().key;
    open.pop();
    Record& record = records[best];
    if (record.closed) continue;
    record.closed = true;
    const Node node = record.node;
    const double cost = record.cost;
    if (is_done(node)) {
      std::vector<Edge> path;
      for (std::uint64_t k = best; k != key(start);) {
        const Record& r = records[k];
        path.push_back(r.edge);
        k = key(r.before);
      }
      std::ranges::reverse(path);
      return path;
    }
    for (Edge& edge : edges(node)) {
      const std::uint64_t next = key(edge.to);
      const double through = cost + edge.cost;
      const auto [place, is_new] = records.try_emplace(next);
      Record& r = place->second;
      if (!is_new && (r.closed || r.cost <= through)) continue;
      open.push({through + least_rest(edge.to), count++, next});
      const Node to = edge.to;
      r = {through, false, to, node, edge};
    }
  }
  return {};
}

}  // namespace mrroc::rubik
