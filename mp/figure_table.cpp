#include "mp/figure_table.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mrroc::mp {
namespace {

constexpr std::string_view kRow = "  {:<46}{}   {:<12}{}\n";

std::vector<double> values(const Figure& figure) {
  if (const double* x = std::get_if<double>(&figure)) return {*x};
  return std::get<std::vector<double>>(figure);
}

std::string cell(double x) { return std::isfinite(x) ? fmt::format("{:.4g}", x) : "-"; }

std::string verdict(const FigureInfo& info, const std::vector<double>& x) {
  if (wanted(info).empty() || !std::ranges::any_of(x, [](double v) { return std::isfinite(v); })) return "";
  const bool good = std::ranges::all_of(
      x, [&](double v) { return !std::isfinite(v) || (v >= info.low && v <= info.high); });
  return good ? "ok" : "NOT OK";
}

std::string row(const FigureInfo& info, const Figure& figure, std::size_t columns, bool judged) {
  const std::vector<double> x = values(figure);
  std::string cells;
  for (std::size_t k = 0; k < std::max(columns, x.size()); ++k)
    cells += fmt::format(" {:>9}", k < x.size() ? cell(x[k]) : "");
  const std::string words(info.words);
  std::string line = fmt::format(kRow, info.unit.empty() ? words : fmt::format("{} [{}]", words, info.unit),
                                 cells, wanted(info), judged ? verdict(info, x) : "");
  line.erase(line.find_last_not_of(" \n") + 1);
  return line + "\n";
}

}  // namespace

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

std::string figure_table(const std::map<std::string, Figure>& figures, std::span<const FigureInfo> known,
                         std::span<const std::string_view> columns, bool judged) {
  std::string headings;
  for (const std::string_view column : columns) headings += fmt::format(" {:>9}", column);
  std::string table = fmt::format(kRow, "figure", headings, "wanted", "");
  table.erase(table.find_last_not_of(" \n") + 1);
  table += "\n";
  for (const FigureInfo& info : known)
    if (const auto figure = figures.find(std::string(info.key)); figure != figures.end())
      table += row(info, figure->second, columns.size(), judged);
  for (const auto& [key, figure] : figures)
    if (std::ranges::find(known, key, &FigureInfo::key) == known.end())
      table += row({.key = key, .words = key, .unit = {}}, figure, columns.size(), judged);
  return table;
}

}  // namespace mrroc::mp
