#include "weft/io/FileBytes.h"

#include <fmt/format.h>

#include <fstream>

namespace weft {

Result<std::vector<std::uint8_t>> readFileBytes(const std::filesystem::path& path, std::size_t limit) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return fail("no such file", path.string());
  if (!std::filesystem::is_regular_file(path, error))
    return fail("cannot be read: not a file", path.string());
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return fail("cannot be read: " + error.message(), path.string());
  if (size > limit)
    return fail(fmt::format("the file has {} bytes, more than the {} allowed", size, limit), path.string());
  std::vector<std::uint8_t> bytes(size);
  std::ifstream stream(path, std::ios::binary);
  stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!stream) return fail("cannot be read", path.string(), "check its permissions");
  return bytes;
}

}  // namespace weft
