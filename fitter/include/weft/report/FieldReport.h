#pragma once

#include <filesystem>
#include <string>

#include "weft/core/Result.h"
#include "weft/evaluation/FieldEvaluation.h"
#include "weft/report/HtmlReport.h"

namespace weft {

/// "0.0123 min .. max" of every space and measure as rows of a table.
ReportTable errorTable(const FitErrors& errors, std::string caption);

/// The report of weft-fit and weft-eval: errors, where they are, and some pictures beside the
/// measured ones.
Result<void> writeFieldReport(const ReflectanceField& field, const FieldEvaluation& evaluation,
                              const std::filesystem::path& path);

}  // namespace weft
