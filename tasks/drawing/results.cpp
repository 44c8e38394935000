#include "tasks/drawing/results.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>

#include "base/counted.hpp"
#include "mp/print_line.hpp"
#include "tasks/drawing/doubtful.hpp"
#include "tasks/drawing/figure_info.hpp"
#include "tasks/drawing/figures.hpp"
#include "tasks/drawing/pen_strokes.hpp"

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

/// @return whether the arm has drawn or travelled, so that its pen state could be compared with the memory
bool reproduces(const mp::ArmTrace& trace) {
  return std::ranges::any_of(trace, [](const mp::ArmRow& row) { return row.m == 5 || row.m == 7; });
}

double segment_skew(const RunRecord& record) {
  const auto& [first, second] = record.segment_starts;
  if (first.empty() && second.empty()) return std::nan("");
  // Segments that only one arm drew are no less than so many macrosteps apart.
  double skew = std::abs(static_cast<double>(first.size()) - static_cast<double>(second.size()));
  for (std::size_t k = 0; k < std::min(first.size(), second.size()); ++k)
    skew = std::max(skew, static_cast<double>(std::abs(first[k] - second[k])));
  return skew;
}

/// @return those of the figures that are not as wanted, with their largest value; empty when none is
std::string missed_of(std::span<const std::string_view> keys,
                      const std::map<std::string, mp::Figure>& figures) {
  std::string missed;
  for (const std::string_view key : keys) {
    const auto found = figures.find(std::string(key));
    const auto info = std::ranges::find(kFigures, key, &mp::FigureInfo::key);
    if (found == figures.end() || info == kFigures.end()) continue;
    const double* const one = std::get_if<double>(&found->second);
    const std::vector<double> values = one ? std::vector{*one} : std::get<std::vector<double>>(found->second);
    const auto beyond = [&](double x) { return x < info->low || x > info->high; };
    if (std::ranges::none_of(values, beyond)) continue;
    missed += fmt::format("{}{} {:.3g}", missed.empty() ? "" : ", ", key, std::ranges::max(values));
  }
  return missed;
}

/// A drawing that ends with its only stroke has no travel, and one of dots no force after the touch-down: such figures
/// do not apply.
void leave_out_what_does_not_apply(std::map<std::string, mp::Figure>& figures, const RunRecord& record) {
  const auto has = [&](int m) {
    return std::ranges::all_of(record.traces, [m](const mp::ArmTrace& trace) {
      return std::ranges::find(trace, m, &mp::ArmRow::m) != trace.end();
    });
  };
  const auto of_no_arm = [&](const char* key) {
    return std::ranges::all_of(std::get<std::vector<double>>(figures.at(key)),
                               [](double x) { return std::isnan(x); });
  };
  if (!has(7) && of_no_arm("travel_z_mm")) figures.erase("travel_z_mm");
  if (has(5) && of_no_arm("paper_force_mean_N"))
    for (const char* const key : {"paper_force_mean_N", "paper_force_std_N"}) figures.erase(key);
}

/// @return a line when the pen did not leave as many strokes as it was to draw; usually they are too close
std::string stroke_warning(const mp::Summary& s) {
  const auto number = [&](const char* key) {
    const auto found = s.figures.find(key);
    return found == s.figures.end() ? -1 : std::get<double>(found->second);
  };
  const double input = number("strokes_input"), taught = number("strokes_taught");
  if (s.fault || input < 0 || taught < 0 || input == taught) return "";
  const auto strokes = [](double n) { return counted(std::lround(n), "stroke"); };
  return fmt::format(
      "warning: the input has {}, and {} taught: see the left part of drawing.png; draw it "
      "larger, or "
      "with strokes farther apart\n",
      strokes(input), strokes(taught) + (taught == 1 ? " was" : " were"));
}

}  // namespace

