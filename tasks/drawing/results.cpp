#include "tasks/drawing/results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tasks/drawing/figures.hpp"

namespace mrroc::drawing {
namespace {

namespace fs = std::filesystem;

/// At the beginning of a stroke the pen still comes to rest on the paper [s].
constexpr double kTouchDown = 0.2;

std::optional<Ink> take_sheet(const fs::path& folder, const std::string& arm, int number) {
  const fs::path file = folder / fmt::format("{}-sheet-{}.csv", arm, number);
  if (!fs::exists(file)) return std::nullopt;
  Ink ink = read_ink(file);
  fs::remove(file);
  return ink;
}

/// Calls see(begin, end) for every run of rows with that m.
template <class See>
void for_each_segment(const mp::ArmTrace& trace, int m, See see) {
  for (std::size_t begin = 0; begin < trace.size();) {
    std::size_t end = begin;
    while (end < trace.size() && trace[end].m == trace[begin].m) ++end;
    if (trace[begin].m == m) see(begin, end);
    begin = end;
  }
}

/// Mean and standard deviation of F_z while drawing.
std::pair<double, double> paper_force(const mp::ArmTrace& trace) {
  std::vector<double> F;
  for_each_segment(trace, 5, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k)
      if (trace[k].t - trace[begin].t >= kTouchDown) F.push_back(trace[k].F[Axis::z]);
  });
  double mean = 0, square = 0;
  for (const double f : F) mean += f / static_cast<double>(F.size());
  for (const double f : F) square += (f - mean) * (f - mean) / static_cast<double>(F.size());
  return F.empty() ? std::pair(std::nan(""), std::nan("")) : std::pair(mean, std::sqrt(square));
}

double largest_travel_z_mm(const mp::ArmTrace& trace) {
  double largest = std::nan("");  // without a travel
  for_each_segment(trace, 7, [&](std::size_t begin, std::size_t end) {
    const auto [low, high] = std::minmax_element(
        trace.begin() + static_cast<std::ptrdiff_t>(begin), trace.begin() + static_cast<std::ptrdiff_t>(end),
        [](const mp::ArmRow& a, const mp::ArmRow& b) { return a.pose.z() < b.pose.z(); });
    largest = std::fmax(largest, 1e3 * (high->pose.z() - low->pose.z()));
  });
  return largest;
}

double segment_skew(const RunRecord& record) {
  const auto& [first, second] = record.segment_starts;
  double skew = first.size() == second.size() && !first.empty() ? 0 : std::nan("");
  for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k)
    skew = std::max(skew, static_cast<double>(std::abs(first[k] - second[k])));
  return skew;
}

}  // namespace

RunInk collect_ink(const fs::path& folder, const std::vector<std::string>& arms, std::optional<Ink> loaded) {
  RunInk ink;
  const bool taught_here = !loaded;
  ink.taught = taught_here ? take_sheet(folder, arms[0], 0) : std::move(loaded);
  ink.drawn[0] = take_sheet(folder, arms[0], taught_here ? 1 : 0);
  ink.drawn[1] = take_sheet(folder, arms[1], 0);
  return ink;
}

void write_tables(const fs::path& folder, const RunRecord& record, const RunInk& ink) {
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    mp::write_arm_trace(folder / fmt::format("arm{}.csv", arm + 1), record.traces[arm]);
    if (ink.drawn[arm]) write_ink(folder / fmt::format("ink{}.csv", arm + 1), *ink.drawn[arm]);
  }
  if (ink.taught) write_ink(folder / "taught.csv", *ink.taught);
}

std::map<std::string, mp::Figure> figures_of(const Drawing& input, bool taught_here, const RunRecord& record,
                                             const RunInk& ink, const Parameters& k, bool finished) {
  std::map<std::string, mp::Figure> figures;
  const auto& taught = ink.taught;
  if (taught_here) figures["strokes_input"] = static_cast<double>(input.size());
  if (taught) figures["strokes_taught"] = static_cast<double>(strokes_of(*taught).size());
  const auto tells = [&](const InkFigures& f) { return finished || f.strokes_missing == 0; };
  if (taught && taught_here) {
    const InkFigures f = compare(strokes_of(*taught), input, Align::none);
    if (tells(f)) {
      figures["teach_rms_mm"] = f.rms_mm;
      figures["teach_max_mm"] = f.max_mm;
    }
  }
  std::map<std::string, std::vector<double>> per_arm;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const auto [mean, std] = paper_force(record.traces[arm]);
    per_arm["paper_force_mean_N"].push_back(mean);
    per_arm["paper_force_std_N"].push_back(std);
    per_arm["travel_z_mm"].push_back(largest_travel_z_mm(record.traces[arm]));
    if (!taught || !ink.drawn[arm]) continue;
    const InkFigures f = compare(strokes_of(*ink.drawn[arm]), strokes_of(*taught), Align::rigid);
    per_arm["copy_rms_mm"].push_back(tells(f) ? f.rms_mm : std::nan(""));
    per_arm["copy_max_mm"].push_back(tells(f) ? f.max_mm : std::nan(""));
    per_arm["stray_ink_mm"].push_back(f.stray_mm);
    per_arm["strokes_missing"].push_back(f.strokes_missing);
    per_arm["strokes_extra"].push_back(f.strokes_extra);
    per_arm["uncovered_mm"].push_back(f.uncovered_mm);
  }
  for (auto& [key, values] : per_arm) figures[key] = values;
  figures["segment_skew"] = segment_skew(record);
  figures["nodes"] = static_cast<double>(record.recording.size());
  figures["macrostep_s"] = k.dt * k.n_s;
  return figures;
}

}  // namespace mrroc::drawing
