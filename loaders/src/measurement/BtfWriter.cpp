#include "weft/measurement/BtfWriter.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "Zip.h"
#include "weft/core/AtomicFile.h"
#include "weft/core/Contract.h"
#include "weft/core/Direction.h"
#include "weft/io/ImageFile.h"
#include "weft/io/ParallelTry.h"

namespace weft {
namespace {

constexpr int kJpegQuality = 95;

// "030" for whole degrees, as UBO2003 writes them; decimals where a direction needs them.
std::string angleText(double degrees) {
  const double rounded = std::round(degrees * 1000.0) / 1000.0;
  if (rounded == std::round(rounded)) return fmt::format("{:03.0f}", rounded);
  return fmt::format("{:07.3f}", rounded);
}

struct DirectionName {
  std::string theta;
  std::string phi;
};

DirectionName nameOf(glm::vec3 direction) {
  const glm::dvec2 degrees = degreesFromDirection(direction);
  const bool fullTurn = degrees.y > 359.9995;
  return {angleText(degrees.x), angleText(fullTurn ? 0.0 : degrees.y)};
}

std::string entryName(const BtfDescription& d, std::size_t view, std::size_t light) {
  const DirectionName v = nameOf(d.views[view]);
  const DirectionName l = nameOf(d.lights[light]);
  return fmt::format("UBO2003/{0}{1}/tv{2}_pv{3}/{4:05} tl{5} pl{6} tv{2} pv{3}.jpg", d.name, d.width,
                     v.theta, v.phi, light, l.theta, l.phi);
}

// Encodes a view when libzip asks for the first of its images, and keeps it until the next one is
// asked for.
class ViewEncoder {
 public:
  using ReadView = std::function<Result<void>(int view, std::span<float> out)>;
  using Jpeg = std::vector<std::uint8_t>;

  ViewEncoder(const BtfDescription& description, const ReadView& readView)
      : description_(description), readView_(readView) {}

  // Null after a failure.
  const Jpeg* image(int view, std::size_t light) {
    if (!error && view != encodedView_) {
      if (Result<void> result = encode(view); !result) error = result.error();
      encodedView_ = view;
    }
    return error ? nullptr : &jpegs_[light];
  }

  std::optional<Error> error;

 private:
  Result<void> encode(int view) {
    const std::size_t values = description_.texels() * 3;
    linear_.resize(description_.lights.size() * values);
    WEFT_TRY_VOID(readView_(view, linear_));
    jpegs_.resize(description_.lights.size());
    return parallelTry(static_cast<int>(jpegs_.size()), [&](int light) -> Result<void> {
      const std::size_t index = static_cast<std::size_t>(light);
      Image image(description_.width, description_.height, 3);
      for (std::size_t i = 0; i < values; ++i) {
        const float stored = weft::encode(Encoding::Gamma22, linear_[index * values + i]);
        const float shown = stored > 0.0f ? std::min(stored, 1.0f) : 0.0f;
        image.bytes[i] = static_cast<std::uint8_t>(std::lround(255.0f * shown));
      }
      WEFT_TRY(jpegs_[index], encodeJpeg(image, kJpegQuality));
      return {};
    });
  }

