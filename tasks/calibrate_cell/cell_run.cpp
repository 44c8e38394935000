#include "tasks/calibrate_cell/cell_run.hpp"

#include "base/link/take_all.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"

namespace mrroc::calibrate_cell {

CellRun::CellRun(mp::TaskRun& run, const std::vector<CameraSetup>& cameras, mp::SoloParameters parameters)
    : n_s_(parameters.n_s),
      records_([&] {
        std::vector<CameraRecord> records;
        for (const CameraSetup& camera : cameras) records.push_back({camera, {}});
        return records;
      }()),
      reading_in_([&] {
        std::vector<std::unique_ptr<link::Inbox<camera_reading_t>>> in;
        for (const CameraSetup& camera : cameras)
          in.push_back(run.process().inbox<camera_reading_t>(camera.key + ".board"));
        return in;
      }()),
      solo_(run, with_cameras(std::move(parameters))) {}

mp::SoloParameters CellRun::with_cameras(mp::SoloParameters k) {
  if (records_.empty()) return k;
  k.ask = want_pictures;
  k.sensor = kCamerasSetting;
  for (const auto& in : reading_in_) k.others.sources.push_back(in.get());
  k.others.here = [this](std::int64_t i, std::int64_t) { return here(i); };
  k.watch = [this] { collect(); };
  return k;
}

Outcome CellRun::execute() {
  const Outcome o = solo_.execute();
  collect();
  return o;
}

void CellRun::collect() {
  for (std::size_t k = 0; k < records_.size(); ++k) link::take_all(*reading_in_[k], records_[k].readings);
}

bool CellRun::here(std::int64_t i) const {
  for (std::size_t k = 0; k < records_.size(); ++k) {
    const CameraSetup& camera = records_[k].camera;
    const std::int64_t step = i * n_s_ - camera.latency;
    if (step >= 0 && !reading_in_[k]->at(step / camera.period)) return false;
  }
  return true;
}

}  // namespace mrroc::calibrate_cell
