// Reads a drawing from an SVG file.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "tasks/drawing/drawing.hpp"

namespace mrroc::drawing {

/// Larger files are refused before they are read [bytes].
inline constexpr std::size_t kMaxSvgBytes = 20'000'000;

/// Reads the outlines of an SVG document as strokes.
///
/// Drawn: path (all commands, absolute and relative), line, polyline, polygon, rect (with rounded corners),
/// circle, ellipse and what `use` refers to, under the transforms of all their ancestors. Every sub-path is a
/// stroke; a closed one ends where it began; a sub-path without extent is a dot; a bare "move to" draws
/// nothing, as in SVG. Fills, stroke widths and colours do not matter. Left out: what is defined but not
/// used, `display: none` and `visibility: hidden` (as attribute, in `style`, or by a simple selector of a
/// style sheet, see svg_style.hpp), and what has no outline, such as text and images.
///
/// Curves become polylines that stay within kFlatness of them. The result is scaled uniformly so that the
/// larger side of its bounding box is size_mm, and centred on the sheet; SVG's y, which points down, is
/// turned up. Units, page size and the outermost viewBox therefore have no effect.
///
/// @param text  the document; UTF-8, or UTF-16 or Latin-1 when it says so
/// @param name  the file's name for error messages
/// @param size_mm  larger side of the drawing [mm], above 0 and up to kSheetSize
/// @param ignored  if given, receives the elements that were left out for having no outline, "text (3)";
/// empty if there were none
/// @throws FileError  not well-formed, not SVG, nothing to draw, a bad value (the element and its line are
/// named), more than kMaxPoints points, a size out of range
[[nodiscard]] Drawing parse_svg(std::string_view text, const std::string& name, double size_mm = kDefaultSize,
                                std::string* ignored = nullptr);

/// Reads an SVG file, as parse_svg does.
/// @throws FileError  as parse_svg, and when the file is missing, empty, unreadable or over kMaxSvgBytes
[[nodiscard]] Drawing read_svg(const std::filesystem::path& file, double size_mm = kDefaultSize,
                               std::string* ignored = nullptr);

}  // namespace mrroc::drawing
