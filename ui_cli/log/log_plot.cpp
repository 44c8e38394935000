#include "ui_cli/log/log_plot.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <sstream>

#include "base/fault.hpp"
#include "base/text_file.hpp"
#include "ui_cli/log/log_csv.hpp"
#include "ui_cli/log/subprocess.hpp"

namespace mrroc::ui {
namespace {

namespace fs = std::filesystem;

/// One kind of picture: fields of a channel of each arm, all in one chart.
struct Subject {
  std::string name;
  std::string channel;  ///< behind "ARM."
  std::vector<std::string> fields;
  std::vector<std::string> titles;  ///< of the columns behind t
  std::string axis;
  double scale;
  std::string style;
};

const std::array<Subject, 4>& subjects() {
  static const std::array<Subject, 4> all{{
      {"force", "report", {"F_a"}, {"F_x", "F_y", "F_z"}, "force in E [N]", 1, "lines lw 1.4"},
      {"pose", "report", {"T_0E"}, {"x", "y", "z"}, "E in the base [mm]", 1e3, "lines lw 1.4"},
      {"motors",
       "reply",
       {"motors"},
       {"1", "2", "3", "4", "5", "6", "7", "8"},
       "motors [rad]",
       1,
       "lines lw 1.4"},
      {"behaviours", "report", {"m"}, {"m"}, "behaviour m", 1, "steps lw 1.6"},
  }};
  return all;
}

const Subject& subject(const std::string& name) {
  for (const Subject& s : subjects())
    if (s.name == name) return s;
  throw FaultError(FaultCode::bad_usage, fmt::format("there is no plot '{}'", name),
                   "plots: force, pose, motors, behaviours");
}

/// As gnuplot's single quotes take it; what would end the line becomes a question mark.
std::string quoted(const std::string& text) {
  std::string all = "'";
  for (const char c : text)
    all += c == '\'' ? std::string("''") : std::string(1, c == '\n' || c == '\r' ? '?' : c);
  return all + "'";
}

/// @param block  name of the data block: that of an arm may be more than gnuplot's names can hold
std::string chart(const RunRecord& run, const Subject& s, const std::string& arm, const std::string& block) {
  std::ostringstream table;
  write_channel(run, arm + "." + s.channel, s.fields, false, table);
  // In the script itself, so that the picture can be drawn again from one file.
  std::string text = fmt::format("${} << EOD\n{}EOD\nset title {} noenhanced\nset ylabel '{}'\nplot ", block,
                                 table.str(), quoted(arm), s.axis);
  for (std::size_t k = 0; k < s.titles.size(); ++k)
    text += fmt::format("{}${} skip 1 using 1:(${}*{}) with {} title '{}'", k > 0 ? ", " : "", block, k + 2,
                        s.scale, s.style, s.titles[k]);
  return text + "\n";
}

}  // namespace

const std::vector<std::string>& plot_subjects() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all;
    for (const Subject& s : subjects()) all.push_back(s.name);
    return all;
  }();
  return names;
}

fs::path plot_run(const RunRecord& run, const std::string& what, const fs::path& output) {
  const Subject& s = subject(what);
  const auto arms = run.arms();
  if (arms.empty()) throw FaultError(FaultCode::bad_log, "the log tells of no arm");
  const fs::path picture =
      fs::absolute(output.empty() ? run.folder() / "plots" / fmt::format("log-{}.png", what) : output);
  if (picture.extension() != ".png")
    throw FaultError(FaultCode::bad_usage, fmt::format("{} is no name of a PNG picture", picture.string()),
                     "give it a name that ends in .png; the script beside it draws other formats");
  if (!output.empty() && !fs::is_directory(picture.parent_path()))
    throw FaultError(FaultCode::bad_usage,
                     fmt::format("there is no folder {}", picture.parent_path().string()),
                     "make it, or give --output another name");
  fs::path script = picture;
  script.replace_extension(".gp");
  std::string text = fmt::format(
      "set terminal pngcairo size 1000,{} font 'sans,12' background rgb 'white'\nset output {}\n"
      "set datafile separator ','\nset border 3\nset tics nomirror\nset grid lc rgb '#e4e8ee'\n"
      "set key outside right\nset xlabel 't [s]'\nset multiplot layout {},1\n",
      120 + 400 * arms.size(), quoted(picture.filename().string()), arms.size());
  for (std::size_t k = 0; k < arms.size(); ++k) text += chart(run, s, arms[k], fmt::format("table{}", k + 1));
  std::error_code ignored;
  fs::create_directories(picture.parent_path(), ignored);
  write_text_file(script, text + "unset multiplot\n");
  const Finished drawn = run_program("gnuplot", {script.filename().string()}, picture.parent_path());
  if (drawn.status == 0 && fs::exists(picture)) return picture;
  throw FaultError(
      FaultCode::cannot_write,
      drawn.status == -1 ? "gnuplot is not installed" : fmt::format("gnuplot ended with {}", drawn.status),
      drawn.status == -1 ? "apt-get install gnuplot-nox" : fmt::format("look at {}", script.string()));
}

}  // namespace mrroc::ui
