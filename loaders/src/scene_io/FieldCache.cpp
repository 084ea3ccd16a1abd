#include "weft/scene_io/FieldCache.h"

#include "weft/io/ReflectanceFieldFile.h"

namespace weft {

Result<FieldCache::File> FieldCache::find(const std::filesystem::path& path) {
  std::error_code error;
  File file{.path = std::filesystem::canonical(path, error), .size = 0, .changed = {}};
  if (!error) file.size = std::filesystem::file_size(file.path, error);
  if (!error) file.changed = std::filesystem::last_write_time(file.path, error);
  if (error) return fail("the reflectance field cannot be read: " + error.message(), path.string());
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

}  // namespace weft
