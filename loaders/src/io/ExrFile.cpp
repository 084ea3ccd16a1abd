#include "weft/io/ExrFile.h"

#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <exception>

#include "ExrPart.h"
#include "weft/core/AtomicFile.h"
#include "weft/core/Contract.h"

namespace weft {
namespace {

void copyMetadata(const Imf::Header& header, FloatImage& image) {
  for (auto attribute = header.begin(); attribute != header.end(); ++attribute)
    if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&attribute.attribute()))
      if (const std::string name = attribute.name(); name != "name" && name != "type")
        image.metadata[name] = text->value();
}

}  // namespace

Result<FloatImage> readExr(const std::filesystem::path& path) {
  const std::string where = path.string();
  WEFT_TRY(const std::uint64_t fileBytes, checkExrFile(path));
  return readingExr(where, [&]() -> Result<FloatImage> {
    Imf::MultiPartInputFile file(path.c_str(), 0);
    WEFT_TRY(const ExrPartShape shape, exrPartShape(file.header(0), where));
    WEFT_TRY_VOID(checkExrPart(file.header(0), fileBytes, where));
    Imf::InputPart part(file, 0);
    const std::uint64_t pixels =
        static_cast<std::uint64_t>(shape.width) * static_cast<std::uint64_t>(shape.height);
    proveExrPart(part, shape.channels, pixels * shape.channels.size(), fileBytes);
    FloatImage image(shape.width, shape.height, shape.channels);
    image.setPrecision(shape.precision);
    copyMetadata(file.header(0), image);
    readExrPart(part, image, 0);
    return image;
  });
}

Result<void> writeExr(const std::filesystem::path& path, const FloatImage& image) {
  WEFT_EXPECT(image.layers() == 1, "an EXR image has one layer");
  WEFT_TRY(AtomicFile file, AtomicFile::create(path));
  try {
    Imf::Header header = exrPartHeader(image);
    header.setType(Imf::SCANLINEIMAGE);
    for (const auto& [name, text] : image.metadata)
      if (header.find(name.c_str()) == header.end()) header.insert(name, Imf::StringAttribute(text));
    Imf::OutputFile output(file.temporary().c_str(), header, 0);
    writeExrPart(output, image, 0);
  } catch (const std::exception& error) {
    return fail(std::string("the OpenEXR file cannot be written: ") + error.what(), path.string(),
                "is the disk full?");
  }
  return file.commit();
}

}  // namespace weft
