#include "FieldManifest.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "weft reflectance field";
constexpr int kVersion = 2;
constexpr const char* kColorSpace = "linear Rec. 709";
constexpr int kDeepestNesting = 32;  // JSON is destroyed and printed recursively
constexpr std::size_t kMostDirections = 65536;

const char* name(DiffuseAlbedo albedo) {
  return albedo == DiffuseAlbedo::Shared ? "shared" : "per-view";
}

Result<DiffuseAlbedo> diffuseAlbedoFromName(const std::string& text) {
  for (DiffuseAlbedo albedo : {DiffuseAlbedo::Shared, DiffuseAlbedo::PerView})
    if (text == name(albedo)) return albedo;
  return fail(fmt::format("the manifest has an unknown diffuse_albedo '{}'", text));
}

const char* name(FitColor color) {
  return color == FitColor::Luminance ? "luminance" : "rgb";
}

Result<FitColor> fitColorFromName(const std::string& text) {
  for (FitColor color : {FitColor::Luminance, FitColor::Rgb})
    if (text == name(color)) return color;
  return fail(fmt::format("the manifest has an unknown color '{}'", text));
}

// Throws on bad JSON.
Json parseJson(const std::string& text) {
  bool tooDeep = false;
  Json json = Json::parse(text, [&](int depth, Json::parse_event_t, const Json&) {
    tooDeep = tooDeep || depth > kDeepestNesting;
    return depth <= kDeepestNesting;
  });
  if (tooDeep) throw std::runtime_error("nested too deeply");
  return json;
}

// Doubles hold floats exactly, and are printed with as many digits as restore them.
Json toJson(const std::vector<glm::vec3>& directions) {
  Json json = Json::array();
  for (glm::vec3 d : directions) json.push_back({d.x, d.y, d.z});
  return json;
}

// Throws where the JSON is something else.
std::vector<glm::vec3> directionsFrom(const Json& json) {
  if (!json.is_array() || json.empty() || json.size() > kMostDirections)
    throw std::runtime_error("directions are not an array of unit vectors");
  std::vector<glm::vec3> directions;
  for (const Json& d : json) {
    if (!d.is_array() || d.size() != 3) throw std::runtime_error("a direction has not three numbers");
    directions.emplace_back(d[0].get<float>(), d[1].get<float>(), d[2].get<float>());
  }
  return directions;
}

Result<FieldManifest> manifestFrom(const Json& json) {
  if (json.at("format").get<std::string>() != kFormat) return fail("the manifest is of another format");
  if (const int version = json.at("version").get<int>(); version != kVersion)
    return fail(fmt::format("the file has format version {}, this Weft reads version {}", version, kVersion),
                {}, "use a newer Weft, or fit again");
  if (json.at("color_space").get<std::string>() != kColorSpace)
    return fail("the manifest names an unknown colour space");
  FieldManifest manifest;
  const Json& model = json.at("model");
  manifest.model.name = model.at("name").get<std::string>();
  manifest.model.lobes = model.at("lobes").get<int>();
  WEFT_TRY(manifest.model.diffuseAlbedo,
           diffuseAlbedoFromName(model.at("diffuse_albedo").get<std::string>()));
  WEFT_TRY(manifest.model.color, fitColorFromName(model.at("color").get<std::string>()));
  WEFT_TRY(manifest.field.encoding, encodingFromName(json.at("encoding").get<std::string>()));
  manifest.field.views = directionsFrom(json.at("views"));
  manifest.field.lights = directionsFrom(json.at("lights"));
  manifest.field.hasCosine = json.at("has_cosine").get<bool>();
  manifest.field.source = json.at("source").get<std::string>();
  if (!json.at("fit").is_null()) manifest.field.fitReport = json.at("fit").dump();
  return manifest;
}

}  // namespace

Result<std::string> FieldManifest::text() const {
  try {
    const Json fit = field.fitReport.empty() ? Json() : parseJson(field.fitReport);
    const Json json = {{"format", kFormat},
                       {"version", kVersion},
                       {"model",
                        {{"name", model.name},
                         {"lobes", model.lobes},
                         {"diffuse_albedo", name(model.diffuseAlbedo)},
                         {"color", name(model.color)}}},
                       {"color_space", kColorSpace},
                       {"encoding", name(field.encoding)},
                       {"has_cosine", field.hasCosine},
                       {"source", field.source},
                       {"fit", fit},
                       {"views", toJson(field.views)},
                       {"lights", toJson(field.lights)}};
    return json.dump();
  } catch (const std::exception& error) {
    return fail(std::string("the fit report is not JSON: ") + error.what());
  }
}

Result<FieldManifest> FieldManifest::parse(const std::string& text) {
  try {
    return manifestFrom(parseJson(text));
  } catch (const std::exception& error) {
    return fail(std::string("the manifest is damaged: ") + error.what());
  }
}

}  // namespace weft
