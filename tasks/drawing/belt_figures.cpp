#include "tasks/drawing/belt_figures.hpp"

#include <cmath>

#include "tasks/drawing/figures.hpp"

namespace mrroc::drawing {

Drawing drawing_in_place(const Recording& recording, const Point& start) {
  Drawing drawing;
  Point p = start;
  bool on_paper = false;
  for (std::size_t n = 0; n < recording.size(); ++n) {
    const bool paper = recording[n].pen == PenState::paper_surface;
    if (paper && !on_paper) drawing.push_back({p});
    // E is upright: its x is y of the sheet, and its y is x of the sheet.
    const Twist& v = recording[n].velocity;
    p += 1e3 * recording.macrostep_s() * Point(v[Axis::y], v[Axis::x]);
    if (paper) drawing.back().push_back(p);
    on_paper = paper;
  }
  return drawing;
}

std::map<std::string, mp::Figure> belt_figures(const RunRecord& record, const RunInk& ink,
                                               const Parameters& k, const std::array<Vector3, kArms>& papers,
                                               bool finished) {
  if (!k.belt_runs) return {};
  std::vector<double> rms, drift;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    drift.push_back(1e3 * record.belt.drift(arm));
    const auto begin = record.belt.begin(arm);
    if (!begin || !ink.drawn[arm]) continue;
    const Vector3 p = 1e3 * (*begin - papers[arm]);
    const InkFigures f = compare(strokes_of(*ink.drawn[arm]),
                                 drawing_in_place(record.recording, {-p.y(), p.x()}), Align::none);
    rms.push_back(finished || f.strokes_missing == 0 ? f.rms_mm : std::nan(""));
  }
  std::map<std::string, mp::Figure> figures{{"belt_drift_mm", drift},
                                            {"belt_starts", static_cast<double>(record.belt.starts())}};
  if (!rms.empty()) figures["belt_rms_mm"] = rms;
  return figures;
}

}  // namespace mrroc::drawing
