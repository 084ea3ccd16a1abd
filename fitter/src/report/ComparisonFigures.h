#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/evaluation/RawBtf.h"
#include "weft/fitter/FieldFit.h"
#include "weft/report/HtmlReport.h"

namespace weft {

/// One model of a comparison: its fit, and what that cost.
struct ComparedModel {
  std::string label;
  std::string file;  ///< beside the page
  FitResult fit;
  std::uint64_t fileBytes = 0;
  std::uint64_t gpuBytes = 0;
  double pictureDifference = 0.0;  ///< set by addClothPictures()
};

/// A fit of one view ([Bosserhoff 2003]), and its errors on the lights that were measured and on
/// others between them.
struct OneViewFit {
  glm::vec3 view;
  std::string label;
  double seconds = 0.0;
  std::uint64_t gpuBytes = 0;
  FitErrors errors;
  FitErrors errorsBetween;
};

/// Where the errors of each model are, on one scale.
Result<void> addErrorMaps(HtmlReport& report, std::span<const ComparedModel> models);

/// Errors against bytes.
void addSizePlot(HtmlReport& report, const RawBtf& btf, std::span<const ComparedModel> models);

/// The data of one texel and what models make of them ([Meseth 2004], fig. 1), with laf of 2 and 10
/// lobes where laf is among the models.
Result<void> addTexelFigure(HtmlReport& report, const RawBtf& btf, const FitOptions& options,
                            std::span<const ComparedModel> models);

/// A folded cloth with the measurement and with each model ([Meseth 2004], fig. 5), and how far
/// they are apart; where bump is among the models, also under low light beside reflectance fields
/// ([Meseth 2004], fig. 4).
Result<void> addClothPictures(HtmlReport& report, const RawBtf& btf, int size,
                              std::span<ComparedModel> models);

/// The measurement as a set of single views ([Bosserhoff 2003], table 2 and fig. 1): ptm, and laf
/// where it is among the models, also fitted to lights that are interpolated.
Result<std::vector<OneViewFit>> addSingleViews(HtmlReport& report, const RawBtf& btf,
                                               std::span<const ComparedModel> models);

}  // namespace weft