  const BtfDescription& description_;
  const ReadView& readView_;
  std::vector<float> linear_;
  std::vector<Jpeg> jpegs_;
  int encodedView_ = -1;
};

// One image as libzip sees it.
struct ImageEntry {
  ViewEncoder* encoder = nullptr;
  int view = 0;
  std::size_t light = 0;
  std::size_t position = 0;
  zip_error_t error{};
};

zip_int64_t failed(ImageEntry& entry, int code) {
  zip_error_set(&entry.error, code, 0);
  return -1;
}

zip_int64_t serveImage(void* user, void* data, zip_uint64_t length, zip_source_cmd_t command) {
  ImageEntry& entry = *static_cast<ImageEntry*>(user);
  switch (command) {
    case ZIP_SOURCE_SUPPORTS:
      return zip_source_make_command_bitmap(ZIP_SOURCE_OPEN, ZIP_SOURCE_READ, ZIP_SOURCE_CLOSE,
                                            ZIP_SOURCE_STAT, ZIP_SOURCE_ERROR, ZIP_SOURCE_FREE, -1);
    case ZIP_SOURCE_OPEN:
      entry.position = 0;
      return 0;
    case ZIP_SOURCE_READ: {
      const ViewEncoder::Jpeg* jpeg = entry.encoder->image(entry.view, entry.light);
      if (!jpeg) return failed(entry, ZIP_ER_READ);
      const std::size_t count = std::min<std::size_t>(length, jpeg->size() - entry.position);
      std::copy_n(jpeg->data() + entry.position, count, static_cast<std::uint8_t*>(data));
      entry.position += count;
      return static_cast<zip_int64_t>(count);
    }
    case ZIP_SOURCE_STAT: {
      const ViewEncoder::Jpeg* jpeg = entry.encoder->image(entry.view, entry.light);
      if (!jpeg) return failed(entry, ZIP_ER_READ);
      zip_stat_t* stat = static_cast<zip_stat_t*>(data);
      zip_stat_init(stat);
      stat->size = jpeg->size();
      stat->valid = ZIP_STAT_SIZE;
      return sizeof(*stat);
    }
    case ZIP_SOURCE_ERROR:
      return zip_error_to_data(&entry.error, data, length);
    case ZIP_SOURCE_CLOSE:
    case ZIP_SOURCE_FREE:
      return 0;
    default:
      return failed(entry, ZIP_ER_OPNOTSUPP);
  }
}

Result<void> addEntry(zip_t* archive, const std::string& name, ImageEntry& entry) {
  constexpr zip_uint16_t kNewYear1980 =
      33;  // MS-DOS date; no real time, so that equal input gives equal bytes
  zip_source_t* source = zip_source_function(archive, serveImage, &entry);
  const zip_int64_t index = source ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
  if (index < 0) {
    zip_source_free(source);
    return fail(zip_strerror(archive), name);
  }
  const auto added = static_cast<zip_uint64_t>(index);
  if (zip_set_file_compression(archive, added, ZIP_CM_STORE, 0) != 0 ||
      zip_file_set_dostime(archive, added, 0, kNewYear1980, 0) != 0)
    return fail(zip_strerror(archive), name);
  return {};
}

}  // namespace

Result<void> writeBtfZip(const std::filesystem::path& path, const BtfDescription& description,
                         const ViewEncoder::ReadView& readView) {
  WEFT_EXPECT(description.encoding == Encoding::Gamma22 && description.cosineInData,
              "UBO2003's layout is gamma 2.2 with the cosine in the data");
  WEFT_TRY(AtomicFile file, AtomicFile::create(path));
  const std::size_t lights = description.lights.size();
  ViewEncoder encoder(description, readView);
  std::vector<ImageEntry> entries(description.views.size() * lights);  // outlives the archive

  int code = 0;
  Zip archive(zip_open(file.temporary().c_str(), ZIP_CREATE | ZIP_TRUNCATE, &code));
  if (!archive) return fail("the zip cannot be made", path.string());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::size_t view = i / lights;
    const std::size_t light = i % lights;
    entries[i].encoder = &encoder;
    entries[i].view = static_cast<int>(view);
    entries[i].light = light;
    WEFT_TRY_VOID(addEntry(archive.get(), entryName(description, view, light), entries[i]));
  }
  if (zip_close(archive.get()) != 0) {
    if (encoder.error) return tl::unexpected<Error>(*encoder.error);
    return fail(std::string("the zip cannot be written: ") + zip_strerror(archive.get()), path.string(),
                "is the disk full?");
  }
  archive.release();
  return file.commit();
}

}  // namespace weft
