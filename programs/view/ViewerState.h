#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/ext/vector_double2.hpp>
#include <optional>
#include <string>
#include <vector>

#include "LoadedView.h"
#include "OrbitCamera.h"
#include "weft/core/Result.h"
#include "weft/core/ToneMapping.h"

namespace weft {

/// All that a viewer shows and that people change there, without window or GL.
///
/// What has to be loaded for a change is asked for by takeRequest(); the result comes back by
/// show().
class ViewerState {
 public:
  /// What a drag of the mouse moves.
  enum class Drag { None, Orbit, Pan, Light };

  /// With no file nothing is shown at first. `toneCurve`: empty for what suits the light.
  ViewerState(ViewRequest first, float exposure, std::optional<ToneCurve> toneCurve);

  /// Shows another file; a picture of an environment lights what is shown.
  void open(const std::filesystem::path& file);
  /// Loads again what is shown, as when its file has changed.
  void reload() { requested_ = request_; }
  /// What has to be loaded now; once.
  std::optional<ViewRequest> takeRequest();
  /// What was loaded; what could not be leaves a message, and all as it is.
  void show(Result<LoadedView> loaded);

  // Null before anything is loaded.
  const LoadedView* view() const { return view_ ? &*view_ : nullptr; }
  LoadedView* view() { return view_ ? &*view_ : nullptr; }
  const ViewRequest& request() const { return request_; }

  void setAspect(float aspect);
  Camera camera() const;
  /// In heights of the picture, x to the right, y down.
  void drag(Drag what, glm::dvec2 drag);
  void zoom(double steps);
  /// All of the scene, from where it is looked at.
  void frame();
  void turnScene(double radians);

  std::size_t selectedLamp() const { return selectedLamp_; }
  void selectLamp(std::size_t lamp) { selectedLamp_ = lamp; }
  void addLamp();
  void removeLamp();
  void setLampColor(glm::vec3 color);

  /// Shapes, environments and models by name; the scene is loaded anew.
  void setShape(const std::string& shape);
  void setEnvironment(const std::string& environment);
  void setModel(const std::string& model);
  void setEnvironmentRotation(double degrees);
  /// How one of view()'s fields is shown.
  void setOptions(std::size_t field, const BTFMaterialOptions& options);

  float exposure() const { return exposure_; }
  void setExposure(float stops);
  ToneCurve toneCurve() const;
  void setToneCurve(ToneCurve curve);

  /// Messages for people, the latest last.
  const std::vector<std::string>& messages() const { return messages_; }
  void tell(std::string message);
  void clearMessages() { messages_.clear(); }

  /// Another number when the picture has to be drawn anew.
  std::uint64_t revision() const { return revision_; }

 private:
  void keepFrom(LoadedView& before, LoadedView& next) const;
  void setLamps(std::vector<SceneOptions::Lamp> lamps);
  void changed() { ++revision_; }

  ViewRequest request_;
  std::optional<ViewRequest> requested_;
  std::optional<LoadedView> view_;
  OrbitCamera camera_;
  float aspect_ = 4.0f / 3.0f;
  std::size_t selectedLamp_ = 0;
  bool ownLamps_ = false;  ///< people have changed them
  double turn_ = 0.0;
  float exposure_;
  std::optional<ToneCurve> toneCurve_;
  std::vector<std::string> messages_;
  std::uint64_t revision_ = 0;
};

}  // namespace weft
