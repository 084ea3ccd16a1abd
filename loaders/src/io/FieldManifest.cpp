#include "FieldManifest.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <utility>

namespace weft {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "weft reflectance field";
constexpr int kVersion = 3;
constexpr int kOldestVersion = 2;
constexpr const char* kColorSpace = "linear Rec. 709";
constexpr int kDeepestNesting = 32;  // JSON is destroyed and printed recursively
constexpr std::size_t kMostLevels = 32;
constexpr std::size_t kMostDirections = 65536;

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

// Throws where the JSON is something else, or no option has such a value.
OptionValue optionFrom(const std::string& name, const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  if (!json.is_number_integer() || json.get<std::int64_t>() != json.get<std::int32_t>())
    throw std::runtime_error(fmt::format("the option '{}' is neither a word nor a whole number", name));
  return json.get<int>();
}

// Version 2 has the same three options for all models, whether a model has them or not.
Result<ModelDescription> modelOfVersion2(const Json& json, const ModelRegistry& models) {
  struct Option {
    const char* key;
    const char* name;
    std::vector<std::string> words;
  };
  const Option options[] = {{"lobes", "lobes", {}},
                            {"diffuse_albedo", "rho_d", {"shared", "per-view"}},
                            {"color", "color", {"luminance", "rgb"}}};
  ModelDescription model{.name = json.at("name").get<std::string>()};
  WEFT_TRY(const ModelType type, models.find(model.name));
  for (const auto& [key, option, words] : options) {
    const OptionValue value = optionFrom(key, json.at(key));
    if (!words.empty() && std::ranges::find(words, textOf(value)) == words.end())
      return fail(fmt::format("the manifest has an unknown {} '{}'", key, textOf(value)));
    if (std::ranges::find(type.options, option, &ModelOption::name) != type.options.end())
      model.options[option] = value;
  }
  return model;
}

ModelDescription modelFrom(const Json& json) {
  ModelDescription model{.name = json.at("name").get<std::string>()};
  const Json& options = json.at("options");
  if (!options.is_object()) throw std::runtime_error("the options of the model are not an object");
  for (const auto& [name, value] : options.items()) model.options[name] = optionFrom(name, value);
  return model;
}

// Throws where the JSON is something else.
std::vector<FieldManifest::Size> levelsFrom(const Json& json) {
  if (!json.is_array() || json.empty() || json.size() > kMostLevels)
    throw std::runtime_error("the levels are not a list of sizes");
  std::vector<FieldManifest::Size> levels;
  for (const Json& level : json)
    levels.push_back({level.at("width").get<int>(), level.at("height").get<int>()});
  return levels;
}

Result<int> versionOf(const Json& json) {
  if (json.at("format").get<std::string>() != kFormat) return fail("the manifest is of another format");
  const int version = json.at("version").get<int>();
  if (version >= kOldestVersion && version <= kVersion) return version;
  return fail(fmt::format("the file has format version {}, this Weft reads versions {} to {}", version,
                          kOldestVersion, kVersion),
              {}, version > kVersion ? "use a newer Weft, or fit again" : "fit again");
}

Result<FieldManifest> manifestFrom(const Json& json, const ModelRegistry& models) {
  WEFT_TRY(const int version, versionOf(json));
  if (json.at("color_space").get<std::string>() != kColorSpace)
    return fail("the manifest names an unknown colour space");
  FieldManifest manifest;
  if (version == 2) {
    WEFT_TRY(manifest.model, modelOfVersion2(json.at("model"), models));
  } else {
    manifest.model = modelFrom(json.at("model"));
    manifest.levels = levelsFrom(json.at("levels"));
    manifest.tables = json.at("tables").get<std::vector<std::string>>();
    if (!std::ranges::is_sorted(manifest.tables, std::ranges::less_equal()))
      return fail("the manifest's tables are not in alphabetical order");
  }
  WEFT_TRY(manifest.field.encoding, encodingFromName(json.at("encoding").get<std::string>()));
  manifest.field.views = directionsFrom(json.at("views"));
  manifest.field.lights = directionsFrom(json.at("lights"));
  manifest.field.hasCosine = json.at("has_cosine").get<bool>();
  manifest.field.source = json.at("source").get<std::string>();
  if (!json.at("fit").is_null()) manifest.field.fitReport = json.at("fit").dump();
  return manifest;
}

Json toJson(const ModelDescription& model) {
  Json options = Json::object();
  for (const auto& [name, value] : model.options)
    std::visit([&option = options[name]](const auto& plain) { option = plain; }, value);
  return {{"name", model.name}, {"options", options}};
}

}  // namespace

FieldManifest FieldManifest::of(const ReflectanceField& field) {
  FieldManifest manifest{field.model().description(), field.description(), {}, {}};
  for (const FieldLevel& level : field.levels())
    manifest.levels.push_back({level.shared.width(), level.shared.height()});
  for (const auto& [name, table] : field.tables()) manifest.tables.push_back(name);
  return manifest;
}

Result<std::string> FieldManifest::text() const {
  try {
    const Json fit = field.fitReport.empty() ? Json() : parseJson(field.fitReport);
    Json sizes = Json::array();
    for (const Size& level : levels) sizes.push_back({{"width", level.width}, {"height", level.height}});
    const Json json = {{"format", kFormat},
                       {"version", kVersion},
                       {"model", toJson(model)},
                       {"levels", sizes},
                       {"tables", Json(tables)},
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

Result<FieldManifest> FieldManifest::parse(const std::string& text, const ModelRegistry& models) {
  try {
    return manifestFrom(parseJson(text), models);
  } catch (const std::exception& error) {
    return fail(std::string("the manifest is damaged: ") + error.what());
  }
}

}  // namespace weft
