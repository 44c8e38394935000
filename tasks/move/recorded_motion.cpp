#include "tasks/move/recorded_motion.hpp"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "base/agent_images.hpp"
#include "base/link/log_reader.hpp"
#include "base/link/run_folder.hpp"
#include "base/msg/convert.hpp"
#include "base/representation.hpp"
#include "base/text_file.hpp"
#include "ecp/generators/space.hpp"

namespace mrroc::any_motion {
namespace {

namespace fs = std::filesystem;
using ecp::Coordinates;

constexpr double kLeastInterval = 0.0199;  // between positions: a macrostep of this task [s]
constexpr double kRest = 0.01;             // turns of motors that are no motion yet [rad]

/// A recording, and where the arm was when it began.
struct Recorded {
  ecp::TaughtPath path;
  std::optional<Coordinates> start;  // joints; nothing: not known
};

/// What a motion wants of a recording.
struct Wanted {
  std::string arm;
  int axes{};
  Representation space{};
  Reference reference{};
  bool with_force{};
  double from{}, to{};  // simulated time of the run [s]
};

/// A run folder, and what it says of itself.
struct RecordedRun {
  fs::path folder;
  Config config;
};

/// A moment of a run.
struct Moment {
  double t{};
  EffectorReply reply;
};

bool moved(const EffectorReply& a, const EffectorReply& b) {
  return !std::ranges::equal(a.motors, b.motors, [](double p, double q) { return std::abs(p - q) < kRest; });
}

/// @return the moments from the last one before a motion to the first one behind it; all of them if there is none
std::vector<Moment> without_rests(const std::vector<Moment>& all) {
  const auto begun = std::ranges::find_if(all, [&](const Moment& m) { return moved(all[0].reply, m.reply); });
  if (begun == all.end()) return all;
  const auto over = std::find_if(all.rbegin(), all.rend(),
                                 [&](const Moment& m) { return moved(all.back().reply, m.reply); });
  return {std::prev(begun), std::next(over.base())};
}

/// The macrosteps of a run in which the arm knows where it is, without its rests before and after its motion.
std::vector<Moment> moments_of(const RecordedRun& run, const Wanted& wanted) {
  const double T = run.config.number("time.dt", 0.002, {1e-4, 0.1}, "s") *
                   run.config.integer("time.n_s", 10, {2, 32}, "steps");
  std::vector<Moment> moments;
  for (const auto& [i, message] :
       link::LogReader(run.folder).messages<effector_reply_t>(wanted.arm + ".reply")) {
    const double t = static_cast<double>(i) * T;
    const EffectorReply reply = from_message(message);
    if (!reply.position_known || t < wanted.from || t > wanted.to) continue;
    if (moments.empty() || t - moments.back().t >= kLeastInterval) moments.push_back({t, reply});
  }
  return without_rests(moments);
}

/// Pose and force of E as the arm's model has it. A run may have turned and moved E as it liked (guide turns it along the
/// curve): a replay has one E, whatever that run called so.
void see_in_own_E(EffectorReply& reply, const Wanted& wanted, const Body& body) {
  const Pose T_0E = body.pose(Eigen::Map<const Eigen::VectorXd>(reply.joints.data(), wanted.axes));
  reply.F_a = xi_F(T_0E.inverse() * pose_of(reply), reply.F_a);
  reply.pose = numbers_from_pose(wanted.space, T_0E);
}

/// What the arm did, by the teach-in of ecp/generators.
Recorded recorded_in_run(const fs::path& folder, const Wanted& wanted, const MakeBody& make_body) {
  const RecordedRun run{folder, Config::load(link::checked_run_folder(folder) / "config.toml")};
  const std::vector<Moment> moments = moments_of(run, wanted);
  std::unique_ptr<Body> body;
  if (!moments.empty() && !per_axis(wanted.space)) body = make_body(run.config, wanted.arm);
  ecp::TeachIn teach_in(wanted.space, wanted.reference, wanted.with_force, wanted.axes);
  for (const Moment& now : moments) {
    EffectorReply reply = now.reply;
    if (wanted.space == Representation::motors)
      std::ranges::copy(reply.motors, reply.pose.begin());
    else if (wanted.space == Representation::joints)
      std::ranges::copy(reply.joints, reply.pose.begin());
    else
      see_in_own_E(reply, wanted, *body);
    teach_in = teach_in.appended(reply, now.t);
  }
  Recorded recorded{teach_in.path(), {}};
  if (!moments.empty())
    recorded.start = Eigen::Map<const Eigen::VectorXd>(moments.front().reply.joints.data(), wanted.axes);
  return recorded;
}

/// Positions as a file has them: relative ones are seen from the one before, and those of a recording from its first one.
std::vector<double> positions_of(const ecp::TaughtPath& path) {
  std::vector<double> numbers;
  Coordinates before;
  for (const ecp::TaughtPose& p : path.poses) {
    Coordinates written = p.pose;
    if (path.reference == Reference::relative && before.size() > 0) {
      if (per_axis(path.space)) {
        written = p.pose - before;
      } else {
        const auto pose = [&](const Coordinates& c) {
          return pose_from_numbers(path.space, numbers_from_axes(c)).value_or(Pose{});
        };
        written = axes_from_numbers(numbers_from_pose(path.space, pose(before).inverse() * pose(p.pose)), 6);
      }
    }
    before = p.pose;
    numbers.insert(numbers.end(), written.begin(), written.end());
  }
  return numbers;
}

std::string_view word_of(Representation space) {
  return space == Representation::motors          ? "motors"
         : space == Representation::joints        ? "joints"
         : space == Representation::xyz_euler_zyz ? "xyz_euler_zyz"
                                                  : "xyz_angle_axis";
}

/// Fills in one motion.
class Inserter {
 public:
  Inserter(Config& file, const ArmKey& arm, std::string name, const fs::path& folder,
           const MakeBody& make_body)
      : file_(file),
        arm_(arm),
        table_(arm.key + "." + std::move(name)),
        folder_(folder),
        make_body_(make_body) {}

