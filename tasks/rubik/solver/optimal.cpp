#include "tasks/rubik/solver/optimal.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <mutex>
#include <numeric>
#include <thread>
#include <utility>

#include "tasks/rubik/solver/bounds.hpp"

namespace mrroc::rubik {
namespace {

/// Most turns that can follow a turn, and the first one.
constexpr int kMostChildren = 18;

/// A state of the search. It can be continued at both ends: turns of the cube follow each other at the solution's
/// beginning, turns of the inverse, undone, at its end. The side to turn next is always called cube.
struct Node {
  CubePair pair;
  std::array<AxisCoordinates, 2> coordinates;  ///< of cube and inverse
  std::array<std::int8_t, kViews> bound;       ///< along the axes of the cube, then of the inverse
  bool swapped;                                ///< cube is the inverse of the cube to solve
};

void swap_sides(Node& n) {
  std::swap(n.pair.cube, n.pair.inverse);
  std::swap(n.coordinates[0], n.coordinates[1]);
  std::swap_ranges(n.bound.begin(), n.bound.begin() + kAxes, n.bound.begin() + kAxes);
  n.swapped = !n.swapped;
}

/// Searches one depth, for one thread.
class DepthSearch {
 public:
  DepthSearch(const Bounds& bounds, Stopwatch& watch) : bounds_(bounds), counter_(watch) {}

  /// @param turns  how many turns the solution has from here
  /// @return whether a solution was found
  bool search(const Node& node, int turns);
  /// Begins at a state that so many turns led to.
  void begin(const Moves& first) {
    ends_[0] = first;
    ends_[1].clear();
  }
  [[nodiscard]] Moves solution() const {
    Moves moves = ends_[0];
    const Moves last = inverse(ends_[1]);
    moves.insert(moves.end(), last.begin(), last.end());
    return moves;
  }
  [[nodiscard]] bool over() const { return counter_.over(); }
  [[nodiscard]] std::uint64_t nodes() const { return nodes_; }

 private:
  struct Child {
    Node node;
    Move move;
    Probe probe;
  };

  void look(Child& child, int view) const {
    child.probe = bounds_.probe(child.node.coordinates[view / kAxes], view % kAxes);
  }

