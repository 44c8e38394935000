#include "launch/results.hpp"

#include "base/text_file.hpp"
#include "mp/pictures.hpp"
#include "mp/run_end.hpp"

namespace mrroc::launch {
namespace {

/// Does a part of the work; that it could not be done to its end is a fault of the run, unless that has one.
void attempt(mp::Summary& summary, const std::function<void()>& work) {
  Fault fault;
  try {
    return work();
  } catch (const FaultError& e) {
    fault = e.fault();
  } catch (const FileError& e) {  // a table that could not be written to its end
    fault = {.code = FaultCode::cannot_write, .text = e.what()};
  }
  if (!summary.fault) summary.fault = fault;
}

void make_tables(Results& r, const std::function<void(Results&)>& of_task) {
  const auto traces = r.coordinator.traces();
  for (std::size_t arm = 0; arm < traces.size(); ++arm)
    mp::write_arm_trace(r.folder / (r.arms[arm].key + ".csv"), traces[arm]);
  if (of_task) of_task(r);
}

bool is_always(const std::vector<mp::FigureInfo>& known, std::string_view key) {
  const mp::FigureInfo* const info = mp::info_of(key, known);
  return info && info->always;
}

}  // namespace

void make_results(Results& r, const std::function<void(Results&)>& of_task) {
  attempt(r.summary, [&] { make_tables(r, of_task); });
  for (const mp::FigureInfo& info : mp::kRunFigures)
    if (!mp::info_of(info.key, r.known)) r.known.push_back(info);
  r.summary.wanted = mp::bounds_of(r.summary.figures, r.known);
  attempt(r.summary, [&] { mp::write_summary(r.folder, r.summary); });
  attempt(r.summary, [&] { mp::draw(r.folder, r.pictures, r.setup.options.no_pictures); });
}

mp::Ending ending_of(const Results& r) {
  mp::Figures figures = r.summary.figures;
  mp::Ending ending{.folder = r.folder,
                    .pictures = mp::pictures_in(r.folder),
                    .verdict = mp::judge(figures, r.known),
                    .only = r.only};
  if (r.summary.stopped) std::erase_if(figures, [&](const auto& f) { return !is_always(r.known, f.first); });
  if (!figures.empty()) ending.figures = mp::figure_table(figures, r.known, r.columns, !r.summary.fault);
  if (!r.summary.stopped) ending.figures += r.remarks;
  return ending;
}

}  // namespace mrroc::launch
