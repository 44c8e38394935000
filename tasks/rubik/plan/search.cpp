#include "tasks/rubik/plan/search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <queue>
#include <unordered_map>

namespace mrroc::rubik {
namespace {

using std::numbers::pi;

constexpr int kPerGroup = 4;
constexpr int kAllFaces = (1 << kFaces) - 1;

std::uint64_t key(const Node& n) {
  const auto u = [](int x) { return static_cast<std::uint64_t>(x); };
  return u(static_cast<int>(n.grasp.hand)) | u(number(n.grasp.palm)) << 1 | u(number(n.grasp.jaw)) << 4 |
         u(n.stances[0]) << 8 | u(n.stances[1]) << 16 | u(n.done) << 24;
}

struct Record {
  double cost{};
  bool closed{};
  Node node, before;
  Edge edge;
};

struct Open {
  double estimate{};
  std::uint64_t number{};  // of two with one estimate the older one comes first
  std::uint64_t key{};
  bool operator<(const Open& o) const {
    return estimate > o.estimate || (estimate == o.estimate && number > o.number);
  }
};

}  // namespace

std::vector<TurnGroup> grouped(std::span<const Move> moves) {
  std::vector<TurnGroup> groups;
  for (const Move m : moves) {
    if (groups.empty() ||
        (groups.back().moves[0].face() != m.face() && groups.back().moves[0].face() != opposite(m.face()))) {
      groups.push_back({{m}});
      continue;
    }
    auto& group = groups.back().moves;
    const auto same = std::ranges::find(group, m.face(), &Move::face);
    if (same == group.end()) {
      group.push_back(m);
    } else if (const int quarters = (same->quarters() + m.quarters()) % 4; quarters > 0) {
      *same = Move(m.face(), quarters);
    } else {
      group.erase(same);
      if (group.empty()) groups.pop_back();
    }
  }
  return groups;
}

bool GraspSearch::is_done(const Node& node) const {
  return order_.show_all ? node.done == kAllFaces
                         : node.done == kPerGroup * static_cast<int>(order_.groups.size());
}

double GraspSearch::least_rest(const Node& node) const {
  const CycleTimes& times = options_.times;
  if (order_.show_all) return (kFaces - std::popcount(static_cast<unsigned>(node.done))) * times.look;
  // Both hands have to grip anew for every face, but for the first one, which one or both of them may hold.
  const double grip = times.grip + times.open + options_.grip_penalty;
  double rest = 0;
  bool first = true;
  const std::size_t begun = static_cast<std::size_t>(node.done / kPerGroup);
  for (std::size_t g = begun; g < order_.groups.size(); ++g)
    for (std::size_t k = 0; k < order_.groups[g].moves.size(); ++k) {
      if (g == begun && (node.done % kPerGroup & (1 << k))) continue;
      const int quarters = order_.groups[g].moves[k].quarters();
      rest += (first ? 1 : 2) * grip + (quarters == 2 ? pi : pi / 2) / times.turn_rate;
      first = false;
    }
  return rest;
}

std::vector<int> GraspSearch::holder_stances(const Node& node, Place place) const {
  const Hand holder = node.grasp.hand;
  const auto& stances = motions_.stances(holder);
  const int now = node.stances[index(holder)];
  const Stance& at = motions_.stance(holder, now);
  std::vector<int> found;
  for (int k = 0; k < static_cast<int>(stances.size()); ++k) {
    const Stance& s = stances[static_cast<std::size_t>(k)];
    if (s.place != place) continue;
    // Where it stands in the right place already, it only winds back.
    const Eigen::Index last = s.hold.size() - 1;
    const double turn = s.hold[last] - at.hold[last];
    if (at.place == place && std::abs(turn - 2 * pi * std::round(turn / (2 * pi))) > 0.1) continue;
    found.push_back(k);
  }
  return found;
}

std::optional<int> GraspSearch::turned_stance(int stance, int quarters) const {
  const Stance& from = motions_.stance(Hand::track, stance);
  const Eigen::Index last = from.hold.size() - 1;
  const auto& stances = motions_.stances(Hand::track);
  for (int k = 0; k < static_cast<int>(stances.size()); ++k) {
    const Stance& s = stances[static_cast<std::size_t>(k)];
    if (s.place == Place::front && std::abs(s.hold[last] - from.hold[last] - quarters * pi / 2) < 1e-6)
      return k;
  }
  return {};
}

std::vector<Motion> GraspSearch::motions_of(const Node& from, const Edge& e) const {
  const Hand h = from.grasp.hand, w = other(h);
  std::vector<Motion> all{{MotionKind::carry, h, from.stances[index(h)], e.holder, from.stances[index(w)]}};
  if (e.shows) return all;
  all.push_back({MotionKind::reach, w, from.stances[index(w)], e.comer, e.holder});
  std::array<int, 2> at{};
  at[index(h)] = e.holder;
  at[index(w)] = e.comer;
  if (e.turn) {
    const int turned = e.to.stances[index(Hand::track)];
    const std::size_t T = index(Hand::track);
    all.push_back({MotionKind::turn, Hand::track, at[T], turned, at[index(Hand::postument)]});
    at[T] = turned;
  }
  const Hand leaves = e.comer_leaves ? w : h;
  all.push_back(
      {MotionKind::retreat, leaves, at[index(leaves)], at[index(leaves)], at[index(other(leaves))]});
  return all;
}

void GraspSearch::add(std::vector<Edge>& edges, const Node& node, Edge edge) const {
  const CycleTimes& times = options_.times;
  edge.cost = edge.shows ? times.look : times.grip + times.open + options_.grip_penalty;
  for (const Motion& m : motions_of(node, edge))
    edge.cost += m.kind == MotionKind::turn ? 0 : motions_.seconds(m);
  if (edge.turn) edge.cost += std::abs(edge.quarters) * pi / 2 / times.turn_rate;
  if (std::isfinite(edge.cost)) edges.push_back(std::move(edge));
}

void GraspSearch::add_turns(std::vector<Edge>& edges, const Node& node, const Edge& meeting,
                            const Grasp& comer) const {
  const std::size_t g = static_cast<std::size_t>(node.done / kPerGroup);
  if (order_.show_all || g >= order_.groups.size()) return;
  const Hand w = comer.hand;
  const Grasp keeps = w == Hand::postument ? comer : node.grasp;
  const Grasp turns = w == Hand::postument ? node.grasp : comer;
  const auto& moves = order_.groups[g].moves;
  for (std::size_t k = 0; k < moves.size(); ++k) {
    const int done = node.done | (1 << k);
    if (done == node.done || moves[k].face() != keeps.palm) continue;
    std::vector<int> ways{moves[k].quarters() == 3 ? -1 : moves[k].quarters()};
    if (ways[0] == 2) ways.push_back(-2);
    for (const int quarters : ways) {
      const int from = w == Hand::track ? meeting.comer : meeting.holder;
      const auto to = turned_stance(from, quarters);
      if (!to) continue;
      for (const bool comer_leaves : {false, true}) {
        Edge e = meeting;
        e.turn = moves[k];
        e.quarters = quarters;
        e.comer_leaves = comer_leaves;
        e.to.stances[index(Hand::track)] = *to;
        const bool postument_stays = (w == Hand::postument) != comer_leaves;
        e.to.grasp = postument_stays ? turned(keeps, quarters) : turns;
        const int all = (1 << moves.size()) - 1;
        e.to.done = (done % kPerGroup) == all ? kPerGroup * static_cast<int>(g + 1) : done;
        add(edges, node, std::move(e));
      }
    }
  }
}

void GraspSearch::add_meetings(std::vector<Edge>& edges, const Node& node, int holder, Place comes) const {
  const Hand h = node.grasp.hand, w = other(h);
  const auto& stances = motions_.stances(w);
  for (int k = 0; k < static_cast<int>(stances.size()); ++k) {
    if (stances[static_cast<std::size_t>(k)].place != comes) continue;
    Edge e;
    e.holder = holder;
    e.comer = k;
    e.to = node;
    e.to.stances[index(h)] = holder;
    e.to.stances[index(w)] = k;
    const Grasp comer = motions_.seen_from(w, k, node.grasp, holder);
    if (comes == Place::front) add_turns(edges, node, e, comer);
    e.to.grasp = comer;
    add(edges, node, std::move(e));
  }
}

void GraspSearch::add_looks(std::vector<Edge>& edges, const Node& node) const {
  const Hand h = node.grasp.hand;
  const Matrix3 R_CE = cube_in_hand(node.grasp).R.transpose();
  const auto& stances = motions_.stances(h);
  for (int k = 0; k < static_cast<int>(stances.size()); ++k) {
    const Stance& s = stances[static_cast<std::size_t>(k)];
    if (s.place != Place::shown) continue;
    const Face face = face_along(R_CE * s.shown);
    if (node.done & (1 << number(face))) continue;
    Edge e;
    e.holder = k;
    e.shows = face;
    e.to = node;
    e.to.stances[index(h)] = k;
    e.to.done |= 1 << number(face);
    add(edges, node, std::move(e));
  }
}

std::vector<Edge> GraspSearch::edges(const Node& node) const {
  std::vector<Edge> edges;
  for (const int holder : holder_stances(node, Place::front)) add_meetings(edges, node, holder, Place::front);
  for (const int holder : holder_stances(node, Place::offered))
    add_meetings(edges, node, holder, Place::side);
  if (order_.show_all) add_looks(edges, node);
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
      std::vector<Edge> way;
      for (std::uint64_t k = best; k != key(start);) {
        const Record& r = records[k];
        way.push_back(r.edge);
        k = key(r.before);
      }
      std::ranges::reverse(way);
      return way;
    }
    for (Edge& edge : edges(node)) {
      const std::uint64_t next = key(edge.to);
      const double through = cost + edge.cost;
      const auto [place, is_new] = records.try_emplace(next);
      Record& r = place->second;
      if (!is_new && (r.closed || r.cost <= through)) continue;
      open.push({through + least_rest(edge.to), count++, next});
      const Node to = edge.to;
      r = {through, false, to, node, std::move(edge)};
    }
  }
  return {};
}

}  // namespace mrroc::rubik