  ecp::TaughtPath insert() {
    const Config motion = file_.section(table_);
    for (const char* key : {"positions", "times", "forces"})
      if (motion.has(key)) throw wrong_value(motion, key, "must not stand here: the recording has it");
    if (motion.has("contact") && motion.text("interpolation", "mim") != "tcim")
      throw wrong_value(motion, "contact",
                        "needs interpolation = \"tcim\", and a space of poses, such as xyz_angle_axis");
    const fs::path where = folder_ / motion.text("recording", std::nullopt);
    const Recorded recorded = read(motion, where);
    const std::size_t count = recorded.path.poses.size();
    if (count < 2 || count > kMostPositions)
      throw wrong_value(
          motion, "recording",
          fmt::format("holds {} positions of {}, and a motion has 2 to {}; choose with `from` and `to`",
                      count, arm_.key, kMostPositions));
    write(motion, recorded);
    return recorded.path;
  }

 private:
  Recorded read(const Config& motion, const fs::path& where) const {
    try {
      if (!fs::is_directory(where)) return read_file(motion, where);
      const double from = motion.number("from", 0, {0, 1e6}, "s, simulated time of the run");
      return recorded_in_run(where,
                             {.arm = arm_.key,
                              .axes = arm_.axes.value_or(kMaxAxes),
                              .space = read_space(motion, Representation::joints),
                              .reference = read_reference(motion),
                              .with_force = motion.has("contact"),
                              .from = from,
                              .to = motion.number("to", 1e6, {from, 1e6}, "s, simulated time of the run")},
                             make_body_);
    } catch (const ConfigError&) {
      throw;
    } catch (const FileError& e) {
      throw wrong_value(motion, "recording", fmt::format("cannot be read: {}", e.what()));
    } catch (const FaultError& e) {
      throw wrong_value(motion, "recording", fmt::format("cannot be read: {}", e.what()));
    }
  }
  static Recorded read_file(const Config& motion, const fs::path& where) {
    for (const char* key : {"space", "reference", "from", "to"})
      if (motion.has(key))
        throw wrong_value(motion, key, "must not stand here: the file of the recording has it");
    Recorded recorded{ecp::load_taught_path(where), {}};
    const ecp::TaughtPath& path = recorded.path;
    if (path.space == Representation::joints && path.reference == Reference::absolute)
      recorded.start = path.poses.front().pose;
    return recorded;
  }
  static Representation read_space(const Config& motion, Representation usual) {
    return motion.choice("space", usual,
                         {{"motors", Representation::motors},
                          {"joints", Representation::joints},
                          {"xyz_euler_zyz", Representation::xyz_euler_zyz},
                          {"xyz_angle_axis", Representation::xyz_angle_axis}});
  }
  static Reference read_reference(const Config& motion) {
    return motion.choice("reference", Reference::absolute,
                         {{"absolute", Reference::absolute}, {"relative", Reference::relative}});
  }

  void write(const Config& motion, const Recorded& recorded) {
    const ecp::TaughtPath& path = recorded.path;
    const double stretch = motion.number("stretch", 1, {0.1, 100}, "times as long");
    std::vector<double> times, forces;
    for (const ecp::TaughtPose& p : path.poses) {
      times.push_back(stretch * p.t);
      forces.insert(forces.end(), p.F.v.begin(), p.F.v.end());
    }
    const auto put = [&](const char* key, const std::vector<double>& numbers) {
      file_.set(fmt::format("{}.{}=[{}]", table_, key, fmt::join(numbers, ", ")));
    };
    if (!motion.has("space")) file_.set(fmt::format("{}.space=\"{}\"", table_, word_of(path.space)));
    if (path.reference == Reference::relative && !motion.has("reference"))
      file_.set(table_ + ".reference=\"relative\"");
    put("positions", positions_of(path));
    put("times", times);
    if (path.with_force && motion.has("contact")) put("forces", forces);
    if (recorded.start && begins_with_it() && !file_.has(arm_.key + ".start"))
      file_.set(fmt::format("{}.start=[{}]", arm_.key, fmt::join(*recorded.start, ", ")));
  }
  [[nodiscard]] bool begins_with_it() const {
    const auto order = file_.texts(arm_.key + ".order", std::vector<std::string>{});
    return !order.empty() && arm_.key + "." + order.front() == table_;
  }

  Config& file_;
  const ArmKey& arm_;
  std::string table_;
  const fs::path& folder_;
  const MakeBody& make_body_;
};

}  // namespace

Recordings insert_recordings(Config& file, const std::vector<ArmKey>& arms, const fs::path& folder,
                             const MakeBody& make_body) {
  Recordings recordings;
  for (const ArmKey& arm : arms)
    for (const std::string& name : file.tables(arm.key)) {
      const std::string motion = arm.key + "." + name;
      if (file.has(motion + ".recording"))
        recordings.emplace(motion, Inserter(file, arm, name, folder, make_body).insert());
    }
  return recordings;
}

}  // namespace mrroc::any_motion
