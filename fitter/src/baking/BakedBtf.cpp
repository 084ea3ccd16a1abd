#include "weft/baking/BakedBtf.h"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numeric>
#include <utility>

#include "weft/core/Contract.h"
#include "weft/measurement/BtfWriter.h"

namespace weft {

namespace {

/// Beside the output, because the system's folder for temporary files is often kept in memory;
/// without a name where the file system can, so that nothing stays of a program that is killed.
Result<std::unique_ptr<std::FILE, int (*)(std::FILE*)>> openScratch(const std::filesystem::path& folder) {
  int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  if (std::string name = (folder / ".weft-bake-XXXXXX").string(); descriptor < 0) {
    descriptor = mkstemp(name.data());
    if (descriptor >= 0) unlink(name.c_str());
  }
  if (descriptor < 0)
    return fail("cannot create a scratch file", folder.string(),
                "does the folder exist, and is it writable?");
  std::FILE* file = fdopen(descriptor, "w+b");
  if (!file) close(descriptor);
  if (!file) return fail("cannot open a scratch file", folder.string());
  return std::unique_ptr<std::FILE, int (*)(std::FILE*)>(file, &std::fclose);
}

}  // namespace

BakedBtf::BakedBtf(File scratch, BakeOptions options)
    : scratch_(std::move(scratch)), options_(std::move(options)) {}

Result<BakedBtf> BakedBtf::bake(const BtfBaker& baker, const std::filesystem::path& folder,
                                const Progress& progress) {
  const BakeOptions& options = baker.options();
  WEFT_TRY(File scratch, openScratch(folder));
  BakedBtf baked(std::move(scratch), options);
  const std::size_t texels =
      static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  std::vector<float> view(options.lights.size() * texels * 3);
  for (std::size_t i = 0; i < options.views.size(); ++i) {
    baker.bakeView(static_cast<int>(i), view);
    WEFT_TRY_VOID(baked.append(view, folder));
    if (progress) progress(static_cast<double>(i + 1) / static_cast<double>(options.views.size()));
  }
  return baked;
}

Result<void> BakedBtf::append(std::span<const float> view, const std::filesystem::path& folder) {
  halfs_.resize(view.size());
  for (std::size_t i = 0; i < view.size(); ++i) {
    halfs_[i] = glm::packHalf1x16(view[i]);
    WEFT_EXPECT(halfs_[i] < counts_.size(), "baked values are not negative");
    ++counts_[halfs_[i]];
  }
  if (std::fwrite(halfs_.data(), sizeof(std::uint16_t), halfs_.size(), scratch_.get()) != halfs_.size())
    return fail("cannot write a scratch file", folder.string(), "is the disk full?");
  return {};
}

double BakedBtf::clippedShare(float scale) const {
  std::uint64_t clipped = 0;
  for (std::size_t bits = 0; bits < counts_.size(); ++bits)
    if (glm::unpackHalf1x16(static_cast<std::uint16_t>(bits)) * scale > 1.0f) clipped += counts_[bits];
  const std::uint64_t all = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
  return static_cast<double>(clipped) / static_cast<double>(all);
}

float BakedBtf::scaleFor(double clippedShare) const {
  const std::uint64_t all = std::accumulate(counts_.begin(), counts_.end(), std::uint64_t{0});
  const auto allowed = static_cast<std::uint64_t>(clippedShare * static_cast<double>(all));
  std::size_t brightest = counts_.size() - 1;  // that must not clip
  for (std::uint64_t above = counts_[brightest]; brightest > 0 && above <= allowed;
       above += counts_[brightest])
    --brightest;
  const float value = glm::unpackHalf1x16(static_cast<std::uint16_t>(brightest));
  if (!(value > 1.0f)) return 1.0f;
  const float scale = 1.0f / value;
  return scale * value > 1.0f ? std::nextafter(scale, 0.0f) : scale;
}

Result<void> BakedBtf::writeZip(const std::filesystem::path& path, const std::string& name, float scale,
                                const Progress& progress) {
  const BtfDescription description{.width = options_.width,
                                   .height = options_.height,
                                   .views = options_.views,
                                   .lights = options_.lights,
                                   .encoding = Encoding::Gamma22,
                                   .cosineInData = true,
                                   .name = name};
  if (std::fflush(scratch_.get()) != 0) return fail("cannot write a scratch file", {}, "is the disk full?");
  std::rewind(scratch_.get());
  return writeBtfZip(path, description, [&](int view, std::span<float> out) -> Result<void> {
    if (std::fread(halfs_.data(), sizeof(std::uint16_t), halfs_.size(), scratch_.get()) != halfs_.size())
      return fail("cannot read the scratch file", path.string());
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = scale * glm::unpackHalf1x16(halfs_[i]);
    if (progress) progress(static_cast<double>(view + 1) / static_cast<double>(options_.views.size()));
    return {};
  });
}

}  // namespace weft
