#pragma once

#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "weft/core/Result.h"
#include "weft/reflectance/ReflectanceModel.h"

namespace weft {

/// A kind of model, by which files and command lines name it.
struct ModelType {
  /// Makes the model; with every declared option, in its range.
  using Factory = std::function<Result<std::shared_ptr<const ReflectanceModel>>(ModelOptions)>;

  std::string name;
  std::string purpose;  ///< one sentence: what it is
  std::vector<ModelOption> options;
  Factory make;
  /// unless asked otherwise: to values as the measurement stores them
  bool fitsStoredValues = false;
};

/// Makes models by name. A value: build your own, or start from builtin() and add to it.
class ModelRegistry {
 public:
  /// Every model of Weft.
  static ModelRegistry builtin();

  /// Replaces a type of the same name.
  void add(ModelType type);
  const std::vector<ModelType>& types() const { return types_; }
  std::vector<std::string> names() const;
  /// Fails on an unknown name, listing those that are known.
  Result<ModelType> find(std::string_view name) const;
  /// Fails likewise, and on options that the model does not have or that are out of range.
  Result<std::shared_ptr<const ReflectanceModel>> create(const ModelDescription& description) const;

 private:
  std::vector<ModelType> types_;
};

}  // namespace weft
