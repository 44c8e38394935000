#include "mp/arm_trace.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "base/text_file.hpp"

namespace mrroc::mp {
namespace {

constexpr std::string_view kHeader = "i,t,m,x,y,z,ax,ay,az,Fx,Fy,Fz,Nx,Ny,Nz,gap,blocked";
constexpr std::size_t kMaxTraceBytes = 1'000'000'000;

}  // namespace

double largest_force(const ArmTrace& trace, Axis axis, std::initializer_list<int> m) {
  double largest = std::nan("");
  for (const ArmRow& row : trace)
    if (std::ranges::find(m, row.m) != m.end())
      largest = std::fmax(largest, row.F_most ? (*row.F_most)[axis] : row.F[axis]);
  return largest;
}

double mean_force(const ArmTrace& trace, Axis axis, int m, double last) {
  double end = 0;
  for (const ArmRow& row : trace)
    if (row.m == m) end = row.t;
  double sum = 0;
  int rows = 0;
  for (const ArmRow& row : trace) {
    if (row.m != m || row.t <= end - last) continue;
    sum += row.F[axis];
    ++rows;
  }
  return sum / rows;
}

void write_arm_trace(const std::filesystem::path& file, const ArmTrace& trace) {
  std::string text = fmt::format("{}\n", kHeader);
  for (const ArmRow& row : trace) {
    if (!std::isfinite(row.t) || !row.pose.allFinite() || !finite(row.F) || !std::isfinite(row.gap))
      throw FileError(file.string(), 0, fmt::format("macrostep {} has a number that is not finite", row.i),
                      "");
    text += fmt::format("{},{:.4f},{}", row.i, row.t, row.m);
    for (const double v : row.pose) text += fmt::format(",{:.7f}", v);
    for (const double v : row.F.v) text += fmt::format(",{:.4f}", v);
    text += fmt::format(",{:.5f},{}\n", row.gap, row.blocked ? 1 : 0);
  }
  write_text_file(file, text);
}

ArmTrace read_arm_trace(const std::filesystem::path& file) {
  const std::string text = read_text_file(file, kMaxTraceBytes);
  Lines lines(text, file.string());
  if (lines.next() != kHeader) lines.fail(fmt::format("the header is not '{}'", kHeader));
  ArmTrace trace;
  while (!lines.done()) {
    std::array<double, 17> v{};
    if (!lines.numbers(lines.next(), ',', v).empty()) lines.fail("more than 17 fields");
    ArmRow& row = trace.emplace_back();
    row.i = static_cast<std::int64_t>(v[0]);
    row.t = v[1];
    row.m = static_cast<int>(v[2]);
    row.pose = Eigen::Map<const Vector6>(&v[3]);
    std::copy_n(&v[9], 6, row.F.v.begin());
    row.gap = v[15];
    row.blocked = v[16] != 0;
  }
  return trace;
}

}  // namespace mrroc::mp
