#include "TestSupport.h"

#include <sys/resource.h>

#include <cstdlib>

namespace weft::test {

std::filesystem::path dataFile(const std::string& name) {
  const char* folder = std::getenv("WEFT_DATA");
  return folder && *folder ? std::filesystem::path(folder) / name : std::filesystem::path();
}

std::filesystem::path sourceFolder() {
  return WEFT_SOURCE_DIR;
}
std::filesystem::path programFolder() {
  return std::filesystem::path(WEFT_BINARY_DIR) / "bin";
}

std::uint64_t peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

std::filesystem::path testFolder() {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  std::string name = std::string(test->test_suite_name()) + "." + test->name();
  for (char& c : name)
    if (c == '/') c = '-';
  const std::filesystem::path folder = std::filesystem::path(WEFT_BINARY_DIR) / "test-output" / name;
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace weft::test