  const Bounds& bounds_;
  NodeCounter counter_;
  std::array<Moves, 2> ends_;  ///< turns of the cube, turns of the inverse
  std::uint64_t nodes_{};
};

bool DepthSearch::search(const Node& node, int turns) {
  if (turns == 0) return node.pair.cube == Cube{};
  if (counter_.count()) return false;
  ++nodes_;
  Moves& end = ends_[node.swapped ? 1 : 0];
  const Move* const last = end.empty() ? nullptr : &end.back();
  const int left = turns - 1;

  std::array<Child, kMostChildren> children;
  int count = 0;
  for (int m = 0; m < kMoves; ++m) {
    if (!may_follow(last, Move(m))) continue;
    Child& child = children[count++];
    child.move = Move(m);
    child.node.pair = FastTurns::get().after(node.pair, Move(m));
    child.node.swapped = node.swapped;
  }
  if (left > 0 && left <= bounds_.largest()) {
    for (Child* c = children.data(); c != children.data() + count; ++c)
      c->node.coordinates[0] = bounds_.coordinates(c->node.pair.cube);
    // The view with the largest bound before the turn is likely to cut off most.
    std::array<int, kViews> views{0, 1, 2, 3, 4, 5};
    const auto by_bound = [&node](int a, int b) { return node.bound[a] > node.bound[b]; };
    std::sort(views.begin(), views.begin() + kAxes, by_bound);
    std::sort(views.begin() + kAxes, views.end(), by_bound);
    for (int v = 0; v < kViews && count > 0; ++v) {
      const int view = views[v];
      for (int k = 0; k < count; ++k) {
        if (v == kAxes) children[k].node.coordinates[1] = bounds_.coordinates(children[k].node.pair.inverse);
        look(children[k], view);
      }
      int kept = 0;
      for (int k = 0; k < count; ++k) {
        const int b = bounds_.bound(children[k].probe, left);
        if (b > left) continue;
        children[k].node.bound[view] = static_cast<std::int8_t>(b);
        if (kept != k) children[kept] = children[k];
        ++kept;
      }
      count = kept;
    }
  } else {
    for (int k = 0; k < count; ++k) children[k].node.bound = {};
  }
  for (int k = 0; k < count; ++k) {
    Node& next = children[k].node;
    if (left > 0 && left <= bounds_.largest() && bounds_.corner_bound(next.pair.cube) > left) continue;
    end.push_back(children[k].move);
    const auto cube_side = std::accumulate(next.bound.begin(), next.bound.begin() + kAxes, 0);
    const auto inverse_side = std::accumulate(next.bound.begin() + kAxes, next.bound.end(), 0);
    if (inverse_side > cube_side) swap_sides(next);
    if (search(next, left)) return true;
    end.pop_back();
    if (counter_.over()) return false;
  }
  return false;
}

Node root_of(const Bounds& bounds, const Cube& cube) {
  Node node{CubePair::of(cube), {}, {}, false};
  node.coordinates = {bounds.coordinates(node.pair.cube), bounds.coordinates(node.pair.inverse)};
  return node;
}

/// The states after two turns, for threads to share.
struct Job {
  Moves first;
  Node node;
};

std::vector<Job> make_jobs(const Bounds& bounds, const Cube& cube) {
  std::vector<Job> jobs;
  for (int a = 0; a < kMoves; ++a)
    for (int b = 0; b < kMoves; ++b) {
      const Moves first{Move(a), Move(b)};
      if (may_follow(first.data(), Move(b))) jobs.push_back({first, root_of(bounds, after(cube, first))});
    }
  return jobs;
}

/// Searches all solutions of one length. @return a solution, or nothing
std::optional<Moves> search_depth(const Bounds& bounds, const Cube& cube, int turns, int threads,
                                  Stopwatch& watch, std::atomic<std::uint64_t>& nodes, bool& complete) {
  std::optional<Moves> found;
  if (threads == 1 || turns < 8) {
    DepthSearch search(bounds, watch);
    if (search.search(root_of(bounds, cube), turns)) found = search.solution();
    complete = !search.over();
    nodes += search.nodes();
    return found;
  }
  const std::vector<Job> jobs = make_jobs(bounds, cube);
  std::atomic<std::size_t> next{0};
  std::atomic<bool> all{true};
  std::atomic<bool> done{false};
  std::mutex mutex;
  const auto run = [&] {
    DepthSearch search(bounds, watch);
    for (std::size_t k = next++; k < jobs.size() && !search.over() && !done; k = next++) {
      search.begin(jobs[k].first);
      if (!search.search(jobs[k].node, turns - 2)) continue;
      const std::lock_guard guard(mutex);
      if (!found) found = search.solution();
      done = true;
    }
    if (search.over()) all = false;
    nodes += search.nodes();
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads; ++k) others.emplace_back(run);
    run();
  }
  complete = all;
  return found;
}

}  // namespace

OptimalResult solve_optimally(const Bounds& bounds, const Cube& cube, const SearchLimits& limits,
                              const Lengths& lengths) {
  OptimalResult result;
  Stopwatch watch(limits);
  std::atomic<std::uint64_t> nodes{0};
  const int bound = cube == Cube{} ? 0 : std::max(1, bounds.lower_bound(CubePair::of(cube)));
  for (result.lower_bound = std::max(bound, lengths.shortest); result.lower_bound <= lengths.longest;
       ++result.lower_bound) {
    bool complete = true;
    result.moves = search_depth(bounds, cube, result.lower_bound, limits.threads, watch, nodes, complete);
    if (result.moves || !complete) break;
  }
  result.nodes = nodes;
  return result;
}

}  // namespace mrroc::rubik
