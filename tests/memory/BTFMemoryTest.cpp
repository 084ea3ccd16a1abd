// How much memory a loaded material keeps: a program of its own, since it counts every operator
// new.
#include <gtest/gtest.h>
#include <malloc.h>

#include <atomic>
#include <cmath>
#include <cstdlib>
#include <new>

#include "GlTest.h"
#include "TestSupport.h"
#include "weft/core/Direction.h"
#include "weft/io/ReflectanceFieldFile.h"
#include "weft/scene_io/BTFMaterialLoader.h"
#include "weft/scenegraph/Light.h"

namespace {

std::atomic<std::size_t> liveBytes = 0;
std::atomic<std::size_t> mostBytes = 0;

void* counted(void* memory) {
  if (!memory) throw std::bad_alloc();
  const std::size_t live = liveBytes += malloc_usable_size(memory);
  std::size_t most = mostBytes;
  while (live > most && !mostBytes.compare_exchange_weak(most, live)) {
  }
  return memory;
}

void release(void* memory) {
  if (memory) liveBytes -= malloc_usable_size(memory);
  std::free(memory);
}

}  // namespace

void* operator new(std::size_t size) {
  return counted(std::malloc(size));
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
void operator delete(void* memory) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  release(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  release(memory);
}

namespace weft::test {
namespace {

constexpr double kMegabyte = 1e6;

FloatImage smoothNumbers(int size, const std::vector<std::string>& channels, int layers) {
  FloatImage image(size, size, channels, layers);
  for (std::size_t i = 0; i < image.values().size(); ++i)
    image.values()[i] = 0.5f + 0.001f * static_cast<float>(i % 251);
  image.roundToHalf();
  return image;
}

// Two lobes and 81 views, as of UBO2003.
std::filesystem::path writtenField(const std::filesystem::path& folder, int size) {
  const auto model = valueOf(ModelRegistry::builtin().create({.name = "rfnl", .options = {{"lobes", 2}}}));
  ReflectanceFieldDescription description;
  for (int i = 0; i < 81; ++i)
    description.views.push_back(directionFromDegrees(75.0 * std::sqrt(i / 80.0), 137.5 * i));
  description.lights = description.views;
  const std::filesystem::path path = folder / (std::to_string(size) + ".rf.exr");
  requireDone(writeReflectanceField(
      valueOf(ReflectanceField::create(model, description, smoothNumbers(size, model->sharedChannels(), 1),
                                       smoothNumbers(size, model->layerChannels(), 81))),
      path));
  return path;
}

class BTFMemoryTest : public GlTest {
 protected:
  std::shared_ptr<Node> drawn(const std::filesystem::path& file) {
    auto root = dressed(valueOf(loadBTFMaterial(file)));
    root->addChild(std::make_shared<DirectionalLight>(glm::vec3(3)));
    EXPECT_GT(picture(*root).at(4, 4, 0), 0.1f);
    return root;
  }
};

TEST_F(BTFMemoryTest, ALargeFieldLeavesLittleBesideGlsCopy) {
  const auto folder = testFolder();
  const auto small = writtenField(folder, 4), large = writtenField(folder, 256);
  const auto before = drawn(small);  // threads, tables and programs that come with the first
  const std::size_t liveBefore = liveBytes;
  mostBytes = liveBefore;
  const auto after = drawn(large);
  const double left = static_cast<double>(liveBytes - liveBefore) / kMegabyte;
  const double peak = static_cast<double>(mostBytes - liveBefore) / kMegabyte;
  std::printf("[   MEMORY ] left %.1f MB, at most %.1f MB while it was loaded and drawn first\n", left, peak);
  EXPECT_LE(left, 20.0);
  EXPECT_LE(peak, 300.0);
}

}  // namespace
}  // namespace weft::test
