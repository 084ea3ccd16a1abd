#include "ViewLoading.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "weft/fitter/DefaultModel.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/materials/BTFMap.h"
#include "weft/reflectance/FieldTextures.h"

namespace weft {
namespace {

/// Bytes of a measurement that is kept in memory.
constexpr std::size_t kReadWhole = std::size_t{3} << 29;
constexpr std::size_t kFitMemory = std::size_t{1} << 30;
constexpr std::size_t kLongFit = std::size_t{64} << 20;  // bytes beyond which a part is shown first
constexpr int kPartSide = 32;                            // texels of that part, of several views
constexpr int kPartSideOfOneView = 256;
constexpr const char* kModelOfPart = "rfp";
constexpr float kTexelsOnShape = 768.0f;  // across a unit of a shape's texture coordinates
constexpr float kTexelsOnPlane = 192.0f;

std::string errorOf(const ReflectanceField& field) {
  const auto report = nlohmann::json::parse(field.description().fitReport, nullptr, false);
  const auto at = nlohmann::json::json_pointer("/epsilon/stored/luminance");
  if (report.is_discarded() || !report.contains(at)) return {};
  const auto& eps = report.at(at);
  const auto number = [&](const char* name) {
    return eps.contains(name) && eps.at(name).is_number() ? eps.at(name).get<double>() : 0.0;
  };
  return fmt::format("eps {:.4f} ({:.4f} to {:.4f})", number("avg"), number("min"), number("max"));
}

bool isOneView(const ReflectanceField& field) {
  return field.description().views.size() <= 1;
}

/// The shape that suits what is shown alone: a photograph's plane for one view, else a cloth.
std::string shapeOf(const ViewRequest& request, bool oneView) {
  if (!request.shape.empty()) return request.shape;
  return oneView ? "plane" : "cloth";
}

/// Repetitions of so many texels across that show texels of a sensible size.
float suitingScale(const std::string& shape, bool oneView, float width) {
  if (shape == "plane" && oneView) return 1.0f;
  return std::max(1.0f, std::round((shape == "plane" ? kTexelsOnPlane : kTexelsOnShape) / width));
}

FitOptions optionsFor(const ModelType& type, const std::optional<Crop>& crop) {
  FitOptions options;
  options.model.name = type.name;
  options.cosineInModel = type.fitsStoredValues;
  options.space = type.fitsStoredValues ? FitSpace::Stored : FitSpace::Linear;
  options.memory = kFitMemory;
  options.crop = crop;
  return options;
}

/// The middle of a measurement, of its shape.
Crop middleOf(const BtfDescription& measured) {
  const int side = measured.views.size() > 1 ? kPartSide : kPartSideOfOneView;
  const int longer = std::max(measured.width, measured.height);
  const int width = std::max(1, measured.width * std::min(side, longer) / longer);
  const int height = std::max(1, measured.height * std::min(side, longer) / longer);
  return {(measured.width - width) / 2, (measured.height - height) / 2, width, height};
}

std::size_t bytesOf(const BtfDescription& measured) {
  return measured.rowBytes() * static_cast<std::size_t>(measured.height);
}

}  // namespace

void ViewLoading::run() {
  doing(fmt::format("reading {}", request_.file.filename().string()));
  Result<LoadedView> view = fail("nothing was asked for");
  try {
    switch (request_.kind()) {
      case ViewedKind::Scene:
      case ViewedKind::Environment:
        view = loadScene();
        break;
      case ViewedKind::Field:
        view = loadField();
        break;
      case ViewedKind::Measurement:
        view = fitMeasurement();
    }
  } catch (const std::bad_alloc&) {
    view = fail("out of memory", request_.file.string());
  } catch (const std::exception& error) {
    view = fail(error.what(), request_.file.string());
  }
  listener_.loaded(std::move(view));
}

Result<LoadedView> ViewLoading::loadScene() {
  SceneOptions options = request_.scene;
  options.scene = request_.file.string();
  BTFMaterialOptions btf = options.btf;
  btf.doubleSided = options.scene.starts_with("shape:");
  std::vector<LoadedView::Field> fields;
  for (const auto& [name, file] : options.materialFiles) {
    WEFT_TRY(ReflectanceField field, readReflectanceField(file, options.models));
    WEFT_TRY(auto wrapped, wrap(name, std::make_shared<ReflectanceField>(std::move(field)), btf));
    fields.push_back(std::move(wrapped));
  }
  const auto files = std::exchange(options.materialFiles, {});
  WEFT_TRY(LoadedView view, assemble(std::move(options), std::move(fields)));
  for (const auto& [name, file] : files) view.files.emplace_back(file);
  return view;
}

Result<LoadedView> ViewLoading::loadField() {
  WEFT_TRY(ReflectanceField field, readReflectanceField(request_.file, request_.scene.models));
  const auto width = static_cast<float>(field.width());
  return showAlone(std::make_shared<ReflectanceField>(std::move(field)), width);
}

Result<LoadedView> ViewLoading::fitMeasurement() {
  WEFT_TRY(const std::unique_ptr<BtfSource> opened, openBtf(request_.file, request_.measurement));
  const BtfDescription measured = opened->description();
  std::unique_ptr<RawBtf> whole;
  if (bytesOf(measured) <= kReadWhole) {
    WEFT_TRY(RawBtf read, RawBtf::read(*opened));
    whole = std::make_unique<RawBtf>(std::move(read));
  }
  const BtfSource& source = whole ? static_cast<const BtfSource&>(*whole) : *opened;
  if (listener_.stopped()) return fail("it was given up", request_.file.string());
  if (bytesOf(measured) > kLongFit) {
    const Crop middle = middleOf(measured);
    const std::string model = measured.views.size() > 1 ? kModelOfPart : defaultModel(measured).name;
    if (auto part = fit(source, model, middle)) {
      part->isPart = true;
      listener_.loaded(std::move(part));
    }
  }
  const std::string model = request_.model.empty() ? defaultModel(measured).name : request_.model;
  WEFT_TRY(LoadedView view, fit(source, model, {}));
  for (const std::string& warning : measured.warnings) view.warnings.push_back(warning);
  return view;
}

Result<LoadedView> ViewLoading::fit(const BtfSource& source, const std::string& model,
                                    const std::optional<Crop>& crop) {
  WEFT_TRY(const ModelType type, request_.scene.models.find(model));
  FitOptions options = optionsFor(type, crop);
  options.stopped = listener_.stopped;
  const std::string what = crop ? "a first look: fitting " + model : "fitting " + model;
  WEFT_TRY(FitResult result, fitReflectanceField(source, options, [&](double share) {
             doing(fmt::format("{}, {:.0f} %", what, 100.0 * share));
           }));
  WEFT_TRY(LoadedView view, showAlone(std::make_shared<ReflectanceField>(std::move(result.field)),
                                      static_cast<float>(source.description().width)));
  view.model = model;
  return view;
}

Result<LoadedView> ViewLoading::showAlone(std::shared_ptr<const ReflectanceField> field, float wholeWidth) {
  const bool oneView = isOneView(*field);
  const std::string shape = shapeOf(request_, oneView);
  SceneOptions options = request_.scene;
  options.scene = "shape:" + shape;
  options.materialFiles.clear();
  options.btf.doubleSided = true;
  const bool wholePlane = shape == "plane" && oneView;
  const float scale = request_.uvScale.value_or(suitingScale(shape, oneView, wholeWidth));
  options.btf.textureScale =
      glm::vec2(wholePlane ? scale : scale * wholeWidth / static_cast<float>(field->width()));
  const BTFMaterialOptions btf = options.btf;
  WEFT_TRY(LoadedView::Field wrapped, wrap("*", std::move(field), btf));
  std::vector<LoadedView::Field> fields{std::move(wrapped)};
  WEFT_TRY(LoadedView view, assemble(std::move(options), std::move(fields)));
  view.shape = shape;
  view.fromFront = shape == "plane" && !request_.scene.viewpoint;
  return view;
}

Result<LoadedView::Field> ViewLoading::wrap(std::string name, std::shared_ptr<const ReflectanceField> field,
                                            const BTFMaterialOptions& options) const {
  const BTFTextures::FieldSource again = [field]() -> Result<ReflectanceField> { return *field; };
  WEFT_TRY(auto textures, BTFTextures::create(*field, options.preparedForEnvironments, again));
  WEFT_TRY(auto material, BTFMaterial::create(std::move(textures), options));
  if (const auto file = request_.scene.mapFiles.find(name); file != request_.scene.mapFiles.end()) {
    WEFT_TRY(const CoordinateMap map, readCoordinateMap(file->second));
    WEFT_TRY(auto prepared, BTFMap::create(map, *material->textures(), again));
    WEFT_TRY_VOID(material->setMap(std::move(prepared)));
  }
  return LoadedView::Field{std::move(name),      std::move(material), field,
                           options.textureScale, errorOf(*field),     gpuBytes(*field)};
}

Result<LoadedView> ViewLoading::assemble(SceneOptions options, std::vector<LoadedView::Field> fields) {
  for (const LoadedView::Field& field : fields) {
    options.materials[field.name] = field.material;
    options.mapFiles.erase(field.name);  // it has it
  }
  options.defaultLight = SceneOptions::DefaultLight::Lamp;
  WEFT_TRY(SceneSetup setup, SceneSetup::create(options));
  LoadedView view{request_, std::move(setup), std::move(fields)};
  view.warnings = view.setup.warnings();
  view.files = view.setup.scene().files;
  if (!request_.file.string().starts_with("shape:")) view.files.push_back(request_.file);
  if (std::filesystem::is_regular_file(options.environment)) view.files.emplace_back(options.environment);
  for (const auto& [name, map] : request_.scene.mapFiles) view.files.emplace_back(map);
  for (const GltfScene::FieldMaterial& own : view.setup.scene().fields) {
    WEFT_TRY(ReflectanceField field, readReflectanceField(own.file, options.models));
    auto shared = std::make_shared<const ReflectanceField>(std::move(field));
    const glm::vec2 scale = own.material->options().textureScale;
    view.fields.push_back({own.name, own.material, shared, scale, errorOf(*shared), gpuBytes(*shared)});
  }
  return view;
}

}  // namespace weft
