// Pieces of the line are divided where they bend most, always the one that bends most of all; ties go to the lower index.
#include "core/import/thin_line.h"

#include <algorithm>
#include <queue>
#include <set>

namespace bl::importing {

namespace {

// No survey of streets is finer [m].
constexpr double kNear = 0.01;

// A piece between two points that stay, and the point between them that lies farthest from the straight way.
struct Piece {
  std::size_t first = 0, last = 0, middle = 0;
  double aside = 0;
  bool operator<(const Piece& other) const { return aside != other.aside ? aside < other.aside : first > other.first; }
};

double distance_to(const Point3& p, const Point3& a, const Point3& b) {
  const Vector3 along = b - a;
  const double whole = squared_norm(along);
  const double share = whole > 0 ? std::clamp(dot(p - a, along) / whole, 0.0, 1.0) : 0;
  return distance(p, a + share * along);
}

Piece piece_between(const std::vector<Point3>& line, std::size_t first, std::size_t last) {
  Piece piece{first, last, first, 0};
  for (std::size_t i = first + 1; i < last; ++i)
    if (const double aside = distance_to(line[i], line[first], line[last]); aside > piece.aside)
      piece.aside = aside, piece.middle = i;
  return piece;
}

}  // namespace

ThinLine thin_line(const std::vector<Point3>& line, std::size_t most) {
  if (line.size() <= most + 2) return {line, 0};
  std::set<std::size_t> kept{0, line.size() - 1};
  std::priority_queue<Piece> pieces;
  pieces.push(piece_between(line, 0, line.size() - 1));
  while (kept.size() < most + 2 && pieces.top().aside > kNear) {
    const Piece piece = pieces.top();
    pieces.pop();
    kept.insert(piece.middle);
    pieces.push(piece_between(line, piece.first, piece.middle));
    pieces.push(piece_between(line, piece.middle, piece.last));
  }
  ThinLine thin{{}, pieces.top().aside};
  for (const std::size_t i : kept) thin.points.push_back(line[i]);
  return thin;
}

}  // namespace bl::importing
