// The tables of a run folder, read and judged without the project's own code.
#pragma once
#include <array>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace mrroc::test {

using Row = std::vector<double>;

/// @return the rows of numbers of a table; the heading must be the given one @throws std::runtime_error
std::vector<Row> read_table(const std::filesystem::path& file, const std::string& heading);

inline const std::string kArmHeading = "i,t,m,x,y,z,ax,ay,az,Fx,Fy,Fz,Nx,Ny,Nz,gap,blocked";
inline const std::string kInkHeading = "stroke,t,x,y";

/// Columns of arm1.csv and arm2.csv.
inline constexpr int kI = 0, kT = 1, kM = 2, kX = 3, kY = 4, kZ = 5, kAx = 6, kAy = 7, kAz = 8, kFx = 9,
                     kFy = 10, kFz = 11;

/// First and last row, inclusive, of every stretch of rows with that m.
std::vector<std::pair<std::size_t, std::size_t>> stretches(const std::vector<Row>& arm, double m);

/// Mean and standard deviation of F_z in m = 5, without the first 0.2 s of each stroke [N].
std::pair<double, double> paper_force(const std::vector<Row>& arm);

/// Largest variation of z within a stretch of m = 7 [mm].
double travel_z(const std::vector<Row>& arm);

/// Macrostep of each stroke in which the pen has gone 1 mm over the paper.
std::vector<double> departures(const std::vector<Row>& arm);

/// Root mean square and largest distance of the ink's points from the nearest point of the other ink's lines,
/// whatever their strokes, nothing aligned [mm].
std::pair<double, double> distances(const std::vector<Row>& ink, const std::vector<Row>& other);

/// Number of strokes in a table of ink.
int strokes(const std::vector<Row>& ink);

}  // namespace mrroc::test
