#include "tasks/visual_servo/plots.hpp"

namespace mrroc::visual_servo {
namespace {

/// Columns of servo.csv; what is not of behaviour b is left out.
constexpr const char* kColumns =
    "error(k) = sqrt(column(6)**2 + column(7)**2 + column(8)**2)\n"
    "of(b, v) = column(3) == b ? v : NaN\n"
    "set key top right\nset xlabel 'control step'\n";

}  // namespace

std::vector<std::pair<std::string, std::string>> plots() {
  const std::string error =
      std::string(kColumns) +
      "set ylabel 'error [m]'\nset yrange [0:*]\nset y2range [0:1]\n"
      "plot 'servo.csv' skip 1 using 1:(column(3) == 0 ? 1 : 0) axes x1y2 with fillsteps lc rgb '#e4e7ec' "
      "title 'idle: no camera sees', for [b=1:3] 'servo.csv' skip 1 using 1:(of(b, error(0))) with points pt "
      "7 ps 0.8 "
      "lc rgb word('#1f5fa8 #2f8f4e #b3541e', b) title word('SAC EIH Composition', b)\n";
  const std::string truth =
      std::string(kColumns) +
      "set ylabel 'true error [mm]'\nset y2label 'of the orientation [deg]'\nset y2tics nomirror\n"
      "set logscale y\nset logscale y2\nset format y '%g'\nset format y2 '%g'\n"
      "plot 'servo.csv' skip 1 using 1:10 with lines lw 1.6 lc rgb '#1f5fa8' "
      "title 'position', 'servo.csv' skip 1 using 1:11 axes x1y2 with lines lw 1.6 "
      "lc rgb '#b3541e' title 'orientation (right)'\n";
  return {{"error", error}, {"true_error", truth}};
}

}  // namespace mrroc::visual_servo
