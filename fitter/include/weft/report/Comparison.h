#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "weft/core/Progress.h"
#include "weft/core/Result.h"
#include "weft/evaluation/RawBtf.h"
#include "weft/fitter/FieldFit.h"

namespace weft {

/// What is compared, and how large the pictures are.
struct ComparisonOptions {
  std::vector<ModelDescription> models;
  FitOptions fit;         ///< of every model; all texels of the measurement are fitted
  int pictureSize = 384;  ///< of the rendered cloths, pixels a side
};

/// Models by name as the papers compare them: laf and slaf with four lobes, rfnl and lfnl with two,
/// rfnl both with one diffuse albedo for all views and with one a view. `options` say otherwise,
/// for those models that have them. Fails on unknown names, values out of range and options that
/// none of the models has.
Result<std::vector<ModelDescription>> comparedModels(
    const std::vector<std::string>& names, const std::map<std::string, OptionValue>& options = {},
    const ModelRegistry& registry = ModelRegistry::builtin());

/// Fits every model and says, for one material, what the papers say of theirs: table 1 and figures
/// 1, 4 and 5 of [Meseth 2004], table 2 and figure 1 of [Bosserhoff 2003] (those of laf where it is
/// among the models).
///
/// Writes into an existing folder a `.rf.exr` a model and `index.html`, which needs nothing beside
/// it. Returns the numbers as JSON text. `progress` makes a Progress for each step that takes long.
Result<std::string> compareModels(const RawBtf& btf, const ComparisonOptions& options,
                                  const std::filesystem::path& folder,
                                  const std::function<Progress(const std::string& step)>& progress);

}  // namespace weft
