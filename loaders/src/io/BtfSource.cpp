#include "weft/io/BtfSource.h"

#include <algorithm>

#include "ImageBtfSource.h"

namespace weft {

namespace fs = std::filesystem;

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
  WEFT_TRY(std::unique_ptr<FileCollection> files, isFolder ? openFolder(path) : openZip(path));
  const fs::path whole = fs::absolute(path, error).lexically_normal();
  const fs::path named = whole.has_filename() ? whole : whole.parent_path();  // "wool/" is named wool
  const std::string name = isFolder ? named.filename().string() : named.stem().string();
  return ImageBtfSource::create(std::move(files), path.string(), name);
}

}  // namespace weft
