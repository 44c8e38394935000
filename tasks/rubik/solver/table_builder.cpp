#include "tasks/rubik/solver/table_builder.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <memory>
#include <thread>

namespace mrroc::rubik {
namespace {

/// Guards one page; held for microseconds.
class PageLock {
 public:
  void lock() {
    while (flag_.test_and_set(std::memory_order_acquire)) std::this_thread::yield();
  }
  void unlock() { flag_.clear(std::memory_order_release); }

 private:
  std::atomic_flag flag_;
};

/// Columns of a page's entries, row by row.
struct Entries {
  std::vector<std::uint16_t> columns;
  std::vector<std::uint32_t> begin;  ///< of each row, and the end
};

/// Result of a level of the search.
struct Found {
  std::uint64_t entries{};
  std::uint64_t states{};  ///< entries of a page count for all pages of its class
};

template <int Bits>
class Builder {
 public:
  Builder(const CosetSpace& space, std::uint8_t* table)
      : space_(space),
        layout_{space.rows(), space.columns()},
        table_(table),
        locks_(std::make_unique<PageLock[]>(space.pages())) {}

  std::vector<std::uint64_t> run(int deepest, int threads, const Progress& progress);

 private:
  static constexpr unsigned kUnset = PackedLayout<Bits>::kMask;

  /// Two bits hold the distance modulo 3 until that of all entries is at most kTwoBitBase.
  static unsigned code_of(int distance) {
    if (Bits == 4) return static_cast<unsigned>(distance);
    return static_cast<unsigned>(distance > kTwoBitBase ? distance - kTwoBitBase : distance % 3);
  }

  [[nodiscard]] std::uint8_t* row_of(int page, int row) const {
    return table_ + static_cast<std::size_t>(page) * layout_.page_bytes() + row * layout_.row_bytes();
  }
  template <class Work>
  Found for_all_pages(int threads, Work work);
  void extract(int page, unsigned code, Entries& entries);
  void set(int page, int row, int column, unsigned code, Found& found);
  void set_equal(int page, int row, int column, unsigned code, Found& found);
  Found expand(int page, unsigned from, unsigned to, Entries& entries);
  Found look_back(int page, unsigned from, unsigned to, Entries& entries);
  void forget_small_distances();
  void fill_unset(unsigned code);

