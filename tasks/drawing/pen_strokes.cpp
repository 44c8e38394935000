#include "tasks/drawing/pen_strokes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "tasks/drawing/figures.hpp"

namespace mrroc::drawing {
namespace {

// Points first to last - 1 of the ink are one stroke.
struct InkStroke {
  std::size_t first{}, last{};
};

std::vector<InkStroke> strokes_in(const Ink& ink) {
  std::vector<InkStroke> strokes;
  for (std::size_t k = 0; k < ink.size(); ++k) {
    if (k == 0 || ink[k].stroke != ink[k - 1].stroke) strokes.push_back({k, k});
    strokes.back().last = k + 1;
  }
  return strokes;
}

bool overlap(const Ink& ink, const InkStroke& s, const PaperTime& time) {
  return ink[s.first].t <= time.end && ink[s.last - 1].t >= time.begin;
}

// Distance by which the stroke exceeds the drawing at that time [mm].
double beyond(const Ink& ink, const InkStroke& s, const PaperTime& time) {
  const auto apart = [&](std::size_t a, std::size_t b) {
    return std::hypot(ink[a].x - ink[b].x, ink[a].y - ink[b].y);
  };
  std::size_t first = s.first, last = s.last - 1;
  while (first < last && ink[first].t < time.begin) ++first;
  while (last > first && ink[last].t > time.end) --last;
  double most = 0;
  for (std::size_t k = s.first; k < first; ++k) most = std::max(most, apart(k, first));
  for (std::size_t k = last + 1; k < s.last; ++k) most = std::max(most, apart(k, last));
  return most;
}

}  // namespace

std::vector<PaperTime> paper_times(const Recording& recording, const std::vector<double>& node_t) {
  std::vector<PaperTime> times;
  bool before = false;
  for (std::size_t n = 0; n < std::min(recording.size(), node_t.size()); ++n) {
    const bool paper = recording[n].pen == PenState::paper_surface;
    if (paper && !before) times.push_back({node_t[n] - recording.macrostep_s(), node_t[n]});
    if (paper) times.back().end = node_t[n];
    before = paper;
  }
  return times;
}

std::vector<PaperTime> paper_times(const mp::ArmTrace& trace) {
  std::vector<PaperTime> times;
  bool before = false;
  for (const mp::ArmRow& row : trace) {
    if (row.m == 5 && !before) times.push_back({row.t, row.t});
    if (row.m == 5) times.back().end = row.t;
    before = row.m == 5;
  }
  return times;
}

int wrong_strokes(const Ink& ink, const std::vector<PaperTime>& said) {
  const std::vector<InkStroke> strokes = strokes_in(ink);
  int wrong = 0;
  for (const InkStroke& s : strokes) {
    const auto mine = [&](const PaperTime& time) { return overlap(ink, s, time); };
    const auto time = std::ranges::find_if(said, mine);
    const bool alone =
        time != said.end() && std::ranges::count_if(said, mine) == 1 &&
        std::ranges::count_if(strokes, [&](const InkStroke& o) { return overlap(ink, o, *time); }) == 1;
    wrong += !alone || beyond(ink, s, *time) > kStrayDistance;
  }
  for (const PaperTime& time : said)
    wrong += std::ranges::none_of(strokes, [&](const InkStroke& s) { return overlap(ink, s, time); });
  return wrong;
}

}  // namespace mrroc::drawing
