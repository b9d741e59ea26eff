// Shared by the importers of surroundings: frames, repaired rings, and heights where the file has none.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/import/context.h"

namespace bl::importing {

/// The frame of the options: of the scene where that has one, else about the origin of the options or `middle`.
/// `file_crs` empty: the file does not say; then the options have to.
Result<LocalFrame> context_frame(const ContextOptions& options, const std::string& file_crs, const std::array<double, 2>& middle);

/// The CRS of the options, else that of the file.
std::string context_crs(const ContextOptions& options, const std::string& file_crs);

/// Metres per unit of height: of the options, else of the file (0: it does not say), else of its CRS; told where it is not 1.
double context_height_unit(const ContextOptions& options, double file_unit, const std::string& file_crs,
                           std::vector<std::string>& notes);

/// A repaired ring: closing and repeated points dropped, spikes cut off, turned as wanted.
struct SoundRing {
  geometry::Ring ring;
  std::string mended;  ///< what was done that changes the corners: "3 repeated points"; empty: nothing
  std::string fault;   ///< why it cannot be taken; empty: it can
};
SoundRing sound_ring(std::vector<Point3> points, bool counter_clockwise);
/// Corners nearer than a millimetre to the one before are dropped, spikes without width cut off; how many of each.
struct RingCleaning {
  std::size_t repeated = 0, spikes = 0;
};
RingCleaning clean_corners(geometry::Ring& ring);

/// Is any corner within the radius of the options, and all of them within kContextExtent? Else the reason why not.
std::string out_of_reach(const ContextOptions& options, const std::vector<Point3>& points);

/// An outer ring with its holes: holes that cross it, lie outside it or in each other are reported in `dropped`.
void sort_holes(const geometry::Ring& outer, std::vector<geometry::Ring>& holes, std::string& dropped);

/// The largest number of corners of a body (a building, a plot), since triangulation is quadratic in the corners.
inline constexpr std::size_t kMostBodyCorners = 10000;
/// Why a body cannot be made of the outer ring, or nothing; surplus holes are left out and reported in `dropped`.
std::string limit_corners(const geometry::Ring& outer, std::vector<geometry::Ring>& holes, std::string& dropped);

/// Why a body cannot stand between these heights [m], or nothing.
inline constexpr double kLowestBase = -10000, kHighestTop = 100000;
std::string out_of_heights(double base, double height);

/// Gives buildings without a height that of their neighbours (median of at least three known ones), or the default, and notes
/// how many got which. Buildings are those whose height is 0.
void assume_heights(const ContextOptions& options, Context& context);

/// The middle of the box around those points that have a place; nothing where none has.
std::optional<std::array<double, 2>> place_of(const std::vector<Point3>& points);

/// The error of an importer that was stopped.
Error stopped_error();

/// The middle (median of x and of y) of points; nothing where there are none.
std::optional<std::array<double, 2>> middle_of(std::vector<std::array<double, 2>> points);

}  // namespace bl::importing
