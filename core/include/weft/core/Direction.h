#pragma once

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>

namespace weft {

/// Unit vectors of the tangent frame: x = image columns to the right, y = image up (against the
/// rows), z = the normal.

/// (sin t cos p, sin t sin p, cos t) for the polar angle t and the azimuth p in degrees, as
/// measurements name directions.
glm::vec3 directionFromDegrees(double theta, double phi);

/// The polar angle and the azimuth (0 <= phi < 360) of a unit vector, in degrees; phi is 0 at the
/// pole.
glm::dvec2 degreesFromDirection(glm::vec3 direction);

/// The index of the direction at the smallest angle to `wanted`, the first of several; there must
/// be one.
std::size_t nearestDirection(std::span<const glm::vec3> directions, glm::vec3 wanted);

/// Parabolic (stereographic) coordinates (x, y) / (1 + z): the upper hemisphere fills the unit
/// disk. Needs z > -1.
glm::vec2 parabolicFromDirection(glm::vec3 direction);

/// The inverse: always a unit vector, for every p in the plane.
glm::vec3 directionFromParabolic(glm::vec2 p);

}  // namespace weft
