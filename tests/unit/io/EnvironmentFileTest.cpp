#include "weft/io/EnvironmentFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "TestImages.h"
#include "TestSupport.h"
#include "weft/core/AtomicFile.h"
#include "weft/io/ExrFile.h"
#include "weft/io/FileBytes.h"

namespace weft::test {
namespace {

using testing::HasSubstr;

/// One bit of it.
Bytes altered(Bytes bytes, std::size_t place) {
  bytes[place] ^= 1;
  return bytes;
}

TEST(EnvironmentFile, OpenExrIsReadToo) {
  FloatImage image(4, 2, {"R", "G", "B"});
  image.at(2, 1, 1) = 7.0f;
  const auto file = testFolder() / "a.exr";
  requireDone(writeExr(file, image));
  std::vector<std::string> warnings;
  EXPECT_EQ(valueOf(readEnvironment(file, warnings)).texel(2, 1), glm::vec3(0, 7, 0));
  EXPECT_TRUE(warnings.empty());
  requireDone(writeWholeFile(testFolder() / "b.hdr", "no picture"));
  EXPECT_THAT(readEnvironment(testFolder() / "b.hdr", warnings).error().message(), HasSubstr("b.hdr"));
}

// What comes from the cache is what was made. What is not as it was written is made again, and
// said: a file cut off, one of another picture, and one of which a single bit is another, where the
// value is as good as any.
TEST(EnvironmentCache, GivesBackWhatItWasGiven) {
  const Environment environment = valueOf(Environment::builtin("studio")).reduced(64, 32);
  const auto folder = testFolder() / "cache";
  std::vector<std::string> warnings;
  const PrefilteredEnvironment made = prefilter(environment, folder, warnings);
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
  const std::filesystem::path file = std::filesystem::directory_iterator(folder)->path();
  const Bytes whole = bytesOf(file);
  const auto expectSame = [&] {
    const PrefilteredEnvironment other = prefilter(environment, folder, warnings);
    EXPECT_EQ(other.scale, made.scale);
    EXPECT_TRUE(std::ranges::equal(other.lobes.values(), made.lobes.values()));
    EXPECT_TRUE(std::ranges::equal(other.moments.values(), made.moments.values()));
    EXPECT_TRUE(std::ranges::equal(other.glossy.values(), made.glossy.values()));
    EXPECT_EQ(other.lobes.precision(), Precision::Half);
    EXPECT_EQ(bytesOf(file), whole);
  };
  expectSame();
  EXPECT_THAT(warnings, testing::IsEmpty());

  const std::size_t picture = 30, value = whole.size() / 2;
  for (const Bytes& damaged :
       {Bytes(whole.begin(), whole.begin() + 1000), altered(whole, picture), altered(whole, value)}) {
    writeBytes(file, damaged);
    warnings.clear();
    expectSame();
    EXPECT_THAT(warnings,
                testing::ElementsAre(HasSubstr(file.filename().string() +
                                               ": the prefiltered environment is damaged; it is made anew")));
  }
}

TEST(EnvironmentFile, SaysWhatAFileIsAndWhatIsBuiltIn) {
  std::vector<std::string> warnings;
  const auto file = testFolder() / "room.hdr";
  writeBytes(file, {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0});
  EXPECT_THAT(environmentNamed(file.string(), warnings).error().message(),
              HasSubstr("room.hdr: this is a PNG image, not a Radiance (.hdr) or OpenEXR picture"));
  EXPECT_EQ(environmentNamed("cellar", warnings).error().message(),
            "cellar: no such file, nor a built-in environment (built in are studio and sky)");
  EXPECT_EQ(valueOf(environmentNamed("sky", warnings)).width(), valueOf(Environment::builtin("sky")).width());
}

}  // namespace
}  // namespace weft::test
