#include "edp/shell.hpp"

#include <algorithm>
#include <memory>
#include <span>
#include <string>

#include "edp/shell_impl.hpp"
#include "edp/step_record.hpp"
#include "mrroc/step_samples_t.hpp"

namespace mrroc::edp {
namespace {

/// Messages with samples that can be sent again: of the longest macrostep.
constexpr std::size_t kSampleMessages = ReplyBuilder::kMaxSamples / std::size(step_samples_t{}.sample) + 1;

/// Measurements of all steps, for virtual sensors.
class SampleStream {
 public:
  SampleStream(link::Process& process, const std::string& robot)
      : out_(process.outbox<step_samples_t, kSampleMessages>(robot + ".samples")) {}

  void send(const Driver& driver, const Moment& moment) {
    std::span<const MeasuredStep> left = driver.samples();
    do {
      step_samples_t m{};
      const std::span<const MeasuredStep> part = left.first(std::min(left.size(), std::size(m.sample)));
      left = left.subspan(part.size());
      for (const MeasuredStep& s : part) m.sample[m.n++] = to_message(s.sample());
      m.macrostep = moment.macrostep + (moment.waits ? 1 : 0);
      m.step = driver.reply().step - static_cast<std::int64_t>(left.size());
      m.more = moment.waits || !left.empty();
      m.last = left.empty() && moment.last;
      out_->publish(m, ++messages_);
    } while (!left.empty());
  }

 private:
  std::unique_ptr<link::Outbox<step_samples_t, kSampleMessages>> out_;
  std::int64_t messages_{};
};

struct ArmShell {
  using Effector = ArmEffector;
  using Driver = edp::Driver;
  using Format = StepFormat;
  using Stream = SampleStream;
  static constexpr std::string_view kSilence = "the arm comes to rest";
};

}  // namespace

void run_edp(link::Process& process, Driver& driver, AnyHardware hardware,
             const ShellParameters& parameters) {
  Shell<ArmShell>(process, driver, std::move(hardware), parameters, StepFormat(parameters.axes)).run();
}

}  // namespace mrroc::edp
