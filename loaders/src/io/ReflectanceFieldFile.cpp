#include "weft/io/ReflectanceFieldFile.h"

#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>
#include <span>
#include <type_traits>

#include "ExrPart.h"
#include "FieldManifest.h"
#include "weft/core/AtomicFile.h"
#include "weft/io/ParallelTry.h"

namespace weft {
namespace {

constexpr const char* kManifestAttribute = "weftReflectanceField";
constexpr const char* kSharedPart = "shared";
constexpr const char* kTablePrefix = "table.";

// The parts of a file in their order; `Image` is const where they are written.
template <class Image>
struct FilePart {
  std::string name;
  Image* image;
  int layer = 0;
};

std::string levelPrefix(std::size_t level) {
  return level == 0 ? std::string() : fmt::format("level{}.", level);
}

// The part of a layer, which is a view's or a light's.
std::string layerName(const ReflectanceModel& model, int layer) {
  return fmt::format("{}{:03}", model.layerDirections() == LayerDirections::Lights ? "light" : "view", layer);
}

template <class Level, class Tables>
auto partsOf(const ReflectanceModel& model, std::span<Level> levels, Tables& tables) {
  using Image = std::remove_reference_t<decltype((levels[0].shared))>;
  std::vector<FilePart<Image>> parts;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    parts.push_back({levelPrefix(i) + kSharedPart, &levels[i].shared});
    for (int layer = 0; layer < levels[i].layers.layers(); ++layer)
      parts.push_back({levelPrefix(i) + layerName(model, layer), &levels[i].layers, layer});
  }
  for (auto& [name, table] : tables) parts.push_back({kTablePrefix + name, &table});
  return parts;
}

// OpenEXR wants one display window for all parts: level 0's.
Imf::Header partHeader(const FloatImage& image, const std::string& name, const FloatImage& first) {
  Imf::Header header = exrPartHeader(image);
  header.displayWindow() = exrPartHeader(first).displayWindow();
  header.setName(name);
  header.setType(Imf::SCANLINEIMAGE);
  return header;
}

// A part as a file of its own in memory. OpenEXR would pack a part on one thread, or on a pool of
// threads that it shares with the rest of the program; so every thread packs other parts, and
// blocks are copied as they are.
std::string packedPart(const FloatImage& image, int layer) {
  Imf::StdOSStream stream;
  {
    Imf::OutputFile file(stream, exrPartHeader(image), 0);
    writeExrPart(file, image, layer);
  }
  return stream.str();
}

void copyPart(const std::string& packed, Imf::MultiPartOutputFile& file, int part) {
  Imf::StdISStream stream;
  stream.str(packed);
  Imf::InputFile from(stream, 0);
  Imf::OutputPart(file, part).copyPixels(from);
}

void writeParts(const ReflectanceField& field, const std::string& manifest, const std::string& path) {
  const auto content = partsOf(field.model(), std::span(field.levels()), field.tables());
  std::vector<Imf::Header> headers;
  for (const auto& part : content) headers.push_back(partHeader(*part.image, part.name, field.shared()));
  headers[0].insert(kManifestAttribute, Imf::StringAttribute(manifest));
  const int parts = static_cast<int>(headers.size());
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), parts, false, 0);

  constexpr std::size_t kPartsAtOnce = 64;  // to be held in memory
  for (std::size_t first = 0; first < content.size(); first += kPartsAtOnce) {
    std::vector<std::string> packed(std::min(kPartsAtOnce, content.size() - first));
    tbb::parallel_for(std::size_t{0}, packed.size(), [&](std::size_t i) {
      packed[i] = packedPart(*content[first + i].image, content[first + i].layer);
    });
    for (std::size_t i = 0; i < packed.size(); ++i) copyPart(packed[i], file, static_cast<int>(first + i));
  }
}

struct LevelShape {
  int width = 0;
  int height = 0;
  Precision shared = Precision::Half;
  Precision layers = Precision::Half;
};

struct FieldShape {
  std::vector<LevelShape> levels;
  std::vector<ExrPartShape> tables;
};

// Looks at the headers of all parts, in their order, before memory is taken for what they hold.
class PartHeaders {
 public:
  PartHeaders(const Imf::MultiPartInputFile& file, const ReflectanceModel& model, std::uint64_t fileBytes,
              std::string where)
      : file_(file), model_(model), fileBytes_(fileBytes), where_(std::move(where)) {}

