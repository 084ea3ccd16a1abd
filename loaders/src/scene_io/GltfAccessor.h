#pragma once

#include <cstring>
#include <glm/mat4x4.hpp>
#include <optional>

#include "GltfFile.h"

namespace weft {

/// Which elements of accessors are read; none: all.
using ElementChoice = std::optional<std::vector<std::uint32_t>>;

/// An accessor as floats, `components` an element, sparse ones filled in; integers are normalised
/// where the file says so. The chosen elements must exist. Refuses values that are not finite.
Result<std::vector<float>> readFloats(const GltfFile& file, int accessor, std::size_t components,
                                      const ElementChoice& choice = {});

/// An accessor of whole numbers: vertex indices.
Result<std::vector<std::uint32_t>> readIndices(const GltfFile& file, int accessor);

/// How many numbers an element of an accessor has.
Result<std::size_t> componentsOf(const GltfFile& file, int accessor);

/// How many elements an accessor has; fails where they are not there.
Result<std::size_t> countOf(const GltfFile& file, int accessor);

/// Whether all numbers of a matrix are finite as floats.
bool isFinite(const glm::mat4& matrix);

/// An accessor of vectors (or, with 16 components, of matrices).
template <class Vector, std::size_t components = static_cast<std::size_t>(Vector::length())>
Result<std::vector<Vector>> readVectors(const GltfFile& file, int accessor,
                                        const ElementChoice& choice = {}) {
  WEFT_TRY(const std::vector<float> values, readFloats(file, accessor, components, choice));
  static_assert(sizeof(Vector) == components * sizeof(float));
  std::vector<Vector> vectors(values.size() / components);
  std::memcpy(static_cast<void*>(vectors.data()), values.data(), values.size() * sizeof(float));
  return vectors;
}

}  // namespace weft
