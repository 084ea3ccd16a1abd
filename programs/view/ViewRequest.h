#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "weft/measurement/BtfSource.h"
#include "weft/scene_io/SceneSetup.h"

namespace weft {

/// What a viewer is asked to show.
enum class ViewedKind {
  Scene,        ///< a glTF file or a shape
  Field,        ///< a .rf.exr alone
  Measurement,  ///< which is fitted
  Environment,  ///< a picture as light, for what is shown
};

/// What is to be shown, and how: all that it takes to load it once more.
struct ViewRequest {
  std::filesystem::path file;      ///< or shape:NAME
  SceneOptions scene{};            ///< of the command line; its `scene` is set while loading
  std::string shape{};             ///< what a field alone lies on; empty: as suits it
  std::optional<float> uvScale{};  ///< of a field alone; empty: as suits it
  std::string model{};             ///< that a measurement is fitted with; empty: defaultModel()
  BtfOptions measurement{};

  ViewedKind kind() const { return kindOf(file); }
  static ViewedKind kindOf(const std::filesystem::path& file);
};

}  // namespace weft