RunInk collect_ink(const fs::path& folder, const std::vector<std::string>& arms, std::optional<Ink> loaded) {
  RunInk ink;
  const bool taught_here = !loaded;
  ink.taught = taught_here ? take_sheet(folder, arms[0], 0) : std::move(loaded);
  if (ink.taught) ink.taught = without_hops(*std::move(ink.taught));  // of the hand; an arm that hops fails
  ink.drawn[0] = take_sheet(folder, arms[0], taught_here ? 1 : 0);
  ink.drawn[1] = take_sheet(folder, arms[1], 0);
  return ink;
}

void write_tables(const fs::path& folder, const RunInk& ink) {
  for (std::size_t arm = 0; arm < kArms; ++arm)
    if (ink.drawn[arm]) write_ink(folder / fmt::format("ink{}.csv", arm + 1), *ink.drawn[arm]);
  if (ink.taught) write_ink(folder / "taught.csv", *ink.taught);
}

void save_taught(const fs::path& file, const RunRecord& record, const RunInk& ink) {
  if (record.whole && ink.taught)
    save(file, {record.recording, *ink.taught});
  else
    mp::print_line(fmt::format("{} was not written: the teach-in has not come to its end", file.string()));
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
    per_arm["pen_state_mismatches"].push_back(reproduces(record.traces[arm]) ? record.mismatches[arm]
                                                                             : std::nan(""));
    if (!taught || !ink.drawn[arm]) continue;
    const int in_teach_in =
        arm == 0 && taught_here ? wrong_strokes(*taught, paper_times(record.recording, record.node_t)) : 0;
    per_arm["pen_state_wrong_strokes"].push_back(
        in_teach_in + wrong_strokes(*ink.drawn[arm], paper_times(record.traces[arm])));
    const InkFigures f = compare(strokes_of(*ink.drawn[arm]), strokes_of(*taught), Align::rigid);
    per_arm["copy_rms_mm"].push_back(tells(f) ? f.rms_mm : std::nan(""));
    per_arm["copy_max_mm"].push_back(tells(f) ? f.max_mm : std::nan(""));
    per_arm["stray_ink_mm"].push_back(f.stray_mm);
    per_arm["strokes_missing"].push_back(f.strokes_missing);
    per_arm["strokes_extra"].push_back(f.strokes_extra);
    per_arm["uncovered_mm"].push_back(f.uncovered_mm);
  }
  for (auto& [key, values] : per_arm) figures[key] = values;
  if (finished) leave_out_what_does_not_apply(figures, record);
  figures["segment_skew"] = segment_skew(record);
  figures["doubtful_strokes"] =
      record.recording.empty() ? std::nan("") : static_cast<double>(doubtful_strokes(record.recording));
  figures["nodes"] = static_cast<double>(record.recording.size());
  figures["macrostep_s"] = k.dt * k.n_s;
  return figures;
}

std::string warnings(const mp::Summary& s) {
  return stroke_warning(s) + (s.fault ? "" : copy_warning(s.figures));
}

std::string copy_warning(const std::map<std::string, mp::Figure>& figures) {
  constexpr std::array<std::string_view, 8> kOfCopies{
      "copy_rms_mm",     "copy_max_mm",   "stray_ink_mm",         "uncovered_mm",
      "strokes_missing", "strokes_extra", "pen_state_mismatches", "pen_state_wrong_strokes"};
  constexpr std::array<std::string_view, 1> kOfMemory{"doubtful_strokes"};
  std::string warning;
  if (const std::string missed = missed_of(kOfCopies, figures); !missed.empty())
    warning += fmt::format("warning: the copies are not what was taught ({}): see drawing.png\n", missed);
  if (const std::string missed = missed_of(kOfMemory, figures); !missed.empty())
    warning += fmt::format(
        "warning: the memory is doubtful ({}): pen states that do not fit the height of the pen; see "
        "taught.csv\n",
        missed);
  return warning;
}

}  // namespace mrroc::drawing
