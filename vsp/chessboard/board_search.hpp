// Runs the stages (35)-(40) of the chain on one part of a picture. Only for the sources of this folder, the
// calibration and tests.
#pragma once
#include <vector>

#include "vsp/chessboard/inner_corners.hpp"

namespace mrroc::vsp::chessboard {

/// Region and settings of a search.
struct Search {
  int x{};              ///< left end of the part of the picture [pixel]
  int y{};              ///< its upper end [pixel]
  int width{};          ///< [pixel], > 0, inside of the picture
  int height{};         ///< [pixel], > 0, inside of the picture
  int scale{1};         ///< by which it is enlarged for the stages before the inner corners
  int block{};          ///< surroundings for the threshold [pixel of the enlarged part], odd
  int offset{};         ///< of the threshold [grey levels]
  WorkLimits limits{};  ///< of the part's search
};

/// Result of the chain.
struct SearchResult {
  std::vector<InnerCorners> boards;  ///< all that were found, in no order
  bool
      unresolved{};  ///< elsewhere in the picture there are many dark squares in a lattice, which may be a board
  std::size_t outlines{};  ///< of dark regions: how much there is to see in the picture

  /// @return whether there is one board and nothing that could be another
  [[nodiscard]] bool is_one() const { return boards.size() == 1 && !unresolved; }
};

/// Adds a board unless it is one of them already.
void add(std::vector<InnerCorners>& boards, const InnerCorners& board);

/// Runs the chain. Inner corners are located in the picture itself, not in the enlarged part.
/// @param grey  one channel
SearchResult find_boards(const cv::Mat& grey, const Search& search, const Board& board);

inline constexpr int kSmallSurroundings = 21;  ///< edge of those for the threshold [pixel], odd
/// @return edge of the large ones: an odd number, about an eighth of the picture's width, not below the small ones [pixel]
int large_surroundings(int width);

/// Runs the chain over the whole picture, with large and small surroundings for the threshold, then, in pictures of at
/// most kWidest pixels that show no noise or texture, over the picture enlarged; until one board is found and nothing
/// else that could be one.
/// @param known   what has been found before; is added to
/// @param offset  of the threshold [grey levels]
void find_everywhere(const cv::Mat& grey, const Board& board, int offset, std::vector<InnerCorners>& known);
inline constexpr int kWidest = 800;  ///< width of such a picture [pixel]

}  // namespace mrroc::vsp::chessboard
