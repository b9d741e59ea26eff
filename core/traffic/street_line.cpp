// Lengths are summed from the start on, so that the same points give the same bits everywhere.
#include "core/traffic/street_line.h"

#include <algorithm>
#include <cmath>

namespace bl::traffic {

namespace {

double plan_distance(const Point3& a, const Point3& b) {
  return std::sqrt((b.x - a.x) * (b.x - a.x) + (b.y - a.y) * (b.y - a.y));
}

// How far each point of a line is from its start, along it.
std::vector<double> ways_along(std::span<const Point3> line, double (*distance_of)(const Point3&, const Point3&)) {
  std::vector<double> ways(line.size(), 0);
  for (std::size_t i = 1; i < line.size(); ++i) ways[i] = ways[i - 1] + distance_of(line[i - 1], line[i]);
  return ways;
}

Point3 between(const Point3& a, const Point3& b, double share) { return a + share * (b - a); }

}  // namespace

std::vector<Point3> street_line(const Point3& start, std::span<const Point3> course, const Point3& end) {
  std::vector<Point3> line{start};
  line.insert(line.end(), course.begin(), course.end());
  line.push_back(end);
  const std::vector<double> ways = ways_along(line, plan_distance);
  const double whole = ways.back();
  for (std::size_t i = 1; i + 1 < line.size(); ++i)
    line[i].z = start.z +
                (whole > 0 ? ways[i] / whole : static_cast<double>(i) / static_cast<double>(line.size() - 1)) * (end.z - start.z);
  return line;
}

double street_length(const Point3& start, std::span<const Point3> course, const Point3& end) {
  if (course.empty()) return distance(start, end);
  return ways_along(street_line(start, course, end), distance).back();
}

std::vector<Point3> part_of_line(std::span<const Point3> line, double begin, double end) {
  if (line.empty()) return {};
  const std::vector<double> ways = ways_along(line, distance);
  const double from = std::clamp(begin, 0.0, 1.0) * ways.back(), to = std::clamp(end, 0.0, 1.0) * ways.back();
  std::vector<Point3> part{point_on_line(line, begin)};
  for (std::size_t i = 0; i < line.size(); ++i)
    if (ways[i] > from && ways[i] < to) part.push_back(line[i]);
  part.push_back(point_on_line(line, end));
  return part;
}

Point3 point_on_line(std::span<const Point3> line, double share) {
  if (line.empty()) return {};
  const std::vector<double> ways = ways_along(line, distance);
  const double wanted = std::clamp(share, 0.0, 1.0) * ways.back();
  const auto next = static_cast<std::size_t>(std::lower_bound(ways.begin(), ways.end(), wanted) - ways.begin());
  if (next == 0 || next >= line.size()) return next == 0 ? line.front() : line.back();
  return between(line[next - 1], line[next], (wanted - ways[next - 1]) / (ways[next] - ways[next - 1]));
}

}  // namespace bl::traffic
