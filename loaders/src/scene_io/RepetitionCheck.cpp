#include "RepetitionCheck.h"

#include <fmt/format.h>

#include <cmath>

#include "weft/materials/BTFMaterial.h"
#include "weft/scene_io/MaterialSurface.h"

namespace weft {
namespace {

constexpr double kFewest = 2.0, kMost = 200.0;
constexpr double kSuiting = 20.0;

/// How many of a field's samples lie side by side on a surface, each way.
double repetitionsOn(const MaterialSurface& surface, const BTFMaterial& material) {
  const glm::dvec2 scale = material.options().textureScale;
  const glm::dvec2 samples = glm::dvec2(material.surfaceSize()) / glm::dvec2(material.textures()->size());
  return std::sqrt(surface.textureArea * scale.x * scale.y * samples.x * samples.y);
}

/// About a number, for people.
std::string about(double number) {
  return number < 10.0 ? fmt::format("{:.2g}", number) : fmt::format("{:.0f}", number);
}

std::string timesAbout(double number) {
  const std::string text = about(number);
  return text == "1" ? "once" : text + " times";
}

}  // namespace

std::vector<std::string> repetitionWarnings(const Node& root, const Camera& camera,
                                            const SceneOptions& options) {
  std::vector<std::string> warnings;
  for (const MaterialSurface& surface : surfacesOf(root, camera.projection(options.aspect) * camera.view)) {
    const auto* material = dynamic_cast<const BTFMaterial*>(surface.material.get());
    if (!material || material->textures()->views() == 1 || surface.textureArea == 0.0) continue;
    const double repetitions = repetitionsOn(surface, *material);
    if (repetitions >= kFewest && repetitions <= kMost) continue;
    const double suiting = kSuiting / repetitions * double{options.btf.textureScale.x};
    warnings.push_back(fmt::format(
        "the sample of a reflectance field, {} x {} texels, is seen {} each way, so {}; --uv-scale {} "
        "shows it {} times",
        material->textures()->size().x, material->textures()->size().y, timesAbout(repetitions),
        repetitions < kFewest ? "large that it may look plain" : "small that it may blur", about(suiting),
        kSuiting));
  }
  return warnings;
}

}  // namespace weft
