#include "weft/measurement/BtfSource.h"

#include <algorithm>
#include <optional>

#include "AngleImages.h"
#include "LightList.h"

namespace weft {

namespace fs = std::filesystem;

namespace {

bool isLightList(const fs::path& file) {
  return file.extension() == ".lp" || file.extension() == ".LP";
}

// The one of a folder itself, not of folders in it.
std::optional<std::string> onlyLightList(const FileCollection& folder) {
  std::optional<std::string> only;
  for (const std::string& name : folder.names()) {
    if (name.find('/') != std::string::npos || !isLightList(name)) continue;
    if (only) return std::nullopt;
    only = name;
  }
  return only;
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

Result<std::unique_ptr<BtfSource>> openBtf(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return fail("no such file or folder", path.string());
  const bool isFolder = fs::is_directory(path, error);
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path();  // "wool/" is named wool
  const std::string name = isFolder ? named.filename().string() : named.stem().string();
  if (!isFolder && isLightList(path)) return openLightList(path, name);

  WEFT_TRY(std::unique_ptr<FileCollection> files, isFolder ? openFolder(path) : openZip(path));
  if (isFolder && !hasAngleImages(*files))
    if (const auto list = onlyLightList(*files)) return openLightList(path / *list, name);
  return openAngleImages(std::move(files), path.string(), name);
}

}  // namespace weft