  Result<LevelShape> nextLevel(std::size_t layers, const std::string& prefix) {
    WEFT_TRY(const ExrPartShape shared, next(prefix + kSharedPart, model_.sharedChannels()));
    LevelShape shape{shared.width, shared.height, shared.precision, Precision::Half};
    for (int layer = 0; layer < static_cast<int>(layers); ++layer) {
      const std::string name = prefix + layerName(model_, layer);
      WEFT_TRY(const ExrPartShape part, next(name, model_.layerChannels()));
      if (part.width != shape.width || part.height != shape.height)
        return fail(fmt::format("part '{}' differs in size", name), where_);
      if (part.precision == Precision::Float) shape.layers = Precision::Float;
    }
    return shape;
  }

  Result<ExrPartShape> nextTable(const std::string& name) {
    const std::vector<ModelTable> declared = model_.tables();
    const auto table = std::ranges::find(declared, name, &ModelTable::name);
    if (table == declared.end())
      return fail(fmt::format("the model '{}' has no table '{}'", model_.description().name, name), where_);
    return next(kTablePrefix + name, table->channels);
  }

  // Of all parts so far.
  std::uint64_t values() const { return values_; }

 private:
  Result<ExrPartShape> next(const std::string& name, std::vector<std::string> channels) {
    const Imf::Header& header = file_.header(part_);
    if (!header.hasName() || header.name() != name)
      return fail(fmt::format("part {} is not named '{}'", part_, name), where_);
    ++part_;
    WEFT_TRY(ExrPartShape shape, exrPartShape(header, fmt::format("{}: part '{}'", where_, name)));
    std::ranges::sort(channels);  // as they are in a file
    if (shape.channels != channels)
      return fail(fmt::format("the channels of part '{}' are not those of the model", name), where_);
    WEFT_TRY_VOID(checkExrPart(header, fileBytes_, where_));
    values_ +=
        static_cast<std::uint64_t>(shape.width) * static_cast<std::uint64_t>(shape.height) * channels.size();
    return shape;
  }

  const Imf::MultiPartInputFile& file_;
  const ReflectanceModel& model_;
  std::uint64_t fileBytes_;
  std::string where_;
  int part_ = 0;
  std::uint64_t values_ = 0;
};

Result<FieldShape> checkParts(const Imf::MultiPartInputFile& file, const FieldManifest& manifest,
                              const ReflectanceModel& model, std::size_t layers, std::uint64_t fileBytes,
                              const std::string& where) {
  const std::size_t levels = std::max<std::size_t>(manifest.levels.size(), 1);
  const std::size_t parts = levels * (1 + layers) + manifest.tables.size();
  if (static_cast<std::size_t>(file.parts()) != parts)
    return fail(fmt::format("the manifest describes {} parts, the file has {}", parts, file.parts()), where);
  PartHeaders headers(file, model, fileBytes, where);
  FieldShape shape;
  for (std::size_t i = 0; i < levels; ++i) {
    WEFT_TRY(const LevelShape level, headers.nextLevel(layers, levelPrefix(i)));
    const FieldManifest::Size size{level.width, level.height};
    if (!manifest.levels.empty() && manifest.levels[i] != size)
      return fail(fmt::format("level {} has {} x {} texels, not {} x {} as the manifest says", i, level.width,
                              level.height, manifest.levels[i].width, manifest.levels[i].height),
                  where);
    shape.levels.push_back(level);
  }
  for (const std::string& name : manifest.tables) {
    WEFT_TRY(ExrPartShape table, headers.nextTable(name));
    shape.tables.push_back(std::move(table));
  }
  WEFT_TRY_VOID(checkExrMemory(headers.values(), fileBytes, where));
  return shape;
}

std::size_t layerCount(const ReflectanceModel& model, const ReflectanceFieldDescription& field) {
  if (model.layerParameters().empty()) return 0;
  switch (model.layerDirections()) {
    case LayerDirections::None:
      return 0;
    case LayerDirections::Views:
      return field.views.size();
    case LayerDirections::Lights:
      return field.lights.size();
  }
  return 0;
}

FloatImage emptyImage(int width, int height, std::vector<std::string> channels, int layers,
                      Precision precision) {
  FloatImage image(width, height, std::move(channels), layers);
  image.setPrecision(precision);
  return image;
}

