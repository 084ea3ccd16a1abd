#pragma once

#include <compare>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>

#include "weft/core/Result.h"
#include "weft/materials/BTFMap.h"
#include "weft/materials/BTFTextures.h"
#include "weft/reflectance/ModelRegistry.h"

namespace weft {

/// Reflectance field files, and coordinate maps for them, as textures, each read and uploaded once
/// however many materials and scenes name it. The caller owns it, and may keep it over many scenes:
/// it does not keep textures that nothing else has.
///
/// A file is told by its place, size and time of change, so that one that is written anew is read
/// anew. Used by one thread at a time.
class FieldCache {
 public:
  explicit FieldCache(ModelRegistry models = ModelRegistry::builtin()) : models_(std::move(models)) {}

  /// Fails, with file and reason, as readReflectanceField() and BTFTextures::create() do. Nothing
  /// but GL's copy is kept: a second context reads the file again, and reports it where the file is
  /// another by then.
  ///
  /// `preparedForEnvironments`: at least; textures that are there and prepared serve both.
  Result<std::shared_ptr<const BTFTextures>> load(const std::filesystem::path& path,
                                                  bool preparedForEnvironments = false);

  /// A `.coords.exr` for the textures that load() gave of `field`, likewise. Fails, with file and
  /// reason, as readCoordinateMap() and BTFMap::create() do.
  Result<std::shared_ptr<const BTFMap>> loadMap(const std::filesystem::path& map, const BTFTextures& textures,
                                                const std::filesystem::path& field);

 private:
  struct File {
    std::filesystem::path path;  ///< canonical
    std::uintmax_t size = 0;
    std::filesystem::file_time_type changed;

    auto operator<=>(const File&) const = default;
  };

  static Result<File> find(const std::filesystem::path& path);
  static Result<ReflectanceField> read(const File& file, const ModelRegistry& models);

  ModelRegistry models_;
  std::map<std::pair<File, bool>, std::weak_ptr<const BTFTextures>> textures_;  ///< bool: prepared
  std::map<std::pair<File, File>, std::weak_ptr<const BTFMap>> maps_;           ///< maps, and their fields
};

}  // namespace weft
