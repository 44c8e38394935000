#include "tasks/rubik/solver/entrances.hpp"

#include <algorithm>
#include <bit>

#include "tasks/rubik/solver/fast_cube.hpp"
#include "tasks/rubik/solver/tables.hpp"

namespace mrroc::rubik {

/// Goes from the group backwards.
class Entrances::Collector {
 public:
  struct Found {
    std::uint32_t key;
    Entrance entrance;
  };

  Collector(const Entrances& entrances, const Tables& tables) : entrances_(entrances), tables_(tables) {
    note({});
    collect({}, solved_);
  }
  /// @return all ways
  [[nodiscard]] std::vector<Found>& found() { return found_; }

 private:
  /// Goes on from a cube that back_ leads to.
  void collect(const Cube& cube, const CosetState& state) {
    for (const Move m : all_moves()) {
      constexpr int kCounterclockwise = 3;
      if (back_.empty() ? m.quarters() != kCounterclockwise : !may_follow(&m, back_.back())) continue;
      const CosetState before =
          tables_.after(state, tables_.moves_seen[m.index * kAxisSymmetries + state.symmetry]);
      if (before.flip_slice_class == solved_.flip_slice_class && before.twist == solved_.twist) continue;
      back_.push_back(m);
      // Of states that symmetries turn into each other only those of the class's representative are kept.
      const bool kept =
          ((tables_.flip_slices.stabiliser[before.flip_slice_class] >> before.symmetry) & 1) != 0;
      const bool last = back_.size() == kMostTurns;
      if (kept || !last) {
        const Cube cube_before = FastTurns::get().after(cube, m);
        if (kept) note(cube_before);
        if (!last) collect(cube_before, before);
      }
      back_.pop_back();
    }
  }
  /// Takes down the way from the cube into the group.
  void note(const Cube& cube) {
    const CosetState state = tables_.state_of(cube);
    Entrance way{Arrangement::of(cube::inverse(cube)), {}, 0};
    std::ranges::copy(cube::inverse(back_), way.turns.begin());
    if (!back_.empty()) {
      const Move half(back_.front().face(), 2);
      way.half_turn =
          static_cast<std::uint8_t>(std::ranges::find(kSecondPhaseMoves, half) - kSecondPhaseMoves.begin());
    }
    found_.push_back(
        {entrances_.key_of(static_cast<int>(back_.size()), state.flip_slice_class, state.twist), way});
  }

  const Entrances& entrances_;
  const Tables& tables_;
  const CosetState solved_ = tables_.state_of({});
  Moves back_;  ///< turns from the group, the way's undone
  std::vector<Found> found_;
};

Entrances::Entrances(const Tables& tables) : classes_(static_cast<std::uint32_t>(tables.flip_slices.size())) {
  Collector collector(*this, tables);
  auto& found = collector.found();
  std::ranges::stable_sort(found, {}, &Collector::Found::key);
  slots_.resize(std::bit_ceil(found.size()));
  shift_ = 32 - std::countr_zero(slots_.size());
  entrances_.reserve(found.size());
  for (const auto& [key, entrance] : found) {
    std::size_t k = home(key);
    while (slots_[k].count != 0 && slots_[k].key != key) k = next(k);
    if (slots_[k].count == 0) slots_[k] = {key, static_cast<std::uint32_t>(entrances_.size()), 0};
    ++slots_[k].count;
    entrances_.push_back(entrance);
  }
}

}  // namespace mrroc::rubik
