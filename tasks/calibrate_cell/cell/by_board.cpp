#include "tasks/calibrate_cell/cell/by_board.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/msg/convert.hpp"
#include "tasks/calibrate_cell/calibrate_cell.hpp"
#include "tasks/calibrate_cell/result.hpp"
#include "tasks/calibrate_cell/vocabulary.hpp"
#include "vsp/calibration/bases.hpp"

namespace mrroc::calibrate_cell {
namespace {

bool still(const mp::ArmRow& row) { return row.m == kLook || row.m == kKeepStill; }

const mp::ArmRow* row_of(const mp::ArmTrace& trace, std::int64_t i) {
  const auto row = std::ranges::lower_bound(trace, i, {}, &mp::ArmRow::i);
  return row != trace.end() && row->i == i ? &*row : nullptr;
}

/// Number of that still of an arm -> turn.
std::optional<Turn> turn_of(const ViewPlan& plan, std::size_t number) {
  for (const Views& views : plan) {
    if (number < views.joints.size()) return views.turn;
    number -= views.joints.size();
  }
  return {};
}

/// Pictures of one camera in stills of one turn.
struct Seen {
  std::vector<vsp::PosedView> views;
  std::size_t stills{};
};

Seen pictures(const CameraRecord& record, const Board& board, const std::vector<Still>& stills, Turn turn,
              std::size_t moving) {
  Seen seen;
  for (const Still& s : stills) {
    if (s.turn != turn) continue;
    ++seen.stills;
    const auto shows = [&](const camera_reading_t& m) { return m.seen != 0 && m.t > s.from && m.t <= s.to; };
    const auto m = std::ranges::find_if(record.readings, shows);
    if (m == record.readings.end()) continue;
    const Pose T_CG = from_message(*m).T_CG;
    vsp::PosedView view{{}, s.T_0E.at(moving)};
    for (int row = 0; row < board.rows; ++row)
      for (int column = 0; column < board.columns; ++column)
        view.view.corners.push_back(project(record.camera.model, T_CG * board.corner(row, column)));
    seen.views.push_back(std::move(view));
  }
  return seen;
}

Seen enough(Seen seen, const std::string& camera, const char* what) {
  if (seen.views.size() >= kLeastViews) return seen;
  throw FaultError(kBoardNotSeen,
                   fmt::format("camera {} has seen the board in {} of {} pictures while {}; {} are needed",
                               camera, seen.views.size(), seen.stills, what, kLeastViews));
}

const CameraRecord& record_of(const std::vector<CameraRecord>& records, const CameraSetup& camera) {
  return *std::ranges::find(records, camera.key, [](const CameraRecord& r) { return r.camera.key; });
}

Pose standing(const std::vector<Still>& stills, Turn turn, std::size_t arm) {
  return std::ranges::find(stills, turn, &Still::turn)->T_0E.at(arm);
}

void add_hand_camera(const BelievedSight& sight, const std::vector<Still>& stills,
                     const std::vector<CameraRecord>& records, ByBoard& found) {
  const CameraSetup& camera = *sight.in_hand;
  const CameraRecord& record = record_of(records, camera);
  const Seen shown =
      enough(pictures(record, sight.board, stills, Turn::show, kBoardArm), camera.key, "the board was moved");
  const Seen looked =
      enough(pictures(record, sight.board, stills, Turn::look, kCameraArm), camera.key, "it was moved");
  const vsp::BasesByBoard bases =
      vsp::calibrate_bases(camera.model, {shown.views, standing(stills, Turn::show, kCameraArm)},
                           {looked.views, standing(stills, Turn::look, kBoardArm)}, sight.board);
  found.T_12 = bases.T_12.inverse();  // the arm with the board is arm 1 there
  found.T_EG = bases.T_E1G;
  found.cameras.push_back(
      {camera, bases.T_E2C, shown.stills + looked.stills, shown.views.size() + looked.views.size()});
}

void add_fixed_camera(const BelievedSight& sight, const CameraSetup& camera, const std::vector<Still>& stills,
                      const std::vector<CameraRecord>& records, const Bases& bases, ByBoard& found) {
  const bool in_world = camera.mount == CameraMount::world;
  const Pose mount = in_world ? Pose{} : bases[camera.robot == kKeys[0] ? 0 : 1];
  std::vector<Still> shown;  // to this camera
  for (const Still& s : stills)
    if (in_sight(camera.model, sight.board,
                 (mount * camera.place).inverse() * bases[kBoardArm] * s.T_0E[kBoardArm] * sight.T_EG))
      shown.push_back(s);
  const Seen seen = enough(pictures(record_of(records, camera), sight.board, shown, Turn::present, kBoardArm),
                           camera.key, "the board was moved before it");
  const vsp::PlaceCalibration place =
      vsp::calibrate_place(camera.model, vsp::Arrangement::board_in_hand, seen.views, sight.board);
  const Pose T_UC = bases[kBoardArm] * place.camera;
  found.cameras.push_back({camera, mount.inverse() * T_UC, seen.stills, seen.views.size()});
}

}  // namespace

std::vector<Still> stills_of(const std::vector<mp::ArmTrace>& traces,
                             const std::array<ViewPlan, kArms>& plans) {
  std::vector<Still> stills;
  for (std::size_t arm = 0; arm < kArms; ++arm) {
    const mp::ArmTrace& rows = traces.at(arm);
    std::size_t number = 0;
    for (auto row = rows.begin(); row != rows.end();) {
      const auto begin = std::find_if(row, rows.end(), still);
      const auto end = std::find_if_not(begin, rows.end(), still);
      row = end;
      if (begin == end || begin == rows.begin()) continue;
      const auto turn = turn_of(plans.at(arm), number++);
      const mp::ArmRow* const other = row_of(traces.at(1 - arm), begin->i);
      if (!turn || !other || other->m != kWaitToView) continue;
      Still s{.turn = *turn, .from = std::prev(begin)->t, .to = std::prev(end)->t, .T_0E = {}};
      s.T_0E[arm] = pose_from_angle_axis(std::prev(end)->pose);
      s.T_0E[1 - arm] = pose_from_angle_axis(other->pose);
      stills.push_back(s);
    }
  }
  return stills;
}

ByBoard find_by_board(const BelievedSight& sight, const std::vector<Still>& stills,
                      const std::vector<CameraRecord>& records, const std::optional<Pose>& T_12,
                      const Bases& believed) {
  ByBoard found;
  if (sight.in_hand) add_hand_camera(sight, stills, records, found);
  Bases bases = believed;
  if (T_12 || found.T_12) bases = corrected(believed, T_12 ? *T_12 : *found.T_12);
  for (const CameraSetup& camera : sight.fixed)
    add_fixed_camera(sight, camera, stills, records, bases, found);
  return found;
}

}  // namespace mrroc::calibrate_cell