std::vector<FieldLevel> emptyLevels(const FieldShape& shape, const ReflectanceModel& model, int layers) {
  std::vector<FieldLevel> levels;
  for (const LevelShape& level : shape.levels) {
    levels.push_back({emptyImage(level.width, level.height, model.sharedChannels(), 1, level.shared), {}});
    if (layers > 0)
      levels.back().layers =
          emptyImage(level.width, level.height, model.layerChannels(), layers, level.layers);
  }
  return levels;
}

FieldTables emptyTables(const FieldShape& shape, const std::vector<std::string>& names,
                        const ReflectanceModel& model) {
  FieldTables tables;
  const std::vector<ModelTable> declared = model.tables();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const ExrPartShape& part = shape.tables[i];
    const auto& channels = std::ranges::find(declared, names[i], &ModelTable::name)->channels;
    tables[names[i]] = emptyImage(part.width, part.height, channels, 1, part.precision);
  }
  return tables;
}

// OpenEXR locks a file while it unpacks a part of it, so every thread opens its own.
Result<void> readParts(const std::string& path, const std::vector<FilePart<FloatImage>>& parts) {
  tbb::enumerable_thread_specific<std::unique_ptr<Imf::MultiPartInputFile>> files;
  return parallelTry(static_cast<int>(parts.size()), [&](int index) -> Result<void> {
    try {
      std::unique_ptr<Imf::MultiPartInputFile>& file = files.local();
      if (!file) file = std::make_unique<Imf::MultiPartInputFile>(path.c_str(), 0);
      Imf::InputPart part(*file, index);
      const FilePart<FloatImage>& to = parts[static_cast<std::size_t>(index)];
      readExrPart(part, *to.image, to.layer);
      return {};
    } catch (const std::bad_alloc&) {
      throw;  // says of itself what it is
    } catch (const std::exception& error) {
      return fail(fmt::format("part {} is damaged: {}", index, error.what()), path);
    }
  });
}

Result<ReflectanceField> readField(const Imf::MultiPartInputFile& file, const std::string& text,
                                   const ModelRegistry& models, std::uint64_t fileBytes,
                                   const std::string& path) {
  WEFT_TRY(FieldManifest manifest, FieldManifest::parse(text, models));
  WEFT_TRY(const auto model, models.create(manifest.model));
  const std::size_t layers = layerCount(*model, manifest.field);
  WEFT_TRY(const FieldShape shape, checkParts(file, manifest, *model, layers, fileBytes, path));
  std::vector<FieldLevel> levels = emptyLevels(shape, *model, static_cast<int>(layers));
  FieldTables tables = emptyTables(shape, manifest.tables, *model);
  WEFT_TRY_VOID(readParts(path, partsOf(*model, std::span(levels), tables)));
  return ReflectanceField::create(model, std::move(manifest.field), std::move(levels), std::move(tables));
}

// Checks of contents do not know the file's name.
Error inFile(Error error, const std::string& where) {
  error.where = error.where.empty() ? where : where + ": " + error.where;
  return error;
}

}  // namespace

Result<void> writeReflectanceField(const ReflectanceField& field, const std::filesystem::path& path) {
  const Result<std::string> text = FieldManifest::of(field).text();
  if (!text) return tl::unexpected<Error>(inFile(text.error(), path.string()));
  WEFT_TRY(AtomicFile file, AtomicFile::create(path));
  try {
    writeParts(field, *text, file.temporary().string());
  } catch (const std::exception& error) {
    return fail(std::string("the reflectance field cannot be written: ") + error.what(), path.string(),
                "is the disk full?");
  }
  return file.commit();
}

Result<ReflectanceField> readReflectanceField(const std::filesystem::path& path,
                                              const ModelRegistry& models) {
  const std::string where = path.string();
  WEFT_TRY(const std::uint64_t fileBytes, checkExrFile(path));
  return readingExr(where, [&]() -> Result<ReflectanceField> {
    const Imf::MultiPartInputFile file(where.c_str(), 0);
    const auto* attribute = file.header(0).findTypedAttribute<Imf::StringAttribute>(kManifestAttribute);
    if (!attribute)
      return fail("not a reflectance field: the OpenEXR file has no manifest", where, "weft-fit writes them");
    Result<ReflectanceField> field = readField(file, attribute->value(), models, fileBytes, where);
    if (!field && !field.error().where.starts_with(where))
      return tl::unexpected<Error>(inFile(field.error(), where));
    return field;
  });
}

}  // namespace weft
