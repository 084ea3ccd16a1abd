#pragma once

#include <cstddef>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/evaluation/ErrorMeter.h"
#include "weft/evaluation/FitErrors.h"
#include "weft/measurement/BtfSource.h"
#include "weft/measurement/Crop.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// What was measured and what a field gives for one pair of directions: linear RGB, n.l included.
struct PairPictures {
  glm::vec3 view;
  glm::vec3 light;
  FloatImage measured;
  FloatImage model;
};

/// How well a field reproduces a measurement.
struct FieldEvaluation {
  FitErrors errors;                  ///< over the pairs that were fitted
  std::optional<FitErrors> heldOut;  ///< over the others, if there are any
  std::vector<SplitErrors> texels;   ///< row by row
  std::vector<PairPictures> pairs;   ///< a few, from the top to the lowest view
  /// Said where the errors are not those that the fit reported, so that this is another
  /// measurement, or other texels of it.
  std::optional<std::string> warning = {};
};

/// Compares a field with all pairs of a measurement, or of the part of it that `crop` names; its
/// rows are read in blocks within `memory` bytes, texels are compared in parallel. Fails where they
/// differ in size.
Result<FieldEvaluation> evaluateField(const ReflectanceField& field, const BtfSource& source,
                                      const std::optional<Crop>& crop, std::size_t memory,
                                      const Progress& progress = {});

/// One value a texel: eps of stored luminance ([Meseth 2004] eq. 2) over the pairs that were
/// fitted.
FloatImage errorMap(const std::vector<SplitErrors>& texels, int width, int height);

}  // namespace weft
