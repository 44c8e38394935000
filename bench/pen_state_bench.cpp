// The pen-state sensor over tremors, hands, papers and drawings: the whole task in one thread, many times.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "bench/figures.hpp"
#include "mp/gnuplot.hpp"
#include "tasks/drawing/results.hpp"
#include "test/tasks/drawing/driven_drawing.hpp"

namespace mrroc::bench {
namespace {

namespace fs = std::filesystem;

constexpr int kDrawings = 300;
constexpr int kProgress = 25;  // drawings between two lines
constexpr unsigned kSeed = 19;

/// One dimension of the sample.
struct Range {
  double least, most;
  bool logarithmic;

  [[nodiscard]] double at(double share) const {
    return logarithmic ? least * std::pow(most / least, share) : least + share * (most - least);
  }
};
constexpr std::array kRanges{Range{5e-5, 1e-3, false},  // tremor [m]
                             Range{4, 12, false},       // its frequency [Hz]
                             Range{300, 2000, false},   // stiffness of the hand [N/m]
                             Range{1e3, 1e5, true},     // of the paper [N/m]
                             Range{30, 100, false}};    // size of the drawing [mm]
using Sample = std::array<double, kRanges.size()>;

/// Latin hypercube: every dimension is cut in as many parts as there are samples, and each part is used once.
std::vector<Sample> samples(std::mt19937_64& random) {
  std::vector<Sample> all(kDrawings);
  std::uniform_real_distribution<> within;
  for (std::size_t d = 0; d < kRanges.size(); ++d) {
    std::vector<int> part(kDrawings);
    std::iota(part.begin(), part.end(), 0);
    std::ranges::shuffle(part, random);
    for (std::size_t k = 0; k < all.size(); ++k)
      all[k][d] = kRanges[d].at((part[k] + within(random)) / kDrawings);
  }
  return all;
}

/// Two to four strokes of up to three lines, or the arrow. @param size [mm]
drawing::Drawing some_drawing(std::mt19937_64& random, double size) {
  if (random() % 2 == 0) return drawing::fitted(drawing::arrow(), size);
  std::uniform_real_distribution<> place(-0.5, 0.5);
  drawing::Drawing strokes(2 + random() % 3);
  for (drawing::Stroke& stroke : strokes) {
    stroke.emplace_back(place(random), place(random));
    for (auto left = 1 + random() % 3; left > 0;) {
      const drawing::Point next(place(random), place(random));
      if ((next - stroke.back()).norm() < 0.2) continue;
      stroke.push_back(next);
      --left;
    }
  }
  return drawing::fitted(strokes, size);
}

/// What a drawing has come to.
struct Judged {
  bool failed{};
  double wrong{}, rms{}, most{}, other{};  // strokes, mm, mm, figures of the memory and of strokes lost
};

double worst(const std::map<std::string, mp::Figure>& figures, const char* key) {
  const mp::Figure& f = figures.at(key);
  if (const double* const one = std::get_if<double>(&f)) return *one;
  return std::ranges::max(std::get<std::vector<double>>(f));
}

double sum(const std::map<std::string, mp::Figure>& figures, const char* key) {
  const auto& values = std::get<std::vector<double>>(figures.at(key));
  return std::accumulate(values.begin(), values.end(), 0.0);
}

Judged judge(const test::DrivenDrawing& what) {
  const test::DrivenResult r = test::run(what);
  if (r.outcome != Outcome::terminated) return {.failed = true};
  const auto figures = drawing::figures_of(what.drawing, true, r.record, r.ink, {}, true);
  return {.wrong = sum(figures, "pen_state_wrong_strokes"),
          .rms = worst(figures, "copy_rms_mm"),
          .most = worst(figures, "copy_max_mm"),
          .other = sum(figures, "strokes_missing") + sum(figures, "strokes_extra") +
                   worst(figures, "doubtful_strokes")};
}

/// A map of the errors: frequency of the tremor over its size, papers by colour.
void plot(const fs::path& folder, const std::vector<Sample>& all, const std::vector<Judged>& judged) {
  fs::create_directories(folder);
  std::ofstream table(folder / "pen_state.csv");
  table << "tremor_mm,Hz,hand,paper,size,failed,wrong,copy_rms_mm\n";
  for (std::size_t k = 0; k < all.size(); ++k)
    table << fmt::format("{:.4f},{:.3f},{:.0f},{:.0f},{:.1f},{},{},{:.4f}\n", 1e3 * all[k][0], all[k][1],
                         all[k][2], all[k][3], all[k][4], judged[k].failed ? 1 : 0, judged[k].wrong,
                         judged[k].rms);
  table.close();
  const std::string bad = "($6>0||$7>0||$8>0.5)";
  std::ofstream(folder / "pen_state.gp")
      << "set terminal pngcairo size 1000,460 font 'sans,10'\nset output 'pen_state.png'\n"
         "set datafile separator ','\nset key off\nset multiplot layout 1,2\n"
         "set xlabel 'tremor, rms [mm]'\nset ylabel 'its frequency [Hz]'\nset logscale cb\n"
         "set cblabel 'worst copy [mm rms]'\nset title 'tremor (cross: wrong)'\n"
         "plot 'pen_state.csv' skip 1 using 1:2:8 with points pt 7 palette, '' skip 1 using (" +
             bad +
             "?$1:1/0):2 with points pt 2 ps 2 lc 'red'\n"
             "set logscale y\nset xlabel 'hand [N/m]'\nset ylabel 'paper [N/m]'\nset title 'stiffness'\n"
             "plot 'pen_state.csv' skip 1 using 3:4:8 with points pt 7 palette, '' skip 1 using (" +
             bad + "?$3:1/0):4 with points pt 2 ps 2 lc 'red'\nunset multiplot\n";
  if (mp::run_gnuplot(folder, "pen_state.gp") != mp::GnuplotResult::done)
    fmt::print(stderr, "pen_state.png was not drawn; see {}\n", (folder / "pen_state.csv").string());
}

}  // namespace

Figures run_pen_state_group(const fs::path& plots) {
  std::mt19937_64 random(kSeed);
  const std::vector<Sample> all = samples(random);
  std::vector<Judged> judged;
  for (const Sample& s : all) {
    test::DrivenDrawing what;
    what.hand.tremor = s[0];
    what.hand.tremor_frequency = s[1];
    what.hand.stiffness = s[2];
    what.paper.stiffness = s[3];
    what.drawing = some_drawing(random, s[4]);
    what.seed = judged.size() + 1;
    judged.push_back(judge(what));
    const Judged& j = judged.back();
    if (j.failed || j.wrong > 0 || j.other > 0 || j.rms > 0.5)
      fmt::print(stderr,
                 "pen_state: seed {}, tremor {:.2f} mm {:.1f} Hz, hand {:.0f}, paper {:.0f} N/m: {} wrong "
                 "strokes, copy "
                 "{:.3f} mm{}\n",
                 what.seed, 1e3 * s[0], s[1], s[2], s[3], j.wrong, j.rms, j.failed ? ", did not end" : "");
    if (judged.size() % kProgress == 0) fmt::print(stderr, "pen_state: {} of {}\n", judged.size(), kDrawings);
  }
  if (!plots.empty()) plot(plots, all, judged);
  const auto total = [&](auto what) {
    double t = 0;
    for (const Judged& j : judged) t += what(j);
    return t;
  };
  const auto most = [&](double Judged::*what) { return std::ranges::max(judged, {}, what).*what; };
  const std::string range = "tremors of 0.05-1 mm at 4-12 Hz, hands of 300-2000, papers of 1e3-1e5 N/m";
  return {
      {"pen_state_drawings", kDrawings, "", "taught and copied: " + range},
      {"pen_state_failed", total([](const Judged& j) { return j.failed; }), "",
       "that did not come to their end"},
      {"pen_state_wrong_strokes", total([](const Judged& j) { return j.wrong; }), "",
       "strokes of teach-in and copies whose pen state was not that of the ink, wanted 0"},
      {"pen_state_other", total([](const Judged& j) { return j.other; }), "",
       "strokes missing, extra or doubtful, wanted 0"},
      {"copy_rms_mm", most(&Judged::rms), "mm", "the worst copy against its taught ink, wanted <= 0.5"},
      {"copy_max_mm", most(&Judged::most), "mm", "the farthest point of all, wanted <= 1.5"},
  };
}

}  // namespace mrroc::bench
