#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "ViewRequest.h"
#include "weft/reflectance/ReflectanceField.h"

namespace weft {

/// A scene that is ready to be drawn, with what a viewer says of it.
struct LoadedView {
  struct Field {
    std::string name;  ///< of the material; "*": all
    std::shared_ptr<BTFMaterial> material;
    std::shared_ptr<const ReflectanceField> field;
    glm::vec2 firstScale{1.0f};  ///< repetitions that it was loaded with
    std::string error{};         ///< of the fit: "eps 0.0307 (0.0252 to 0.0380)"; empty: not known
    std::uint64_t gpuBytes = 0;
  };

  ViewRequest request;
  SceneSetup setup;
  std::vector<Field> fields;
  std::vector<std::filesystem::path> files{};  ///< that it was read from
  std::string shape{};                         ///< that a field alone lies on; empty: a scene
  std::vector<std::string> warnings{};         ///< a sentence each
  std::string model{};                         ///< that a measurement was fitted with
  bool isPart = false;                         ///< of a measurement that is still being fitted
  bool fromFront = false;                      ///< where it is to be looked at from at first
};

}  // namespace weft
