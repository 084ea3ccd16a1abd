#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "FileCollection.h"
#include "FilePath.h"
#include "Zip.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
using ZipEntry = std::unique_ptr<zip_file_t, CloseEntry>;

// Deflate makes no more of a byte; images are packed already.
constexpr std::uint64_t kLargestRatio = 1032;

Result<Zip> openArchive(const std::filesystem::path& path, int flags) {
  int code = 0;
  errno = 0;
  Zip archive(zip_open(path.c_str(), ZIP_RDONLY | flags, &code));
  if (archive) return archive;
  if (code == ZIP_ER_MEMORY) return fail("there is no memory to read the zip's list of files", path.string());
  if (code == ZIP_ER_OPEN || code == ZIP_ER_READ || code == ZIP_ER_SEEK)
    return fail("cannot be read: " + std::generic_category().message(errno), path.string());
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  return fail("not a complete zip: " + reason, path.string(), "download or copy the file again");
}

// With '/' between its parts also where Windows has packed it.
std::string nameOf(zip_t* archive, zip_uint64_t entry) {
  const char* name = zip_get_name(archive, entry, 0);
  std::string path = name ? name : "";
  std::ranges::replace(path, '\\', '/');
  return path;
}

tl::unexpected<Error> damaged(const std::string& reason, const std::string& where) {
  return fail("the entry of the zip is damaged: " + reason, where, "download or copy the file again");
}

// What libzip says of an entry: damage, or a password, a compression it does not know, no memory.
tl::unexpected<Error> unreadable(zip_error_t* error, const std::string& where) {
  const std::string reason = zip_error_strerror(error);
  switch (zip_error_code_zip(error)) {
    case ZIP_ER_CRC:
    case ZIP_ER_EOF:
    case ZIP_ER_INCONS:
    case ZIP_ER_NOZIP:
    case ZIP_ER_ZLIB:
    case ZIP_ER_OK:  // shorter than it says
      return damaged(reason, where);
    default:
      return fail("the entry of the zip cannot be unpacked: " + reason, where);
  }
}

class ZipCollection : public FileCollection {
 public:
  ZipCollection(std::filesystem::path path, Zip archive) : path_(std::move(path)) {
    const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(archive.get(), 0));
    for (zip_uint64_t i = 0; i < count; ++i) {
      std::string name = nameOf(archive.get(), i);
      if (name.ends_with('/') || isClutter(name)) continue;
      names_.push_back(std::move(name));
      entries_.push_back(i);
    }
    archives_.local() = std::move(archive);
  }

  const std::vector<std::string>& names() const override { return names_; }

  Result<std::vector<std::uint8_t>> read(int index) const override {
    const std::string where = whereOf(index);
    WEFT_TRY(zip_t* const archive, archiveOfThread());
    WEFT_TRY(const zip_stat_t stat, statOf(index));
    WEFT_TRY_VOID(checkSize(stat, where));
    const ZipEntry entry(zip_fopen_index(archive, entries_[static_cast<std::size_t>(index)], 0));
    if (!entry) return unreadable(zip_get_error(archive), where);
    std::vector<std::uint8_t> bytes(stat.size);
    std::uint8_t beyond = 0;
    // Reading past the end makes libzip compare the checksum.
    if (zip_fread(entry.get(), bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size()) ||
        zip_fread(entry.get(), &beyond, 1) != 0)
      return unreadable(zip_file_get_error(entry.get()), where);
    return bytes;
  }

  // Zips know the checksums of their files.
  Result<std::uint64_t> checksum(int index) const override {
    WEFT_TRY(const zip_stat_t stat, statOf(index));
    return stat.size << 32 ^ stat.crc;
  }

 private:
  static Result<void> checkSize(const zip_stat_t& stat, const std::string& where) {
    if (stat.size > kLargestImageFile)
      return fail(fmt::format("the entry unpacks to {} bytes, more than the {} allowed", stat.size,
                              kLargestImageFile),
                  where);
    if (stat.size / kLargestRatio > stat.comp_size)
      return damaged(fmt::format("{} bytes are said to unpack to {}", stat.comp_size, stat.size), where);
    return {};
  }

  std::string whereOf(int index) const {
    return path_.string() + ": " + names_[static_cast<std::size_t>(index)];
  }

  Result<zip_t*> archiveOfThread() const {
    Zip& archive = archives_.local();
    if (!archive) {
      WEFT_TRY(archive, openArchive(path_, 0));
    }
    return archive.get();
  }

  Result<zip_stat_t> statOf(int index) const {
    WEFT_TRY(zip_t* const archive, archiveOfThread());
    zip_stat_t stat;
    constexpr zip_uint64_t kWanted = ZIP_STAT_SIZE | ZIP_STAT_COMP_SIZE | ZIP_STAT_CRC;
    if (zip_stat_index(archive, entries_[static_cast<std::size_t>(index)], 0, &stat) != 0 ||
        (stat.valid & kWanted) != kWanted)
      return unreadable(zip_get_error(archive), whereOf(index));
    return stat;
  }

  std::filesystem::path path_;
  std::vector<std::string> names_;
  std::vector<zip_uint64_t> entries_;  ///< their places in the zip
  // libzip's handles are not thread safe: every thread opens its own.
  mutable tbb::enumerable_thread_specific<Zip> archives_;
};

}  // namespace

Result<std::unique_ptr<FileCollection>> openZip(const std::filesystem::path& path) {
  WEFT_TRY(Zip archive, openArchive(path, ZIP_CHECKCONS));
  return std::make_unique<ZipCollection>(path, std::move(archive));
}

}  // namespace weft
