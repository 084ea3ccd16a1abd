#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "weft/core/FloatImage.h"
#include "weft/core/Result.h"
#include "weft/report/HtmlReport.h"
#include "weft/synthesis/AppearanceVectors.h"
#include "weft/synthesis/SynthesisQuality.h"

namespace weft {

/// A map and what it is called.
struct NamedMap {
  std::string name;
  const CoordinateMap& map;
};

/// Seams and repetition of maps of one sample, a row each.
ReportTable synthesisTable(const AppearanceSample& sample, const std::vector<NamedMap>& maps);

/// The report of weft-synth: the sample, the sample tiled, and what was synthesised, side by side
/// for some views, and synthesisTable(). `pictures` are of the sample, `captions` say from where.
Result<void> writeSynthesisReport(const AppearanceSample& sample, const CoordinateMap& map,
                                  const std::vector<FloatImage>& pictures,
                                  const std::vector<std::string>& captions,
                                  const std::filesystem::path& path);

}  // namespace weft
