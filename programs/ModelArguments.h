#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "weft/reflectance/ModelRegistry.h"

namespace CLI {
class App;
}

namespace weft {

/// The options of models as options of a command line: all that the types of a registry declare,
/// walked.
class ModelArguments {
 public:
  explicit ModelArguments(ModelRegistry registry) : registry_(std::move(registry)) {}

  /// Adds --lobes and the others, with whose they are and what they may be.
  void addTo(CLI::App& app);
  /// "what to fit:", a line a model, for the help of the option that names them.
  std::string helpOfNames(const std::string& what) const;
  /// What was given; whether the chosen model has it is for the registry to say.
  std::map<std::string, OptionValue> given() const;

  const ModelRegistry& registry() const { return registry_; }

 private:
  std::string helpOf(const std::string& name) const;

  ModelRegistry registry_;
  std::map<std::string, std::string> texts_;  ///< of every option; empty where it was not given
};

/// Adds a model's name as `key`, and its options, to a report.
void addModel(nlohmann::ordered_json& report, const std::string& key, const ModelDescription& model);

}  // namespace weft
