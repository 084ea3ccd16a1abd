#include "weft/materials/BTFTextures.h"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <set>

#include "weft/chunks/CubeTextureChunk.h"
#include "weft/chunks/TextureChunk.h"
#include "weft/shaders/Bindings.h"

namespace weft {
namespace {

constexpr int kMaximumLayers = 2048;

// The images of FieldTextures that are not empty, by their units.
using Images = std::map<int, std::shared_ptr<const TextureImage>>;

Images packed(const ReflectanceField& field, bool prepared) {
  FieldTextures textures = FieldTextures::create(field, prepared);
  Images images;
  const auto add = [&](int unit, TextureImage& image) {
    if (!image.empty()) images[unit] = std::make_shared<const TextureImage>(std::move(image));
  };
  add(bindings::layerParametersUnit, textures.layers);
  add(bindings::sharedParametersUnit, textures.shared);
  add(bindings::baseColorsUnit, textures.baseColors);
  add(bindings::preparedParametersUnit, textures.preparedLayers);
  int unit = bindings::firstTableUnit;
  for (auto& [name, table] : textures.tables) add(unit++, table);
  return images;
}

// How the images are sampled that are not read texel by texel.
std::map<int, TextureOptions> samplingOf(const ReflectanceField& field) {
  std::map<int, TextureOptions> sampling;
  // GL leaves levels undefined where no filter asks for them, even to texelFetch().
  if (field.levels().size() > 1)
    for (const int unit :
         {bindings::sharedParametersUnit, bindings::layerParametersUnit, bindings::preparedParametersUnit})
      sampling[unit] = {.filter = TextureFilter::Mipmapped};
  if (field.model().filtersParameters() || field.model().summedLevels() > 0)
    for (const int unit : {bindings::sharedParametersUnit, bindings::baseColorsUnit})
      sampling[unit] = {.filter = TextureFilter::Mipmapped, .wrap = TextureWrap::Repeat};
  std::set<std::string> filtered;
  for (const ModelTable& table : field.model().tables())
    if (table.isFiltered) filtered.insert(table.name);
  int unit = bindings::firstTableUnit;
  for (const auto& [name, table] : field.tables()) {
    if (filtered.contains(name)) sampling[unit] = {.filter = TextureFilter::Linear};
    ++unit;
  }
  return sampling;
}

// What is packed; with a source only until it is on a GPU: then the next to ask has all of it made
// anew.
class PackedField {
 public:
  PackedField(Images images, bool prepared, BTFTextures::FieldSource source)
      : images_(std::move(images)), prepared_(prepared), source_(std::move(source)) {}

  Result<std::shared_ptr<const TextureImage>> take(int unit) {
    const std::lock_guard lock(mutex_);
    if (!images_[unit]) {
      WEFT_TRY(const ReflectanceField field, source_());
      images_ = packed(field, prepared_);
      if (!images_[unit]) return fail("the reflectance field is not the one that was loaded");
    }
    return source_ ? std::exchange(images_[unit], nullptr) : images_[unit];
  }

 private:
  std::mutex mutex_;
  Images images_;
  bool prepared_;
  BTFTextures::FieldSource source_;
};

std::shared_ptr<const Chunk> tableOf(FloatImage image) {
  return std::make_shared<TextureChunk>(std::make_shared<const FloatImage>(std::move(image)),
                                        TextureOptions{.shape = TextureShape::Rectangle});
}

}  // namespace

Result<std::shared_ptr<const BTFTextures>> BTFTextures::create(const ReflectanceField& field,
                                                               bool preparedForEnvironments,
                                                               FieldSource source) {
  if (const int layers = FieldTextures::arrayLayers(field.formula()); layers > kMaximumLayers)
    return fail(fmt::format("the field needs {} texture layers of at most {}", layers, kMaximumLayers));
  if (const std::size_t tables = field.tables().size(); tables > bindings::mostTables)
    return fail(fmt::format("the field has {} tables of at most {}", tables, bindings::mostTables));
  std::shared_ptr<BTFTextures> made(new BTFTextures);
  made->size_ = {field.width(), field.height()};
  made->views_ = static_cast<int>(field.description().views.size());
  made->filtersParameters_ = field.model().filtersParameters();
  const FloatImage& coarsest = field.levels().back().shared;
  made->tilesAtRandom_ = made->filtersParameters_ && coarsest.width() == 1 && coarsest.height() == 1;
  made->sumsLevels_ = field.model().summedLevels() > 0;
  made->setProgram(FieldProgram::create(field));
  const bool prepared = preparedForEnvironments && FieldTextures::canBePrepared(field.formula());
  if (prepared) made->source_.defines.emplace_back("ENVIRONMENT_LAYERS", "");
  const Images images = packed(field, prepared);
  const auto shelf = std::make_shared<PackedField>(images, prepared, std::move(source));
  std::map<int, TextureOptions> sampling = samplingOf(field);
  for (const auto& [unit, image] : images) {
    sampling[unit].shape = TextureShape::Array;
    made->add(unit, std::make_shared<TextureChunk>(std::make_shared<const TextureSource>(
                                                       [shelf, unit = unit] { return shelf->take(unit); }),
                                                   sampling[unit]));
  }
  return made;
}

// The program, and the small tables that it reads.
void BTFTextures::setProgram(FieldProgram program) {
  block_ = program.block;
  source_ = {.vertex = "mesh.vert",
             .fragment = "btf.frag",
             .defines = {program.defines.begin(), program.defines.end()},
             .includeAliases = std::move(program.includeAliases),
             .texts = std::move(program.texts)};
  if (!program.lookup.triangles.empty()) {
    add(bindings::triangleOfDirectionUnit,
        std::make_shared<CubeTextureChunk>(
            std::make_shared<const FloatImage>(std::move(program.lookup.triangleOfDirection))));
    add(bindings::trianglesUnit, tableOf(std::move(program.lookup.triangles)));
  }
  environmentLights_ = program.quadrature.width();
  if (!program.quadrature.empty()) add(bindings::quadratureUnit, tableOf(std::move(program.quadrature)));
}

void BTFTextures::add(int unit, std::shared_ptr<const Chunk> chunk) {
  chunks_.emplace_back(textureSlot(static_cast<unsigned>(unit)), std::move(chunk));
}

}  // namespace weft
