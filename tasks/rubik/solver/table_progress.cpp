#include "tasks/rubik/solver/table_progress.hpp"

#include <fmt/core.h>
#include <unistd.h>

namespace mrroc::rubik {

TableProgress::TableProgress(std::FILE* stream)
    : stream_(stream), terminal_(::isatty(::fileno(stream)) == 1) {}

TableWatch TableProgress::watch() {
  return {[this](std::string_view table, double part) { show(table, part); },
          [this](const std::string& text) { fmt::print(stream_, "{}\n", text); }};
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
    fmt::print(stream_, "{}table {} made in {:.1f} s\n", terminal_ ? "\r" : "", table, seconds);
  } else if (terminal_ && percent > shown_) {
    fmt::print(stream_, "\rmaking table {} ... {} % ", table, percent);
    shown_ = percent;
  } else if (!terminal_ && !announced_ && seconds > 1) {
    fmt::print(stream_, "making table {} ...\n", table);
    announced_ = true;
  }
  std::fflush(stream_);
}

}  // namespace mrroc::rubik
