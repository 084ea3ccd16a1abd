#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <vector>

namespace weft {

/// A small surface that repeats in x and y, with its reflectance: what BtfBaker ray-traces.
///
/// Sample (column, row) lies at x = (column + 1/2) spacing, y = -(row + 1/2) spacing: x to the
/// right, y up, row 0 at the top, as in an image. z = 0 is the plane on which texels lie. Between
/// samples the surface is made of flat facets.
struct HeightField {
  struct Sample {
    float height = 0.0f;     ///< along z, in the unit of `spacing`
    glm::vec3 albedo{1.0f};  ///< linear RGB of the diffuse reflection
    /// weight of the specular lobe; specular + albedo <= 1 in every channel
    float specular = 0.0f;
    float roughness = 0.5f;  ///< GGX alpha of the specular lobe, 0.05..1
  };

  HeightField(int columnCount, int rowCount, float sampleSpacing);

  int columns = 0;
  int rows = 0;
  float spacing = 1.0f;         ///< between samples, in any unit
  std::vector<Sample> samples;  ///< `[row][column]`

  Sample& at(int column, int row) { return samples[index(column, row)]; }
  const Sample& at(int column, int row) const { return samples[index(column, row)]; }
  /// The same, with columns and rows that wrap around.
  const Sample& atPeriodic(int column, int row) const;

  float lowest() const;
  float highest() const;
  /// Moves the surface along z so that its mean height is 0.
  void centre();

 private:
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

}  // namespace weft
