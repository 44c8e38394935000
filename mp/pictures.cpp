#include "mp/pictures.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/text_file.hpp"
#include "mp/gnuplot.hpp"
#include "mp/print_line.hpp"

namespace mrroc::mp {

namespace fs = std::filesystem;

void draw(const fs::path& folder, const std::vector<std::pair<std::string, std::string>>& scripts,
          bool scripts_only) {
  std::error_code error;  // where it is not there, a script cannot be written: that is told
  fs::create_directories(folder / "plots", error);
  bool over = scripts_only;
  for (const auto& [name, text] : scripts) {
    const fs::path script = fs::path("plots") / (name + ".gp");
    write_text_file(folder / script,
                    fmt::format("# Run it in the run folder: gnuplot plots/{}.gp\n{}", name, text));
    if (over) continue;
    const GnuplotResult result = run_gnuplot(folder, script);
    if (result == GnuplotResult::failed)
      print_line(fmt::format("gnuplot could not draw {}.png; see plots/gnuplot.log", name));
    over = result == GnuplotResult::absent || result == GnuplotResult::stopped;
    if (over)
      print_line(result == GnuplotResult::absent
                     ? "gnuplot is not installed, so there are no pictures of the run"
                     : fmt::format("gnuplot was stopped: {}.png and what follows are not drawn", name));
  }
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> pictures;
  for (const fs::path& where : {folder, folder / "plots"}) {
    if (!fs::is_directory(where)) continue;
    const auto first = static_cast<std::ptrdiff_t>(pictures.size());
    for (const auto& entry : fs::directory_iterator(where))
      if (entry.path().extension() == ".png") pictures.push_back(entry.path());
    std::sort(pictures.begin() + first, pictures.end());
  }
  return pictures;
}

}  // namespace mrroc::mp
