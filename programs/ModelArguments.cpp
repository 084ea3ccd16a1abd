#include "ModelArguments.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

namespace weft {
namespace {

std::string flagOf(std::string option) {
  std::ranges::replace(option, '_', '-');
  return fmt::format("--{}", option);
}

}  // namespace

void ModelArguments::addTo(CLI::App& app) {
  for (const ModelType& type : registry_.types())
    for (const ModelOption& option : type.options)
      if (const auto [text, isNew] = texts_.try_emplace(option.name); isNew)
        app.add_option(flagOf(option.name), text->second, helpOf(option.name));
}

std::string ModelArguments::helpOfNames(const std::string& what) const {
  std::string help = what;
  for (const ModelType& type : registry_.types()) help += fmt::format("\n{}: {}", type.name, type.purpose);
  return help;
}

// "cosine lobes a layer (rfnl, lfnl: 1 to 4) [2]", the models that declare the same together.
std::string ModelArguments::helpOf(const std::string& name) const {
  std::vector<std::pair<ModelOption, std::vector<std::string>>> uses;
  const auto isSame = [](const ModelOption& a, const ModelOption& b) {
    return a.help == b.help && a.range() == b.range() && a.standard == b.standard;
  };
  for (const ModelType& type : registry_.types())
    for (const ModelOption& option : type.options) {
      if (option.name != name) continue;
      auto use = std::ranges::find_if(uses, [&](const auto& known) { return isSame(known.first, option); });
      if (use == uses.end()) use = uses.insert(use, {option, {}});
      use->second.push_back(type.name);
    }
  std::vector<std::string> parts;
  for (const auto& [option, models] : uses)
    parts.push_back(fmt::format("{} ({}: {}) [{}]", option.help, fmt::join(models, ", "), option.range(),
                                textOf(option.standard)));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::map<std::string, OptionValue> ModelArguments::given() const {
  std::map<std::string, OptionValue> values;
  for (const ModelType& type : registry_.types())
    for (const ModelOption& option : type.options)
      if (const std::string& text = texts_.at(option.name); !text.empty())
        values.try_emplace(option.name, option.valueFrom(text));
  return values;
}

void addModel(nlohmann::ordered_json& report, const std::string& key, const ModelDescription& model) {
  report[key] = model.name;
  for (const auto& [name, value] : model.options)
    std::visit([&](const auto& plain) { report[name] = plain; }, value);
}

}  // namespace weft
