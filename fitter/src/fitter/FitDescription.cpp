#include "FitDescription.h"

#include <fmt/format.h>

#include "weft/core/Version.h"
#include "weft/evaluation/HoldOut.h"

namespace weft {
namespace {

std::vector<glm::vec3> without(const std::vector<glm::vec3>& directions, const std::vector<bool>& left) {
  std::vector<glm::vec3> rest;
  for (std::size_t i = 0; i < directions.size(); ++i)
    if (!left[i]) rest.push_back(directions[i]);
  return rest;
}

// Those that are held out, and those on or below the horizon: models differ in what they make of
// these.
std::vector<bool> lightsLeftOut(const std::vector<glm::vec3>& lights, int every) {
  std::vector<bool> left = heldOut(lights, every);
  for (std::size_t i = 0; i < lights.size(); ++i)
    if (lights[i].z <= 0.0f) left[i] = true;
  return left;
}

}  // namespace

ReflectanceFieldDescription descriptionOf(const BtfDescription& measured, const FitOptions& options,
                                          const ReflectanceModel& model) {
  const bool stored = options.space == FitSpace::Stored;
  return {without(measured.views, heldOut(measured.views, options.holdOutViews)),
          without(measured.lights, lightsLeftOut(measured.lights, options.holdOutLights)),
          options.cosineInModel || stored || model.containsCosine(),
          stored ? measured.encoding : Encoding::Linear,
          measured.name,
          {}};
}

Result<std::string> fingerprintOf(const BtfSource& source, const FitOptions& options, const Crop& crop,
                                  const ModelDescription& model) {
  if (options.partsFolder.empty()) return std::string();
  const BtfDescription& measured = source.description();
  WEFT_TRY(const std::uint64_t checksum, source.checksum());
  std::string fingerprint = fmt::format("weft {} {}", WEFT_VERSION, model.name);
  for (const auto& [name, value] : model.options) fingerprint += fmt::format(" ({} {})", name, textOf(value));
  return fingerprint +
         fmt::format(
             " of {}x{}x{}x{} with checksum {:016x}, crop {} {} {} {}, cosine {}, space {}, hold "
             "out {} {}, {}",
             measured.width, measured.height, measured.views.size(), measured.lights.size(), checksum, crop.x,
             crop.y, crop.width, crop.height, options.cosineInModel ? "in" : "out",
             options.space == FitSpace::Linear ? "linear" : "stored", options.holdOutLights,
             options.holdOutViews, options.precision == Precision::Half ? "half" : "float");
}

}  // namespace weft
