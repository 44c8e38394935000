// What was true of the object during a run, for tables and figures.
#pragma once
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "base/link/process.hpp"
#include "base/pose.hpp"
#include "mrroc/free_body_truth_t.hpp"

namespace mrroc::ball {

/// One macrostep.
struct BodyRow {
  std::int64_t i{};                  ///< at whose beginning this was so
  int m{};                           ///< behaviour of the coordinator
  Vector3 wanted{Vector3::Zero()};   ///< way of the object since the palms closed, as it is led [m]
  Vector3 yielded{Vector3::Zero()};  ///< how far the arms have yielded, across [m]
  Pose T_UO{};                       ///< of the object in the world
  std::array<double, 2> press{};     ///< normal forces of the palms [N]
  bool on_pedestal{};                ///< it touched the pedestal
  bool on_floor{};                   ///< it touched the floor
};

/// Collects the simulator's messages. Used by MP's thread.
class BodyRecord {
 public:
  /// Make this before the process assembles.
  explicit BodyRecord(link::Process& process) : in_(process.inbox<free_body_truth_t>("free_body.truth")) {}
  /// Takes what has come; to be called in every macrostep. @param m, wanted, yielded  of macrostep i
  void collect(std::int64_t i, int m, const Vector3& wanted, const Vector3& yielded);
  /// @return a row per macrostep of which a message has come, in order
  [[nodiscard]] const std::vector<BodyRow>& rows() const { return rows_; }

 private:
  /// What the coordinator was doing.
  struct Stage {
    std::int64_t i{};
    int m{};
    Vector3 wanted, yielded;
  };
  std::unique_ptr<link::Inbox<free_body_truth_t>> in_;
  std::vector<Stage> stages_;
  std::vector<BodyRow> rows_;
};

/// Writes body.csv: `t,m,x,y,z,ax,ay,az,wanted_x,wanted_y,wanted_z,press1,press2,on_pedestal,on_floor`.
/// @throws FaultError cannot_write
void write_body_table(const std::filesystem::path& file, const std::vector<BodyRow>& rows);

}  // namespace mrroc::ball
