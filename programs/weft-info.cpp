#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "MeasurementInput.h"
#include "ModelArguments.h"
#include "info/SceneDescription.h"
#include "weft/core/FileKind.h"
#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/measurement/BtfSource.h"
#include "weft/reflectance/FieldTextures.h"
#include "weft/reflectance/MapTextures.h"
#include "weft/tool/Tool.h"

namespace {

using Json = nlohmann::ordered_json;

Json describe(const weft::BtfDescription& btf) {
  return {{"kind", "btf"},
          {"name", btf.name},
          {"width", btf.width},
          {"height", btf.height},
          {"views", btf.views.size()},
          {"lights", btf.lights.size()},
          {"encoding", weft::name(btf.encoding)},
          {"has_cosine", btf.cosineInData}};
}

Json describe(const weft::ReflectanceField& field) {
  const weft::ReflectanceFieldDescription& description = field.description();
  Json model;
  weft::addModel(model, "name", field.model().description());
  model["shared_channels"] = field.shared().channels();
  model["layer_channels"] = field.layers().channels();
  for (const auto& [name, table] : field.tables()) model["tables"].push_back(name);
  if (const weft::Registration& registration = field.model().registration(); !registration.empty())
    model["relief_height"] = registration.height;  // in texels
  return {{"kind", "reflectance field"},
          {"name", description.source},
          {"width", field.width()},
          {"height", field.height()},
          {"levels", field.levels().size()},
          {"views", field.description().views.size()},
          {"lights", description.lights.size()},
          {"encoding", weft::name(description.encoding)},
          {"has_cosine", description.hasCosine},
          {"precision", field.shared().precision() == weft::Precision::Half ? "half" : "float"},
          {"model", model},
          {"fit", description.fitReport.empty() ? Json() : Json::parse(description.fitReport)}};
}

Json describe(const weft::CoordinateMap& map) {
  return {{"kind", "coordinate map"},
          {"name", map.sampleName()},
          {"width", map.width()},
          {"height", map.height()},
          {"sample", {{"width", map.sampleWidth()}, {"height", map.sampleHeight()}}}};
}

weft::Result<Json> describeFile(const weft::Tool& tool, const std::filesystem::path& file,
                                const weft::BtfOptions& options) {
  Json json;
  Json bytes = Json::object();
  const weft::FileKind kind = weft::fileKind(file);
  if (kind == weft::FileKind::Glb || kind == weft::FileKind::Json) {
    WEFT_TRY(json, weft::describeScene(file));
    for (const Json& warning : json["warnings"])
      tool.warn(fmt::format("{}: {}", file.string(), warning.get<std::string>()));
  } else if (weft::isCoordinateMap(file)) {
    WEFT_TRY(const weft::CoordinateMap map, weft::readCoordinateMap(file));
    json = describe(map);
    bytes["gpu"] = weft::packCoordinates(map).byteCount();
  } else if (file.extension() == ".exr" || kind == weft::FileKind::Exr) {
    WEFT_TRY(const weft::ReflectanceField field, weft::readReflectanceField(file));
    json = describe(field);
    bytes["gpu"] = weft::gpuBytes(field);
  } else {
    WEFT_TRY(const std::unique_ptr<weft::BtfSource> btf, weft::openBtf(file, options));
    weft::tellWarnings(tool, file, btf->description());
    json = describe(btf->description());
  }
  if (Json size = weft::fileBytes(file); !size.is_null()) bytes["file"] = std::move(size);
  json["bytes"] = bytes;
  return json;
}

// "model.name  rfnl": one line a value, names joined by dots; of a list of objects each by its
// number, other lists in brackets.
std::string linesOf(const Json& json, const std::string& prefix) {
  std::string lines;
  for (const auto& [key, value] : json.items()) {
    const std::string name = prefix + key;
    if (value.is_object() || (value.is_array() && !value.empty() && value[0].is_object()))
      lines += linesOf(value, name + ".");
    else
      lines += fmt::format("{:<24} {}\n", name, value.is_string() ? value.get<std::string>() : value.dump());
  }
  return lines;
}

}  // namespace

int main(int argc, char** argv) {
  weft::Tool tool(
      {"weft-info",
       "Says what a measured BTF, a fitted reflectance field, a coordinate map or a glTF scene is.",
       "weft-info wool.rf.exr --json -"});
  std::filesystem::path file;
  weft::BtfOptions options;
  tool.options()
      .add_option("FILE", file,
                  fmt::format("{}, or a .rf.exr, .coords.exr, .gltf or .glb", weft::kMeasurementHelp))
      ->required();
  weft::addMeasurementOptions(tool.options(), options);
  return tool.run(argc, argv, [&]() -> weft::Result<weft::ExitCode> {
    WEFT_TRY(Json json, describeFile(tool, file, options));
    WEFT_TRY_VOID(tool.writeJson(json));
    json.erase("warnings");  // told already
    tool.print(linesOf(json, ""));
    return weft::ExitCode::Done;
  });
}
