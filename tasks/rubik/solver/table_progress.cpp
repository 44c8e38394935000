#include "tasks/rubik/solver/table_progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include "base/print.hpp"

namespace mrroc::rubik {

TableProgress::TableProgress(std::FILE* stream)
    : stream_(stream), terminal_(::isatty(::fileno(stream)) == 1) {}

TableWatch TableProgress::watch() {
  return {[this](std::string_view table, double part) { show(table, part); },
          [this](const std::string& text) { print(stream_, text + "\n"); }};
}

void TableProgress::show(std::string_view table, double part) {
  using std::chrono::steady_clock;
  const std::lock_guard guard(mutex_);
  if (part <= 0) {
    begin_ = steady_clock::now();
    shown_ = -1;
    announced_ = false;
  }
  const double seconds = std::chrono::duration<double>(steady_clock::now() - begin_).count();
  const int percent = static_cast<int>(100 * part);
  if (part >= 1 && (terminal_ || announced_)) {
    print(stream_, fmt::format("{}table {} made in {:.1f} s\n", terminal_ ? "\r" : "", table, seconds));
  } else if (terminal_ && percent > shown_) {
    print(stream_, fmt::format("\rmaking table {} ... {} % ", table, percent));
    shown_ = percent;
  } else if (!terminal_ && !announced_ && seconds > 1) {
    print(stream_, fmt::format("making table {} ...\n", table));
    announced_ = true;
  }
}

}  // namespace mrroc::rubik
