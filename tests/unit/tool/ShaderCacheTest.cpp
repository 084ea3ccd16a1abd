#include "weft/tool/ShaderCache.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <limits>
#include <string>

#include "TestSupport.h"

namespace weft {
namespace {

bool isSetTo(const char* name, const std::string& value) {
  const char* there = std::getenv(name);
  return there && value == there;
}

TEST(ShaderCache, LiesWhereMesaPutsIt) {
  setenv("HOME", "/home/ada", 1);
  unsetenv("XDG_CACHE_HOME");
  EXPECT_EQ(shaderCacheFolder(), "/home/ada/.cache/mesa_shader_cache");
  setenv("XDG_CACHE_HOME", "/cache", 1);
  EXPECT_EQ(shaderCacheFolder(), "/cache/mesa_shader_cache");
  setenv("MESA_SHADER_CACHE_DIR", "/mesa", 1);
  EXPECT_EQ(shaderCacheFolder(), "/mesa/mesa_shader_cache");
}

TEST(ShaderCache, SpaceIsAskedOfTheNearestFolderThatIsThere) {
  const std::filesystem::path folder = test::testFolder() / "not" / "there";
  EXPECT_FALSE(hasLessSpace(folder, 1));
  EXPECT_TRUE(hasLessSpace(folder, std::numeric_limits<std::uint64_t>::max()));
  EXPECT_FALSE(hasLessSpace("", 1));
}

TEST(ShaderCache, StaysOnADiskWithSpaceAndGoesOnAFullOne) {
  unsetenv("MESA_SHADER_CACHE_DISABLE");
  setenv("MESA_SHADER_CACHE_DIR", test::testFolder().c_str(), 1);
  avoidShaderCacheOnFullDisk();
  EXPECT_EQ(std::getenv("MESA_SHADER_CACHE_DISABLE"), nullptr);
  setenv("MESA_SHADER_CACHE_DIR", "/proc/self", 1);  // a file system without any space
  avoidShaderCacheOnFullDisk();
  EXPECT_TRUE(isSetTo("MESA_SHADER_CACHE_DISABLE", "true"));
  setenv("MESA_SHADER_CACHE_DISABLE", "false", 1);  // what a user asks for stays
  avoidShaderCacheOnFullDisk();
  EXPECT_TRUE(isSetTo("MESA_SHADER_CACHE_DISABLE", "false"));
}

}  // namespace
}  // namespace weft
