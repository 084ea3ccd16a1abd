#include "weft/report/Comparison.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <set>

#include "ComparisonFigures.h"
#include "weft/core/Direction.h"
#include "weft/evaluation/FieldEvaluation.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/report/FieldReport.h"

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

// "rfnl-2-per-view.rf.exr": numbers, and words that are not the standard.
std::string fileOf(const ModelDescription& model, const ModelType& type) {
  std::string name = model.name;
  for (const ModelOption& option : type.options)
    if (const OptionValue& value = model.options.at(option.name);
        option.words.empty() || value != option.standard)
      name += fmt::format("-{}", textOf(value));
  return name + ".rf.exr";
}

Result<ComparedModel> fitModel(const RawBtf& btf, FitOptions options, const ModelDescription& model,
                               const std::filesystem::path& folder, const Progress& progress) {
  options.model = model;
  WEFT_TRY(const ModelType type, options.models.find(model.name));
  WEFT_TRY(FitResult fit, fitReflectanceField(btf, options, progress));
  const std::string label = fit.field.model().options().label();
  const std::filesystem::path file = folder / fileOf(fit.field.model().description(), type);
  WEFT_TRY_VOID(writeReflectanceField(fit.field, file));
  const std::uint64_t gpu = gpuBytes(fit.field);
  std::error_code isNoFile;
  const std::uintmax_t bytes = std::filesystem::file_size(file, isNoFile);
  return ComparedModel{label, file.filename().string(), std::move(fit), isNoFile ? 0 : bytes, gpu, 0.0};
}

std::vector<std::string> epsCells(const FitErrors& errors) {
  std::vector<std::string> cells;
  for (const ErrorSpace space : {ErrorSpace::Stored, ErrorSpace::Linear}) {
    const ErrorStatistics& s = errors.of(space, ErrorMeasure::Luminance);
    for (const double value : {s.average, s.minimum, s.maximum})
      cells.push_back(fmt::format("{:.4f}", value));
  }
  for (const ErrorSpace space : {ErrorSpace::Stored, ErrorSpace::Linear})
    cells.push_back(fmt::format("{:.4f}", errors.of(space, ErrorMeasure::Rgb).average));
  cells.push_back(fmt::format("{:.4f}", errors.grazing));
  return cells;
}

ReportTable epsTable(std::string caption) {
  return {std::move(caption),
          {"model", "stored avg", "min", "max", "linear avg", "min", "max", "stored RGB", "linear RGB",
           "view >= 60°"},
          {}};
}

void addRow(ReportTable& table, const std::string& label, const std::vector<std::string>& cells) {
  table.rows.push_back({label});
  table.rows.back().insert(table.rows.back().end(), cells.begin(), cells.end());
}

void addErrors(HtmlReport& report, std::span<const ComparedModel> models) {
  report.heading("Errors");
  report.paragraph(
      "eps is the mean absolute difference over all pairs of view and light, for each texel (eq. 2 of Meseth "
      "et al. 2004); "
      "average, minimum and maximum are over texels, of luminance unless noted. Stored values are encoded as "
      "the measurement "
      "is; linear ones are proportional to light. The last column is stored luminance over the views at 60 "
      "degrees and lower.");
  ReportTable table =
      epsTable("eps of every model over the pairs that were fitted (the paper's table 1 for this material).");
  ReportTable heldOut = epsTable("The same over pairs whose view or light was held out of the fit.");
  for (const ComparedModel& model : models) {
    addRow(table, model.label, epsCells(model.fit.errors));
    if (model.fit.heldOut) addRow(heldOut, model.label, epsCells(*model.fit.heldOut));
  }
  report.table(table);
  if (!heldOut.rows.empty()) report.table(heldOut);
}

void addPapersTable(HtmlReport& report) {
  struct Row {
    const char* material;
    const char* of;
    std::array<double, 4> eps;
  };
  static constexpr std::array<Row, 15> kRows{{{"proposte", "avg", {.0978, .0794, .0689, .0736}},
                                              {"", "min", {.0645, .0537, .0514, .0490}},
                                              {"", "max", {.1149, .1003, .0829, .0924}},
                                              {"knitted wool", "avg", {.0788, .0693, .0719, .0582}},
                                              {"", "min", {.0570, .0527, .0592, .0459}},
                                              {"", "max", {.1056, .0875, .0857, .0729}},
                                              {"stone", "avg", {.0904, .0816, .0797, .0640}},
                                              {"", "min", {.0368, .0345, .0523, .0284}},
                                              {"", "max", {.1847, .1767, .1335, .1321}},
                                              {"corduroy", "avg", {.1114, .0859, .0513, .0537}},
                                              {"", "min", {.1003, .0761, .0416, .0437}},
                                              {"", "max", {.1223, .0948, .0604, .0639}},
                                              {"aluminium", "avg", {.0572, .0558, .0846, .0479}},
                                              {"", "min", {.0391, .0389, .0773, .0324}},
                                              {"", "max", {.0935, .0889, .0985, .0782}}}};
  ReportTable table{
      "The paper's own table 1 ([Meseth 2004] 2004; laf with four lobes, rfnl with two), of its own "
      "measurements at 256 x 256.",
      {"material", "of texels", "laf", "slaf", "rfp", "rfnl"},
      {}};
  for (const Row& row : kRows) {
    table.rows.push_back({row.material, row.of});
    for (const double eps : row.eps) table.rows.back().push_back(fmt::format("{:.4f}", eps));
  }
  report.table(table);
}

std::string megabytes(std::uint64_t bytes) {
  return fmt::format("{:.2f}", static_cast<double>(bytes) / 1e6);
}

