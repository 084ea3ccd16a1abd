#include "weft/measurement/BtfSource.h"

#include <algorithm>
#include <optional>

#include "AngleImages.h"
#include "LightList.h"
#include "weft/core/FileKind.h"
#include "weft/io/FileBytes.h"

namespace weft {

namespace fs = std::filesystem;

namespace {

// Light lists are told by their name, as nothing in them tells.
Result<void> checkIsMeasurement(const fs::path& file) {
  const FileKind kind = fileKind(file);
  if (kind == FileKind::Zip || kind == FileKind::Unknown) return {};  // programs may precede a zip
  return failOtherKind(kind, "a measurement", file.string());
}

Result<std::unique_ptr<FileCollection>> openFiles(const fs::path& path, bool isFolder) {
  if (isFolder) return openFolder(path);
  WEFT_TRY_VOID(checkIsMeasurement(path));
  return openZip(path);
}

}  // namespace

std::size_t BtfDescription::rowBytes() const {
  const std::size_t sampleBytes = 3 * (storedAsBytes ? sizeof(std::uint8_t) : sizeof(float));
  return static_cast<std::size_t>(width) * views.size() * lights.size() * sampleBytes;
}

int BtfSource::rowsWithin(std::size_t bytes) const {
  const BtfDescription& d = description();
  return static_cast<int>(
      std::clamp<std::size_t>(bytes / d.rowBytes(), 1, static_cast<std::size_t>(d.height)));
}

Result<std::unique_ptr<BtfSource>> openBtf(const fs::path& path, const BtfOptions& options) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) return fail("no such file or folder", path.string());
  const bool isFolder = status.type() == fs::file_type::directory;
  if (!isFolder) WEFT_TRY_VOID(regularFileSize(path));
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  // "wool/" is named wool
  const fs::path named = whole.has_filename() ? whole : whole.parent_path();
  const std::string name = isFolder ? named.filename().string() : named.stem().string();
  if (!isFolder && isLightList(path.string())) return openLightList(path, name, options);

  WEFT_TRY(std::unique_ptr<FileCollection> files, openFiles(path, isFolder));
  std::optional<int> list;
  if (!hasAngleImages(*files)) {
    WEFT_TRY(list, findLightList(*files, path.string()));
  }
  if (list && isFolder)
    return openLightList(path / files->names()[static_cast<std::size_t>(*list)], name, options);
  if (list) return openLightList(std::move(files), *list, path.string(), name, options);
  if (options.imagesInOrder)
    return fail("only the images of a light list can be taken in order", path.string());
  return openAngleImages(std::move(files), path.string(), name);
}

}  // namespace weft
