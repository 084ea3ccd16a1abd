#include "Cloth.h"

#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>

namespace weft {
namespace {

constexpr float kSide = 3.0f;
constexpr float kBallRadius = 0.6f;
constexpr float kFloor = -kBallRadius;
// kept between cloth and support, more than triangles cut corners
constexpr float kThickness = 0.012f;
constexpr int kCells = 64;
constexpr int kSteps = 480;
constexpr float kStep = 1.0f / 240.0f;  // seconds
constexpr float kGravity = 9.8f;
constexpr float kDamping = 1.2f;    // share of the velocity that the air takes in a second
constexpr float kFriction = 0.25f;  // share of the sliding that the support takes in a step

/// Vertices in a square, `side` a row.
struct Grid {
  int side;
  std::vector<glm::vec3> points;

  glm::vec3& at(int row, int column) {
    return points[static_cast<std::size_t>(row) * static_cast<std::size_t>(side) +
                  static_cast<std::size_t>(column)];
  }
  const glm::vec3& at(int row, int column) const { return const_cast<Grid*>(this)->at(row, column); }
};

/// Every pair of points this many rows and columns apart is held at its distance in the flat cloth.
struct Threads {
  int rows;
  int columns;
  float compliance;  // metres a newton, for particles of unit mass
};

// Threads across the square resist shear less, and those over two cells only keep it from creasing.
constexpr Threads kThreads[] = {{0, 1, 0.0f},   {1, 0, 0.0f},  {1, 1, 2e-5f},
                                {1, -1, 2e-5f}, {0, 2, 3e-4f}, {2, 0, 3e-4f}};

Grid flatCloth() {
  Grid cloth{kCells + 1, {}};
  for (int row = 0; row <= kCells; ++row)
    for (int column = 0; column <= kCells; ++column) {
      const float x = kSide * (static_cast<float>(column) / kCells - 0.5f);
      const float z = kSide * (static_cast<float>(row) / kCells - 0.5f);
      // Without some unevenness the folds would be as symmetric as the square.
      const float uneven = 0.02f * std::sin(3.1f * x + 1.7f * z) * std::cos(2.3f * z - 0.9f * x);
      cloth.points.emplace_back(x, kBallRadius + 0.05f + uneven, z);
    }
  return cloth;
}

/// One sweep of position-based dynamics over all threads of a kind (Macklin 2016, XPBD, one sweep a
/// step).
void pull(Grid& cloth, const Threads& threads) {
  const float cell = kSide / kCells;
  const float length =
      cell * std::hypot(static_cast<float>(threads.rows), static_cast<float>(threads.columns));
  const float share = 1.0f / (2.0f + threads.compliance / (kStep * kStep));
  const int firstColumn = threads.columns < 0 ? -threads.columns : 0;
  const int endColumn = cloth.side - (threads.columns > 0 ? threads.columns : 0);
  for (int row = 0; row + threads.rows < cloth.side; ++row)
    for (int column = firstColumn; column < endColumn; ++column) {
      glm::vec3& a = cloth.at(row, column);
      glm::vec3& b = cloth.at(row + threads.rows, column + threads.columns);
      const glm::vec3 offset = b - a;
      const float distance = glm::length(offset);
      if (distance < 1e-6f) continue;
      const glm::vec3 correction = share * (distance - length) / distance * offset;
      a += correction;
      b -= correction;
    }
}

/// Moves a point out of the ball and the floor; true where it touched.
bool liftOff(glm::vec3& point, float gap) {
  bool touched = false;
  if (point.y < kFloor + gap) {
    point.y = kFloor + gap;
    touched = true;
  }
  const float distance = glm::length(point);
  if (distance < kBallRadius + gap) {
    point *= (kBallRadius + gap) / distance;
    touched = true;
  }
  return touched;
}

Grid drape() {
  Grid cloth = flatCloth();
  std::vector<glm::vec3> velocities(cloth.points.size());
  for (int step = 0; step < kSteps; ++step) {
    const std::vector<glm::vec3> before = cloth.points;
    for (std::size_t i = 0; i < cloth.points.size(); ++i) {
      velocities[i].y -= kGravity * kStep;
      cloth.points[i] += kStep * velocities[i];
    }
    for (const Threads& threads : kThreads) pull(cloth, threads);
    for (std::size_t i = 0; i < cloth.points.size(); ++i) {
      glm::vec3& point = cloth.points[i];
      if (liftOff(point, kThickness)) point = before[i] + (1.0f - kFriction) * (point - before[i]);
      liftOff(point, kThickness);
      velocities[i] = (1.0f - kDamping * kStep) / kStep * (point - before[i]);
    }
  }
  return cloth;
}

/// Doubles the cells: the limit of repeating it is the cubic B-spline of the points, smooth enough
/// for highlights. The border keeps its own curve.
Grid subdivide(const Grid& coarse) {
  // One dimension at a time: old points become (1 6 1) / 8 of their neighbours, new ones the middle
  // of two.
  const auto refined = [](auto at, int last, int k) {
    if (k % 2 == 1) return 0.5f * (at(k / 2) + at(k / 2 + 1));
    if (k == 0 || k / 2 == last) return 1.0f * at(k / 2);
    return 0.125f * (at(k / 2 - 1) + 6.0f * at(k / 2) + at(k / 2 + 1));
  };
  const int last = coarse.side - 1;
  const int side = 2 * last + 1;
  std::vector<glm::vec3> wide;  // coarse rows, fine columns
  for (int row = 0; row <= last; ++row)
    for (int k = 0; k < side; ++k)
      wide.push_back(refined([&](int column) { return coarse.at(row, column); }, last, k));
  Grid fine{side, {}};
  for (int k = 0; k < side; ++k)
    for (int column = 0; column < side; ++column)
      fine.points.push_back(
          refined([&](int row) { return wide[static_cast<std::size_t>(row * side + column)]; }, last, k));
  return fine;
}

}  // namespace

std::vector<glm::vec3> dropCloth() {
  Grid cloth = subdivide(drape());
  for (glm::vec3& point : cloth.points) liftOff(point, 0.5f * kThickness);
  return cloth.points;
}

}  // namespace weft
