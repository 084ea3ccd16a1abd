#include "weft/tool/ShaderCache.h"

#include <pwd.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <cstdlib>

namespace weft {
namespace {

namespace fs = std::filesystem;

fs::path variable(const char* name) {
  const char* value = std::getenv(name);
  return value ? value : "";
}

}  // namespace

fs::path shaderCacheFolder() {
  for (const char* name : {"MESA_SHADER_CACHE_DIR", "MESA_GLSL_CACHE_DIR", "XDG_CACHE_HOME"})
    if (const fs::path folder = variable(name); !folder.empty()) return folder / "mesa_shader_cache";
  fs::path home = variable("HOME");
  if (const passwd* user = home.empty() ? getpwuid(getuid()) : nullptr) home = user->pw_dir;
  return home.empty() ? fs::path() : home / ".cache" / "mesa_shader_cache";
}

bool hasLessSpace(const fs::path& folder, std::uint64_t bytes) {
  struct statvfs disk {};
  fs::path there = folder;
  while (statvfs(there.c_str(), &disk) != 0) {
    if (!there.has_relative_path()) return false;  // nothing is known
    there = there.parent_path();
  }
  return std::uint64_t{disk.f_bavail} * disk.f_frsize < bytes;
}

void avoidShaderCacheOnFullDisk() {
  constexpr std::uint64_t kEnough = std::uint64_t{64} << 20;  // the empty index alone has 1.3 MB
  if (!hasLessSpace(shaderCacheFolder(), kEnough)) return;
  setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  setenv("MESA_GLSL_CACHE_DISABLE", "true", 0);  // its name in older versions
}

}  // namespace weft
