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

#include "ExrPart.h"
#include "FieldManifest.h"
#include "weft/core/AtomicFile.h"
#include "weft/io/ParallelTry.h"

namespace weft {
namespace {

constexpr const char* kManifestAttribute = "weftReflectanceField";
constexpr const char* kSharedPart = "shared";

// The part of a layer, which is a view's or a light's.
std::string layerPart(const ReflectanceModel& model, int layer) {
  return fmt::format("{}{:03}", model.layerDirections() == LayerDirections::Lights ? "light" : "view", layer);
}

Imf::Header partHeader(const FloatImage& image, const std::string& name) {
  Imf::Header header = exrPartHeader(image);
  header.setName(name);
  header.setType(Imf::SCANLINEIMAGE);
  return header;
}

// A part as a file of its own in memory. OpenEXR would pack a part on one thread, or on a pool of threads
// that it shares with the rest of the program; so every thread packs other parts, and blocks are copied as
// they are.
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
  std::vector<Imf::Header> headers{partHeader(field.shared(), kSharedPart)};
  headers[0].insert(kManifestAttribute, Imf::StringAttribute(manifest));
  const FloatImage& layers = field.layers();
  for (int layer = 0; layer < layers.layers(); ++layer)
    headers.push_back(partHeader(layers, layerPart(field.model(), layer)));
  const int parts = static_cast<int>(headers.size());
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), parts, false, 0);

  constexpr int kPartsAtOnce = 64;  // to be held in memory
  for (int first = 0; first < parts; first += kPartsAtOnce) {
    std::vector<std::string> packed(static_cast<std::size_t>(std::min(kPartsAtOnce, parts - first)));
    tbb::parallel_for(std::size_t{0}, packed.size(), [&](std::size_t i) {
      const int part = first + static_cast<int>(i);
      packed[i] = part == 0 ? packedPart(field.shared(), 0) : packedPart(layers, part - 1);
    });
    for (std::size_t i = 0; i < packed.size(); ++i) copyPart(packed[i], file, first + static_cast<int>(i));
  }
}

// Every part but the first must be as large as it and hold the model's layer channels; channels in a file are
// in alphabetical order.
Result<ExrPartShape> checkPart(const Imf::MultiPartInputFile& file, int part, const std::string& name,
                               std::vector<std::string> channels, std::uint64_t fileBytes,
                               const std::string& where) {
  const Imf::Header& header = file.header(part);
  if (!header.hasName() || header.name() != name)
    return fail(fmt::format("part {} is not named '{}'", part, name), where);
  WEFT_TRY(ExrPartShape shape, exrPartShape(header, fmt::format("{}: part '{}'", where, name)));
  std::sort(channels.begin(), channels.end());
  if (shape.channels != channels)
    return fail(fmt::format("the channels of part '{}' are not those of the model", name), where);
  WEFT_TRY_VOID(checkExrPart(header, fileBytes, where));
  return shape;
}

struct FieldShape {
  int width = 0;
  int height = 0;
  Precision shared = Precision::Half;
  Precision layers = Precision::Half;
};

Result<FieldShape> checkParts(const Imf::MultiPartInputFile& file, const ReflectanceModel& model,
                              std::size_t layers, std::uint64_t fileBytes, const std::string& where) {
  if (static_cast<std::size_t>(file.parts()) != layers + 1)
    return fail(fmt::format("the manifest describes {} layers, the file has {}", layers, file.parts() - 1),
                where);
  WEFT_TRY(const ExrPartShape shared,
           checkPart(file, 0, kSharedPart, model.sharedChannels(), fileBytes, where));
  FieldShape shape{shared.width, shared.height, shared.precision, Precision::Half};
  for (int layer = 0; layer < static_cast<int>(layers); ++layer) {
    const std::string name = layerPart(model, layer);
    WEFT_TRY(const ExrPartShape part,
             checkPart(file, layer + 1, name, model.layerChannels(), fileBytes, where));
    if (part.width != shape.width || part.height != shape.height)
      return fail(fmt::format("part '{}' differs in size", name), where);
    if (part.precision == Precision::Float) shape.layers = Precision::Float;
  }
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(shape.width) * static_cast<std::uint64_t>(shape.height);
  const std::uint64_t channels = model.sharedChannels().size() + layers * model.layerChannels().size();
  WEFT_TRY_VOID(checkExrMemory(pixels * channels, fileBytes, where));
  return shape;
}

std::size_t layerCount(const ReflectanceModel& model, const ReflectanceFieldDescription& field) {
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

// OpenEXR locks a file while it unpacks a part of it, so every thread opens its own.
Result<void> readParts(const std::string& path, FloatImage& shared, FloatImage& layers) {
  tbb::enumerable_thread_specific<std::unique_ptr<Imf::MultiPartInputFile>> files;
  return parallelTry(layers.layers() + 1, [&](int index) -> Result<void> {
    try {
      std::unique_ptr<Imf::MultiPartInputFile>& file = files.local();
      if (!file) file = std::make_unique<Imf::MultiPartInputFile>(path.c_str(), 0);
      Imf::InputPart part(*file, index);
      readExrPart(part, index == 0 ? shared : layers, std::max(index - 1, 0));
      return {};
    } catch (const std::bad_alloc&) {
      throw;  // says of itself what it is
    } catch (const std::exception& error) {
      return fail(fmt::format("part {} is damaged: {}", index, error.what()), path);
    }
  });
}

// The rest of the file's checks do not know its name.
Error inFile(Error error, const std::string& where) {
  error.where = error.where.empty() ? where : where + ": " + error.where;
  return error;
}

}  // namespace

Result<void> writeReflectanceField(const ReflectanceField& field, const std::filesystem::path& path) {
  const FieldManifest manifest{field.model().description(), field.description()};
  const Result<std::string> text = manifest.text();
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
    Result<FieldManifest> manifest = FieldManifest::parse(attribute->value());
    if (!manifest) return tl::unexpected<Error>(inFile(manifest.error(), where));
    Result<std::shared_ptr<const ReflectanceModel>> model = models.create(manifest->model);
    if (!model) return tl::unexpected<Error>(inFile(model.error(), where));
    const std::size_t layersThere = layerCount(**model, manifest->field);
    WEFT_TRY(const FieldShape shape, checkParts(file, **model, layersThere, fileBytes, where));

    FloatImage shared(shape.width, shape.height, (*model)->sharedChannels());
    FloatImage layers;
    if (layersThere > 0)
      layers =
          FloatImage(shape.width, shape.height, (*model)->layerChannels(), static_cast<int>(layersThere));
    shared.setPrecision(shape.shared);
    layers.setPrecision(shape.layers);
    WEFT_TRY_VOID(readParts(where, shared, layers));
    Result<ReflectanceField> field =
        ReflectanceField::create(*model, std::move(manifest->field), std::move(shared), std::move(layers));
    if (!field) return tl::unexpected<Error>(inFile(field.error(), where));
    return field;
  });
}

std::uint64_t gpuBytes(const ReflectanceField& field) {
  constexpr std::uint64_t kTexelBytes = 4 * 2;
  const ReflectanceModel& model = field.model();
  const int texels =
      model.colorChannels() * (sharedTexels(model) + field.layers().layers() * layerTexels(model));
  return kTexelBytes * static_cast<std::uint64_t>(field.width()) *
         static_cast<std::uint64_t>(field.height()) * static_cast<std::uint64_t>(texels);
}

}  // namespace weft
