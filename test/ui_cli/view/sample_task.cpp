#include "test/ui_cli/view/sample_task.hpp"

#include <cmath>
#include <fstream>

#include "mrroc/agent_order_t.hpp"
#include "mrroc/camera_frame_t.hpp"
#include "mrroc/effector_command_t.hpp"
#include "mrroc/step_samples_t.hpp"
#include "test/ui_cli/view/sample_run.hpp"

namespace mrroc::test {

SampleTask::SampleTask(const std::string& session, const std::filesystem::path& run) : session_(session) {
  std::filesystem::create_directories(run);
  std::ofstream(run / "config.toml") << sample_config();
  const auto address = link::address_for(session);
  file_ = std::make_unique<link::SessionFile>(link::SessionInfo{.name = session,
                                                                .id = link::random_id(),
                                                                .address = address,
                                                                .task = "sample",
                                                                .run_folder = std::filesystem::absolute(run),
                                                                .pid = 0});
  bus_ = link::open_session(file_->info());
  camera_ = std::make_unique<link::FrameWriter>(
      link::FrameStoreName{.session = session, .session_id = file_->info().id, .camera = "sac"},
      link::FrameStoreShape{.width = 320, .height = 240, .channels = 3});
}

void SampleTask::take_picture() {
  Image image(320, 240, 3);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) image.row(y)[3 * x + 1] = static_cast<std::uint8_t>((x + i_) % 256);
  const std::int64_t number = i_ / 2 + 1;
  camera_frame_t m{};
  m.step = 10 * i_;
  m.slot = camera_->write(number, m.step, 0.02 * static_cast<double>(i_), image.view());
  m.header = {file_->info().id, number, number};
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(link::encoded_size<camera_frame_t>()));
  m.encode(bytes.data(), 0, link::encoded_size<camera_frame_t>());
  bus_->publish({link::Group::agents, session_ + ".sac.frame"}, bytes);
}

template <class M>
void SampleTask::publish(const std::string& name, const M& m, std::int64_t number) {
  bus_->publish({link::Group::agents, session_ + "." + name}, encoded(m, number, i_, file_->info().id));
}

void SampleTask::step() {
  ++i_;
  if (i_ % 2 == 0) take_picture();
  const int m = i_ < kPerSecond ? 1 : 2;
  const double angle = 0.02 * static_cast<double>(i_);
  if (i_ % 5 == 1) publish("task_status", status(m, m == 1 ? "approach" : "draw"), i_ / 5 + 1);
  if (i_ == kPerSecond / 2) camera_->hide();  // the system has assembled
  publish("cube.truth", cube(i_), i_);
  if (i_ == 1) publish("mp.console", line("operator: start"), 1);
  for (const std::string arm : {"arm1", "arm2"}) {
    effector_reply_t r =
        reply(i_, 0.9 + 0.08 * std::cos(angle), 0.08 * std::sin(angle), m == 1 ? 0.95 : 0.9199);
    const double joints[8]{0, -1.43, 0.18, -0.32, 4.71, 1.57, 0, 0};
    const int track = arm == "arm2" ? 1 : 0;
    for (int k = 0; k < 7; ++k) r.joints[k + track] = joints[k];
    r.joints[track] = 0.1 * std::sin(angle);
    if (track) r.joints[0] = 0;
    publish(arm + ".order", agent_order_t{}, i_);
    publish(arm + ".command", effector_command_t{}, i_);
    publish(arm + ".reply", r, i_);
    publish(arm + ".report", report(m), i_);
    publish(arm + ".samples", step_samples_t{}, i_);
  }
}

}  // namespace mrroc::test
