#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <zip.h>

#include "FileCollection.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

struct DiscardZip {
  void operator()(zip_t* archive) const { zip_discard(archive); }
};
using Zip = std::unique_ptr<zip_t, DiscardZip>;

struct CloseEntry {
  void operator()(zip_file_t* entry) const { zip_fclose(entry); }
};
using ZipEntry = std::unique_ptr<zip_file_t, CloseEntry>;

Result<Zip> openArchive(const std::filesystem::path& path, int flags) {
  int code = 0;
  Zip archive(zip_open(path.c_str(), ZIP_RDONLY | flags, &code));
  if (archive) return archive;
  zip_error_t error;
  zip_error_init_with_code(&error, code);
  const std::string reason = zip_error_strerror(&error);
  zip_error_fini(&error);
  return fail("not a complete zip: " + reason, path.string(), "download or copy the file again");
}

class ZipCollection : public FileCollection {
 public:
  ZipCollection(std::filesystem::path path, Zip archive) : path_(std::move(path)) {
    const zip_int64_t count = zip_get_num_entries(archive.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) {
      const char* name = zip_get_name(archive.get(), static_cast<zip_uint64_t>(i), 0);
      names_.emplace_back(name ? name : "");
    }
    archives_.local() = std::move(archive);
  }

  const std::vector<std::string>& names() const override { return names_; }

  Result<std::vector<std::uint8_t>> read(int index) const override {
    const std::string where = path_.string() + ": " + names_[static_cast<std::size_t>(index)];
    Zip& archive = archives_.local();
    if (!archive) {
      WEFT_TRY(archive, openArchive(path_, 0));
    }
    const auto entryIndex = static_cast<zip_uint64_t>(index);
    zip_stat_t stat;
    if (zip_stat_index(archive.get(), entryIndex, 0, &stat) != 0 || !(stat.valid & ZIP_STAT_SIZE))
      return damaged(zip_strerror(archive.get()), where);
    if (stat.size > kLargestImageFile)
      return fail(fmt::format("the entry unpacks to {} bytes, more than the {} allowed", stat.size,
                              kLargestImageFile),
                  where);
    const ZipEntry entry(zip_fopen_index(archive.get(), entryIndex, 0));
    if (!entry) return damaged(zip_strerror(archive.get()), where);
    std::vector<std::uint8_t> bytes(stat.size);
    std::uint8_t beyond = 0;
    // Reading past the end makes libzip compare the checksum.
    if (zip_fread(entry.get(), bytes.data(), bytes.size()) != static_cast<zip_int64_t>(bytes.size()) ||
        zip_fread(entry.get(), &beyond, 1) != 0)
      return damaged(zip_file_strerror(entry.get()), where);
    return bytes;
  }

 private:
  static tl::unexpected<Error> damaged(const std::string& reason, const std::string& where) {
    return fail("the entry of the zip is damaged: " + reason, where, "download or copy the file again");
  }

  std::filesystem::path path_;
  std::vector<std::string> names_;
  // libzip's handles are not thread safe: every thread opens its own.
  mutable tbb::enumerable_thread_specific<Zip> archives_;
};

}  // namespace

Result<std::unique_ptr<FileCollection>> openZip(const std::filesystem::path& path) {
  WEFT_TRY(Zip archive, openArchive(path, ZIP_CHECKCONS));
  return std::make_unique<ZipCollection>(path, std::move(archive));
}

}  // namespace weft
