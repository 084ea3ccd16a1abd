#include "OutputCheck.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>

#include "weft/core/AtomicFile.h"

namespace weft {
namespace {

namespace fs = std::filesystem;

// Errors of a question about a file mean no: what is wrong with it is told by who reads or writes
// it.
bool isSame(const fs::path& a, const fs::path& b) {
  std::error_code ignored;
  return fs::equivalent(a, b, ignored);
}

bool isRegular(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored);
}

std::string lowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::ranges::transform(extension, extension.begin(), [](unsigned char c) { return std::tolower(c); });
  return extension;
}

bool isPicture(const fs::path& file) {
  constexpr std::array kExtensions{".jpg", ".jpeg", ".png", ".tif", ".tiff", ".hdr"};
  return std::ranges::find(kExtensions, lowerExtension(file)) != kExtensions.end();
}

bool isBelow(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path whole = fs::canonical(file, error), top = fs::canonical(folder, error);
  return !error && std::ranges::mismatch(top, whole).in1 == top.end();
}

/// Whether `output` is a photograph of a folder or light list that is read.
bool isPictureOf(const fs::path& output, const fs::path& input) {
  if (!isRegular(output) || !isPicture(output)) return false;
  std::error_code ignored;
  if (fs::is_directory(input, ignored)) return isBelow(output, input);
  return lowerExtension(input) == ".lp" && isBelow(output, fs::absolute(input, ignored).parent_path());
}

}  // namespace

std::vector<fs::path> existingFiles(const std::vector<std::string>& words) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const std::string& word : words)
    for (const std::string& name : {word, word.substr(word.find('=') + 1)})
      if (fs::exists(name, ignored)) files.emplace_back(name);
  return files;
}

Result<void> checkOutputFile(const fs::path& output, const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs)
    if (isSame(output, input) || isPictureOf(output, input))
      return fail("the output would replace an input", output.string(), "give another name");
  const auto writable = AtomicFile::create(output);
  if (!writable) return tl::unexpected<Error>(writable.error());
  return {};
}

Result<void> checkStdout(const std::vector<fs::path>& inputs) {
  for (const fs::path& input : inputs)
    if (isRegular(input) && isSame("/dev/stdout", input))
      return fail("stdout goes into an input", input.string(), "give another name");
  return {};
}

Result<void> checkDistinct(const std::vector<fs::path>& outputs) {
  std::set<fs::path> seen;
  std::error_code error;
  for (const fs::path& output : outputs) {
    const bool replaced = isRegular(output) || !fs::exists(output, error);
    if (replaced && !seen.insert(fs::weakly_canonical(output, error)).second)
      return fail("two outputs are one file", output.string(), "give them different names");
  }
  return {};
}

}  // namespace weft
