#include "ViewRequest.h"

#include "weft/core/FileKind.h"

namespace weft {

ViewedKind ViewRequest::kindOf(const std::filesystem::path& file) {
  const std::string name = file.string();
  if (name.starts_with("shape:") || name.ends_with(".gltf") || name.ends_with(".glb"))
    return ViewedKind::Scene;
  if (name.ends_with(".rf.exr")) return ViewedKind::Field;
  switch (fileKind(file)) {
    case FileKind::Json:
    case FileKind::Glb:
      return ViewedKind::Scene;
    case FileKind::Exr:
    case FileKind::Radiance:
      return ViewedKind::Environment;
    default:
      return ViewedKind::Measurement;
  }
}

}  // namespace weft
