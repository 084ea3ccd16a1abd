#include "weft/scene_io/FieldCache.h"

#include "weft/io/CoordinateMapFile.h"
#include "weft/io/ReflectanceFieldFile.h"

namespace weft {

Result<FieldCache::File> FieldCache::find(const std::filesystem::path& path) {
  std::error_code error;
  File file{.path = std::filesystem::canonical(path, error), .size = 0, .changed = {}};
  if (!error) file.size = std::filesystem::file_size(file.path, error);
  if (!error) file.changed = std::filesystem::last_write_time(file.path, error);
  if (error) return fail("the file cannot be read: " + error.message(), path.string());
  return file;
}

// The file as it was when it was found.
Result<ReflectanceField> FieldCache::read(const File& file, const ModelRegistry& models) {
  WEFT_TRY(const File now, find(file.path));
  if (now != file)
    return fail("the reflectance field has changed since it was loaded", file.path.string(), "load it again");
  return readReflectanceField(file.path, models);
}

Result<std::shared_ptr<const BTFTextures>> FieldCache::load(const std::filesystem::path& path,
                                                            bool preparedForEnvironments) {
  std::erase_if(textures_, [](const auto& entry) { return entry.second.expired(); });
  const Result<File> file = find(path);
  if (!file) {
    // What the reader says of the path as it was given.
    WEFT_TRY_VOID(readReflectanceField(path, models_));
    return tl::unexpected(file.error());
  }
  for (const bool prepared : {true, false})
    if (const auto known = textures_.find({*file, prepared}); known != textures_.end())
      if (auto textures = known->second.lock(); textures && prepared >= preparedForEnvironments)
        return textures;

  WEFT_TRY(const ReflectanceField field, readReflectanceField(path, models_));
  WEFT_TRY(auto textures,
           BTFTextures::create(field, preparedForEnvironments,
                               [file = *file, models = models_] { return read(file, models); }));
  textures_[{*file, preparedForEnvironments}] = textures;
  return textures;
}

Result<std::shared_ptr<const BTFMap>> FieldCache::loadMap(const std::filesystem::path& map,
                                                          const BTFTextures& textures,
                                                          const std::filesystem::path& field) {
  std::erase_if(maps_, [](const auto& entry) { return entry.second.expired(); });
  const Result<File> mapFile = find(map);
  if (!mapFile) {
    WEFT_TRY_VOID(readCoordinateMap(map));  // what the reader says of the path
    return tl::unexpected(mapFile.error());
  }
  WEFT_TRY(const File fieldFile, find(field));
  if (const auto known = maps_.find({*mapFile, fieldFile}); known != maps_.end())
    if (auto made = known->second.lock()) return made;
  WEFT_TRY(const CoordinateMap read, readCoordinateMap(map));
  auto made = BTFMap::create(read, textures, [&] { return FieldCache::read(fieldFile, models_); });
  if (!made && made.error().where.empty()) made.error().where = map.string();
  if (made) maps_[{*mapFile, fieldFile}] = *made;
  return made;
}

}  // namespace weft