  const CosetSpace& space_;
  PackedLayout<Bits> layout_;
  std::uint8_t* table_;
  std::unique_ptr<PageLock[]> locks_;
};

template <int Bits>
template <class Work>
Found Builder<Bits>::for_all_pages(int threads, Work work) {
  std::atomic<int> next{0};
  std::vector<Found> found(threads);
  const auto run = [&](Found& mine) {
    Entries entries;
    Found sum;
    for (int page = next++; page < space_.pages(); page = next++) {
      const Found f = work(page, entries);
      sum.entries += f.entries;
      sum.states += f.states;
    }
    mine = sum;
  };
  {
    std::vector<std::jthread> others;
    for (int k = 1; k < threads; ++k) others.emplace_back(run, std::ref(found[k]));
    run(found[0]);
  }
  for (int k = 1; k < threads; ++k) {
    found[0].entries += found[k].entries;
    found[0].states += found[k].states;
  }
  return found[0];
}

template <int Bits>
void Builder<Bits>::extract(int page, unsigned code, Entries& entries) {
  entries.columns.clear();
  entries.begin.assign(1, 0);
  const std::lock_guard guard(locks_[page]);
  for (int row = 0; row < space_.rows(); ++row) {
    for_each_packed<Bits>(row_of(page, row), space_.columns(), code, [&entries](int column) {
      entries.columns.push_back(static_cast<std::uint16_t>(column));
    });
    entries.begin.push_back(static_cast<std::uint32_t>(entries.columns.size()));
  }
}

template <int Bits>
void Builder<Bits>::set(int page, int row, int column, unsigned code, Found& found) {
  std::uint8_t* bytes = row_of(page, row);
  if (get_packed<Bits>(bytes, column) != kUnset) return;
  set_packed<Bits>(bytes, column, code);
  ++found.entries;
  found.states += kAxisSymmetries / std::popcount(space_.stabiliser(page));
}

template <int Bits>
void Builder<Bits>::set_equal(int page, int row, int column, unsigned code, Found& found) {
  for (unsigned keeps = space_.stabiliser(page); keeps != 0; keeps &= keeps - 1) {
    const int s = std::countr_zero(keeps);
    set(page, space_.row_seen(row, s), space_.column_seen(column, s), code, found);
  }
}

/// Gives the distance `to` to every unset entry one turn away from an entry of this page at `from`.
template <int Bits>
Found Builder<Bits>::expand(int page, unsigned from, unsigned to, Entries& entries) {
  Found found;
  extract(page, from, entries);
  if (entries.columns.empty()) return found;
  for (int k = 0; k < space_.moves(); ++k) {
    const CosetSpace::Step step = space_.step(page, k);
    const int target = static_cast<int>(step.page);
    const std::uint16_t* const row_map = space_.row_map(k, step.symmetry);
    const std::uint16_t* const column_map = space_.column_map(k, step.symmetry);
    const bool alone = std::has_single_bit(space_.stabiliser(target));
    std::uint64_t fresh = 0;
    const std::lock_guard guard(locks_[target]);
    for (int row = 0; row < space_.rows(); ++row) {
      std::uint8_t* const bytes = row_of(target, row_map[row]);
      for (std::uint32_t e = entries.begin[row]; e < entries.begin[row + 1]; ++e) {
        const unsigned column = column_map[entries.columns[e]];
        if (get_packed<Bits>(bytes, column) != kUnset) continue;
        if (!alone) {
          set_equal(target, row_map[row], static_cast<int>(column), to, found);
          continue;
        }
        set_packed<Bits>(bytes, column, to);
        ++fresh;
      }
    }
    found.entries += fresh;
    found.states += fresh * kAxisSymmetries;
  }
  return found;
}

/// Gives the distance `to` to every unset entry of this page one turn away from any entry at `from`.
template <int Bits>
Found Builder<Bits>::look_back(int page, unsigned from, unsigned to, Entries& entries) {
  Found found;
  extract(page, kUnset, entries);
  std::vector<std::pair<std::uint16_t, std::uint16_t>> reached;
  for (int k = 0; k < space_.moves() && !entries.columns.empty(); ++k) {
    const CosetSpace::Step step = space_.step(page, k);
    const std::uint16_t* const row_map = space_.row_map(k, step.symmetry);
    const std::uint16_t* const column_map = space_.column_map(k, step.symmetry);
    std::uint32_t kept = 0;
    std::uint32_t e = 0;
    const std::lock_guard guard(locks_[step.page]);
    for (int row = 0; row < space_.rows(); ++row) {
      const std::uint8_t* const bytes = row_of(static_cast<int>(step.page), row_map[row]);
      for (const std::uint32_t end = entries.begin[row + 1]; e < end; ++e) {
        const std::uint16_t column = entries.columns[e];
        if (get_packed<Bits>(bytes, column_map[column]) == from)
          reached.emplace_back(static_cast<std::uint16_t>(row), column);
        else
          entries.columns[kept++] = column;
      }
      entries.begin[row + 1] = kept;
    }
    entries.columns.resize(kept);
  }
  const std::lock_guard guard(locks_[page]);
  for (const auto& [row, column] : reached) set(page, row, column, to, found);
  return found;
}

/// Two bits: all distances so far become "up to kTwoBitBase".
template <int Bits>
void Builder<Bits>::forget_small_distances() {
  constexpr std::uint8_t kOnes = 0x55;
  for (std::size_t k = 0; k < layout_.page_bytes() * space_.pages(); ++k) {
    const unsigned unset = table_[k] & (table_[k] >> 1U) & kOnes;
    table_[k] = static_cast<std::uint8_t>(unset * 3);
  }
}

/// Four bits: gives all unset entries the code.
template <int Bits>
void Builder<Bits>::fill_unset(unsigned code) {
  std::array<std::uint8_t, 256> filled;
  for (unsigned k = 0; k < 256; ++k) {
    const unsigned low = (k & 15) == kUnset ? code : k & 15;
    const unsigned high = k >> 4 == kUnset ? code : k >> 4;
    filled[k] = static_cast<std::uint8_t>(high << 4 | low);
  }
  for (std::size_t k = 0; k < layout_.page_bytes() * space_.pages(); ++k) table_[k] = filled[table_[k]];
}

template <int Bits>
std::vector<std::uint64_t> Builder<Bits>::run(int deepest, int threads, const Progress& progress) {
  std::fill_n(table_, layout_.bytes(space_.pages()), std::uint8_t{0xff});
  const std::uint64_t all = static_cast<std::uint64_t>(space_.pages()) * space_.rows() * space_.columns();
  const CosetSpace::Place start = space_.place_of({});
  Found level;
  set_equal(start.page, start.row, start.column, code_of(0), level);
  std::vector<std::uint64_t> states{level.states};
  std::uint64_t set_so_far = level.entries;
  if (Bits == 2) deepest = kTwoBitBase + 2;
  for (int distance = 0; set_so_far < all && distance < deepest; ++distance) {
    if (Bits == 2 && distance == kTwoBitBase) {
      forget_small_distances();
      level.entries = set_so_far;
    }
    const unsigned from = Bits == 2 && distance == kTwoBitBase ? 0 : code_of(distance);
    const unsigned to = code_of(distance + 1);
    // An unset entry finds a neighbour at this distance after a few turns, a set one tries them all.
    constexpr std::uint64_t kTurnsToFind = 6;
    const bool forward = level.entries * space_.moves() < (all - set_so_far) * kTurnsToFind;
    std::atomic<std::uint64_t> pages_done{0};
    level = for_all_pages(threads, [&](int page, Entries& entries) {
      const Found f = forward ? expand(page, from, to, entries) : look_back(page, from, to, entries);
      const std::uint64_t done = ++pages_done;
      if (progress && done % 1024 == 0)
        progress((static_cast<double>(distance) + static_cast<double>(done) / space_.pages()) / deepest);
      return f;
    });
    if (level.entries == 0) break;
    states.push_back(level.states);
    set_so_far += level.entries;
  }
  if (Bits == 4 && set_so_far < all) fill_unset(static_cast<unsigned>(deepest + 1));
  return states;
}

}  // namespace

template <int Bits>
std::vector<std::uint64_t> build_table(const CosetSpace& space, std::span<std::uint8_t> table, int deepest,
                                       int threads, const Progress& progress) {
  return Builder<Bits>(space, table.data()).run(deepest, threads, progress);
}

template std::vector<std::uint64_t> build_table<2>(const CosetSpace&, std::span<std::uint8_t>, int, int,
                                                   const Progress&);
template std::vector<std::uint64_t> build_table<4>(const CosetSpace&, std::span<std::uint8_t>, int, int,
                                                   const Progress&);

}  // namespace mrroc::rubik