void addCosts(HtmlReport& report, const RawBtf& btf, std::span<const ComparedModel> models) {
  report.heading("Costs");
  const double texels = static_cast<double>(btf.description().texels());
  ReportTable table{
      "Time and memory: the file as it lies on disk, and what it takes on the GPU in half precision.",
      {"model", "fit, s", "texels/s", "file, MB", "GPU, MB", "GPU, bytes a texel"},
      {}};
  for (const ComparedModel& model : models)
    table.rows.push_back({model.label, fmt::format("{:.2f}", model.fit.secondsFitting),
                          fmt::format("{:.0f}", texels / std::max(model.fit.secondsFitting, 1e-9)),
                          megabytes(model.fileBytes), megabytes(model.gpuBytes),
                          fmt::format("{:.0f}", static_cast<double>(model.gpuBytes) / texels)});
  const std::size_t raw = btf.description().rowBytes() * static_cast<std::size_t>(btf.description().height);
  table.rows.push_back({"the measurement", "", "", "", megabytes(raw),
                        fmt::format("{:.0f}", static_cast<double>(raw) / texels)});
  report.table(table);
  report.paragraph(
      "The paper: 8 s (2 lobes) and 143 s (10 lobes) a texel for laf, 2 s for its reflectance fields, on a 3 "
      "GHz "
      "Pentium 4; 365 MB for 256 x 256 texels and 81 views.");
  addSizePlot(report, btf, models);
}

// Where that is not the models' standard.
std::vector<ModelDescription> asInThePapers(const std::string& name) {
  if (name == "laf" || name == "slaf") return {{name, {{"lobes", 4}}}};
  if (name == "rfnl") return {{name, {}}, {name, {{"rho_d", "per-view"}}}};
  return {{name, {}}};
}

Json jsonOf(const ComparedModel& model) {
  const ModelDescription& description = model.fit.field.model().description();
  Json json = {{"label", model.label}, {"name", description.name}, {"file", model.file}};
  for (const auto& [name, value] : description.options)
    std::visit([&option = json[name]](const auto& plain) { option = plain; }, value);
  json.update(Json::parse(toJson(model.fit.errors, model.fit.heldOut)));
  json["bytes"] = {{"file", model.fileBytes}, {"gpu", model.gpuBytes}};
  json["seconds"] = {{"fit", model.fit.secondsFitting}};
  json["picture_difference"] = model.pictureDifference;
  return json;
}

Json jsonOf(const OneViewFit& fit) {
  const glm::dvec2 angles = degreesFromDirection(fit.view);
  return {{"view", {angles.x, angles.y}},
          {"label", fit.label},
          {"seconds", fit.seconds},
          {"bytes", {{"gpu", fit.gpuBytes}}},
          {"measured_lights", Json::parse(toJson(fit.errors))},
          {"lights_between", Json::parse(toJson(fit.errorsBetween))}};
}

}  // namespace

Result<std::vector<ModelDescription>> comparedModels(const std::vector<std::string>& names,
                                                     const std::map<std::string, OptionValue>& options,
                                                     const ModelRegistry& registry) {
  std::vector<ModelDescription> models;
  std::set<std::string> unused;
  for (const auto& [name, value] : options) unused.insert(name);
  for (const std::string& name : names) {
    WEFT_TRY(const ModelType type, registry.find(name));
    for (ModelDescription model : asInThePapers(name)) {
      for (const auto& [option, value] : options)
        if (std::ranges::find(type.options, option, &ModelOption::name) != type.options.end()) {
          model.options[option] = value;
          unused.erase(option);
        }
      WEFT_TRY(const auto created, registry.create(model));
      const ModelDescription& complete = created->description();
      if (std::ranges::find(models, complete) == models.end()) models.push_back(complete);
    }
  }
  if (!unused.empty())
    return fail(fmt::format("none of the models has an option '{}'", *unused.begin()), {},
                fmt::format("the models are {}", fmt::join(names, ", ")));
  return models;
}

Result<std::string> compareModels(const RawBtf& btf, const ComparisonOptions& options,
                                  const std::filesystem::path& folder,
                                  const std::function<Progress(const std::string& step)>& progress) {
  const BtfDescription& measured = btf.description();
  std::vector<ComparedModel> models;
  for (const ModelDescription& model : options.models) {
    WEFT_TRY(const auto named, options.fit.models.create(model));
    WEFT_TRY(ComparedModel fitted,
             fitModel(btf, options.fit, model, folder, progress("fitting " + named->options().label())));
    models.push_back(std::move(fitted));
  }

  HtmlReport report(fmt::format("{}: models compared", measured.name));
  const bool stored = options.fit.space == FitSpace::Stored;
  report.paragraph(fmt::format("{} x {} texels, {} views, {} lights. {}", measured.width, measured.height,
                               measured.views.size(), measured.lights.size(),
                               stored
                                   ? "Fitted to stored values as they are, like the paper's."
                                   : "Fitted to linear values, weighted as a display shows them; the models "
                                     "are multiplied by n.l."));
  addErrors(report, models);
  addPapersTable(report);
  WEFT_TRY_VOID(addErrorMaps(report, models));
  addCosts(report, btf, models);
  WEFT_TRY_VOID(addTexelFigure(report, btf, options.fit, models));
  WEFT_TRY_VOID(addClothPictures(report, btf, options.pictureSize, models));
  WEFT_TRY(const std::vector<OneViewFit> views, addSingleViews(report, btf, models));
  WEFT_TRY_VOID(report.write(folder / "index.html"));

  Json json = {{"source", measured.name},
               {"width", measured.width},
               {"height", measured.height},
               {"views", measured.views.size()},
               {"lights", measured.lights.size()}};
  for (const ComparedModel& model : models) json["models"].push_back(jsonOf(model));
  for (const OneViewFit& view : views) json["single_views"].push_back(jsonOf(view));
  return json.dump();
}

}  // namespace weft
