#pragma once

#include <functional>
#include <string>
#include <vector>

#include "LoadedView.h"
#include "weft/core/Result.h"
#include "weft/evaluation/RawBtf.h"
#include "weft/fitter/FieldFit.h"

namespace weft {

/// Loads one thing that a viewer is to show, fitting it if it is a measurement. Touches no GL.
class ViewLoading {
 public:
  struct Listener {
    std::function<bool()> stopped;                   ///< whether nobody waits any more
    std::function<void(std::string)> doing;          ///< what is being done now
    std::function<void(Result<LoadedView>)> loaded;  ///< once, or twice: a part, then all
  };

  ViewLoading(ViewRequest request, Listener listener)
      : request_(std::move(request)), listener_(std::move(listener)) {}

  /// All of it, on the calling thread.
  void run();

 private:
  Result<LoadedView> loadScene();
  Result<LoadedView> loadField();
  Result<LoadedView> fitMeasurement();
  Result<LoadedView> fit(const BtfSource& source, const std::string& model, const std::optional<Crop>& crop);
  Result<LoadedView> showAlone(std::shared_ptr<const ReflectanceField> field, float wholeWidth);
  Result<LoadedView::Field> wrap(std::string name, std::shared_ptr<const ReflectanceField> field,
                                 const BTFMaterialOptions& options) const;
  Result<LoadedView> assemble(SceneOptions options, std::vector<LoadedView::Field> fields);
  void doing(std::string what) const { listener_.doing(std::move(what)); }

  ViewRequest request_;
  Listener listener_;
};

}  // namespace weft
