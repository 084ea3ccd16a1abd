#include "weft/io/FileBytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <system_error>

#include "weft/io/WithinMemory.h"

namespace weft {

namespace {

constexpr const char* kCheckPermissions = "check the permissions of the file and of the folders it is in";

Result<std::vector<std::uint8_t>> firstBytes(const std::filesystem::path& path, std::size_t count) {
  return withinMemory(path.string(), [&]() -> Result<std::vector<std::uint8_t>> {
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    std::vector<std::uint8_t> bytes(stream ? count : 0);
    stream.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (!stream) {
      const std::string reason = errno ? std::generic_category().message(errno) : "it has become shorter";
      return fail("cannot be read: " + reason, path.string(), kCheckPermissions);
    }
    return bytes;
  });
}

}  // namespace

Result<std::uint64_t> regularFileSize(const std::filesystem::path& path) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found) return fail("no such file", path.string());
  if (error) return fail("cannot be read: " + error.message(), path.string(), kCheckPermissions);
  if (status.type() == std::filesystem::file_type::directory)
    return fail("cannot be read: a folder, not a file", path.string());
  if (status.type() != std::filesystem::file_type::regular)
    return fail("cannot be read: not a file", path.string());
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return fail("cannot be read: " + error.message(), path.string());
  return std::uint64_t{size};
}

Result<std::vector<std::uint8_t>> readFileBytes(const std::filesystem::path& path, std::size_t limit) {
  WEFT_TRY(const std::uint64_t size, regularFileSize(path));
  if (size > limit)
    return fail(fmt::format("the file has {} bytes, more than the {} allowed", size, limit), path.string());
  return firstBytes(path, size);
}

Result<std::vector<std::uint8_t>> readFileStart(const std::filesystem::path& path, std::size_t count) {
  WEFT_TRY(const std::uint64_t size, regularFileSize(path));
  return firstBytes(path, std::min<std::uint64_t>(count, size));
}

}  // namespace weft
