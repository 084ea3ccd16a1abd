#include "PartsFolder.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <regex>
#include <vector>

#include "weft/core/AtomicFile.h"
#include "weft/core/Checksum.h"
#include "weft/io/FileBytes.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// What a file begins with; its fingerprint and the contents follow. With a checksum, because a file
// that is renamed before its blocks reach the disk may come out of a power cut full of zeros.
struct Header {
  char magic[8] = {'w', 'e', 'f', 't', 'r', 'o', 'w', 's'};
  std::uint64_t fingerprintBytes = 0;
  std::uint64_t contentsBytes = 0;
  std::uint64_t checksum = 0;  ///< of the contents
  std::int32_t pass = 0;
  std::int32_t firstRow = 0;
  std::int32_t rowCount = 0;
  std::int32_t unused = 0;
};

constexpr const char* kLockName = "lock";

std::string fileName(int pass, RowRange rows) {
  return fmt::format("{}-{:06}-{:06}.rows", pass, rows.first, rows.first + rows.count - 1);
}

// Our files, also those of versions before passes were numbered: of one pass, or of all.
std::vector<fs::path> filesIn(const fs::path& folder, const std::string& pass) {
  const std::regex pattern(pass + "\\d{6,}-\\d{6,}\\.rows");
  std::vector<fs::path> files;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (const fs::directory_iterator end; !error && entry != end; entry.increment(error))
    if (std::regex_match(entry->path().filename().string(), pattern)) files.push_back(entry->path());
  std::ranges::sort(files);
  return files;
}

}  // namespace

PartsFolder::~PartsFolder() {
  if (!lock_) return;
  lock_.reset();
  removeIfEmpty();
}

Result<void> PartsFolder::claim() {
  WEFT_TRY_VOID(make());
  WEFT_TRY(std::optional<FileLock> lock, FileLock::tryAcquire(path_ / kLockName));
  if (!lock)
    return fail("another fit with this output is running", path_.string(),
                "wait for its end, or name another output");
  lock_.emplace(std::move(*lock));
  AtomicFile::sweep(path_);
  return {};
}

Result<void> PartsFolder::make() const {
  std::error_code error;
  fs::create_directories(path_, error);
  if (error) return fail("the folder of finished rows cannot be made: " + error.message(), path_.string());
  return {};
}

Result<void> PartsFolder::write(int pass, RowRange rows, std::span<const std::byte> contents) const {
  WEFT_TRY_VOID(make());
  Header header;
  header.pass = pass;
  header.firstRow = rows.first;
  header.rowCount = rows.count;
  header.fingerprintBytes = fingerprint_.size();
  header.contentsBytes = contents.size();
  header.checksum = checksumOf(contents);
  WEFT_TRY(AtomicFile file, AtomicFile::create(path_ / fileName(pass, rows)));
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(reinterpret_cast<const char*>(&header), sizeof header);
  stream.write(fingerprint_.data(), static_cast<std::streamsize>(fingerprint_.size()));
  stream.write(reinterpret_cast<const char*>(contents.data()), static_cast<std::streamsize>(contents.size()));
  stream.close();
  if (!stream) return fail("finished rows cannot be written", path_.string(), "is the disk full?");
  return file.commit();
}

Result<void> PartsFolder::read(int pass, int height, std::size_t largest, const Take& take) const {
  for (const fs::path& file : filesIn(path_, fmt::format("(?:{}-)?", pass)))
    WEFT_TRY_VOID(readFile(file, pass, height, largest, take));
  return {};
}

Result<void> PartsFolder::readFile(const fs::path& file, int pass, int height, std::size_t largest,
                                   const Take& take) const {
  const auto damaged = [&](std::string_view what) {
    return fail(fmt::format("finished rows are damaged: {}", what), file.string(), "delete this file");
  };
  WEFT_TRY(const std::vector<std::uint8_t> bytes,
           readFileBytes(file, sizeof(Header) + (std::size_t{1} << 20) + largest));
  std::span<const std::byte> rest = std::as_bytes(std::span(bytes));
  Header header;
  if (rest.size() < sizeof header) return damaged("too short");
  const Header expected;
  std::memcpy(&header, rest.data(), sizeof header);
  rest = rest.subspan(sizeof header);
  if (std::memcmp(header.magic, expected.magic, sizeof header.magic) != 0) return damaged("not such a file");
  if (header.fingerprintBytes > rest.size()) return damaged("too short");
  const std::string_view fingerprint(reinterpret_cast<const char*>(rest.data()), header.fingerprintBytes);
  rest = rest.subspan(header.fingerprintBytes);
  if (fingerprint != fingerprint_)
    return fail(
        fmt::format("these finished rows are of another fit: {} instead of {}", fingerprint, fingerprint_),
        file.string(), "fit with the same options, or without --resume");
  const RowRange rows{header.firstRow, header.rowCount};
  if (header.pass != pass || rows.first < 0 || rows.count < 1 || rows.count > height ||
      rows.first > height - rows.count)
    return damaged("rows that do not exist");
  if (header.contentsBytes != rest.size()) return damaged("wrong size");
  if (header.unused != 0 || header.checksum != checksumOf(rest)) return damaged("wrong checksum");
  if (!take(rows, rest)) return damaged("wrong size");
  return {};
}

void PartsFolder::remove() const {
  if (!keepsRows()) return;
  std::error_code ignored;
  for (const fs::path& file : filesIn(path_, "(?:\\d+-)?"))
    if (fs::is_regular_file(fs::symlink_status(file, ignored))) fs::remove(file, ignored);
  removeIfEmpty();
}

void PartsFolder::removeIfEmpty() const {
  std::error_code ignored;
  if (fs::is_directory(fs::symlink_status(path_, ignored))) fs::remove(path_, ignored);
}

}  // namespace weft
