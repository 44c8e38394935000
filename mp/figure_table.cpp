#include "mp/figure_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <stdexcept>

#include "base/counted.hpp"
#include "base/joined.hpp"

namespace mrroc::mp {
namespace {

constexpr std::string_view kRow = "  {:<46}{}   {:<11} {}\n";

std::vector<double> values(const Figure& figure) {
  if (const double* x = std::get_if<double>(&figure)) return {*x};
  return std::get<std::vector<double>>(figure);
}

std::string cell(double x) { return std::isfinite(x) ? fmt::format("{:.4g}", x) : "-"; }

/// @return the numbers of a figure that are not as wanted, among them those that were not measured; nothing when
/// nothing is wanted of it
std::optional<std::vector<double>> misses(const FigureInfo& info, const std::vector<double>& x) {
  if (wanted(info).empty()) return std::nullopt;
  std::vector<double> missed;
  std::ranges::copy_if(x, std::back_inserter(missed),
                       [&](double v) { return !std::isfinite(v) || v < info.low || v > info.high; });
  return missed;
}

std::string verdict(const FigureInfo& info, const std::vector<double>& x) {
  const auto missed = misses(info, x);
  if (!missed) return "";
  return missed->empty() ? "ok" : "NOT OK";
}

std::string row(const FigureInfo& info, const Figure& figure, std::size_t columns, bool judged) {
  const std::vector<double> x = values(figure);
  std::string cells;
  for (std::size_t k = 0; k < std::max(columns, x.size()); ++k)
    cells += fmt::format(" {:>9}", k < x.size() ? cell(x[k]) : "");
  const std::string words(info.words);
  std::string line = fmt::format(kRow, info.unit.empty() ? words : fmt::format("{} [{}]", words, info.unit),
                                 cells, wanted(info), judged || info.always ? verdict(info, x) : "");
  line.erase(line.find_last_not_of(" \n") + 1);
  return line + "\n";
}

}  // namespace

const FigureInfo* info_of(std::string_view key, std::span<const FigureInfo> known) {
  const auto found = std::ranges::find(known, key, &FigureInfo::key);
  return found == known.end() ? nullptr : &*found;
}

const Figure& figure(const TaskFigures& figures, std::string_view key) {
  for (const TaskFigure& f : figures)
    if (f.info.key == key) return f.value;
  throw std::out_of_range(std::string(key));
}

std::string wanted(const FigureInfo& info) {
  const bool at_least = std::isfinite(info.low), at_most = std::isfinite(info.high);
  if (at_least && at_most)
    return info.low == info.high
               ? fmt::format("{:g}", info.low)
               : fmt::format("{:g} +- {:g}", (info.low + info.high) / 2, (info.high - info.low) / 2);
  if (at_most) return fmt::format("<= {:g}", info.high);
  return at_least ? fmt::format(">= {:g}", info.low) : "";
}

std::map<std::string, FigureBounds> bounds_of(const Figures& figures, std::span<const FigureInfo> known) {
  std::map<std::string, FigureBounds> bounds;
  for (const FigureInfo& info : known)
    if (figures.contains(std::string(info.key)) && !wanted(info).empty())
      bounds.emplace(info.key, FigureBounds{info.low, info.high});
  return bounds;
}

FigureVerdict judge(const std::map<std::string, Figure>& figures, std::span<const FigureInfo> known) {
  FigureVerdict v;
  for (const FigureInfo& info : known) {
    const auto figure = figures.find(std::string(info.key));
    if (figure == figures.end()) continue;
    const auto missed = misses(info, values(figure->second));
    if (!missed) continue;
    ++v.judged;
    std::vector<std::string> cells;
    for (const double x : *missed) cells.push_back(std::isfinite(x) ? cell(x) : "not measured");
    if (!cells.empty())
      v.missed.push_back(fmt::format("{} {} (wanted {})", info.key, joined(cells, " and "), wanted(info)));
  }
  return v;
}

std::string to_string(const FigureVerdict& v) {
  if (v.judged == 0) return "";
  if (v.missed.empty())
    return v.judged == 1   ? "the figure is as wanted"
           : v.judged == 2 ? "both figures are as wanted"
                           : fmt::format("all {} figures are as wanted", v.judged);
  return fmt::format("{} of {} missed what is wanted: {}", v.missed.size(), counted(v.judged, "figure"),
                     joined(v.missed, ", "));
}

std::string figure_table(const std::map<std::string, Figure>& figures, std::span<const FigureInfo> known,
                         std::span<const std::string_view> columns, bool judged) {
  std::size_t width = columns.size();  // a figure may have more numbers than there are headings
  for (const auto& [key, figure] : figures) width = std::max(width, values(figure).size());
  std::string headings;
  for (std::size_t k = 0; k < width; ++k)
    headings += fmt::format(" {:>9}", k < columns.size() ? columns[k] : std::string_view());
  std::string table = fmt::format(kRow, "figure", headings, "wanted", "");
  table.erase(table.find_last_not_of(" \n") + 1);
  table += "\n";
  for (const FigureInfo& info : known)
    if (const auto figure = figures.find(std::string(info.key)); figure != figures.end())
      table += row(info, figure->second, width, judged);
  for (const auto& [key, figure] : figures)
    if (!info_of(key, known)) table += row({.key = key, .words = key, .unit = {}}, figure, width, judged);
  return table;
}

}  // namespace mrroc::mp
