#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "TestSupport.h"
#include "TextFile.h"

// Every file, heading and program that a page or a comment names exists.

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::readText;
using testing::IsEmpty;

const std::set<std::string> kSources{".h", ".cpp", ".glsl", ".frag", ".vert", ".md", ".sh", ".cmake", ".txt"};
const std::vector<std::string> kFolders{"core",    "shaders", "chunks",   "scenegraph", "materials",
                                        "loaders", "fitter",  "programs", "samples",    "tests",
                                        "scripts", "cmake",   "docs"};

std::vector<fs::path> filesOf(const fs::path& root) {
  std::vector<fs::path> files;
  for (const std::string& folder : kFolders)
    for (const auto& entry : fs::recursive_directory_iterator(root / folder))
      if (kSources.contains(entry.path().extension().string())) files.push_back(entry.path());
  for (const auto& entry : fs::directory_iterator(root))
    if (entry.path().extension() == ".md") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<std::smatch> matchesOf(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

// As pages on the web name headings: "A new model" is "a-new-model".
std::string anchorOf(const std::string& heading) {
  std::string anchor;
  for (const char c : heading)
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_')
      anchor += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    else if (c == ' ')
      anchor += '-';
  return anchor;
}

std::set<std::string> headingsOf(const fs::path& page) {
  static const std::regex pattern("(?:^|\\n)#+ ([^\\n]+)");
  std::set<std::string> headings;
  const std::string text = readText(page);
  for (const std::smatch& match : matchesOf(text, pattern)) {
    headings.insert(match[1]);
    headings.insert("#" + anchorOf(match[1]));
  }
  return headings;
}

class Documentation : public testing::Test {
 protected:
  void wrong(const fs::path& file, const std::string& name) {
    wrong_.push_back(file.lexically_relative(root_).string() + " names " + name);
  }

  fs::path root_ = test::sourceFolder();
  std::vector<fs::path> files_ = filesOf(root_);
  std::vector<std::string> wrong_;
};

TEST_F(Documentation, LinksLeadSomewhere) {
  static const std::regex link("\\]\\(([^)#:]*)(#[^)]*)?\\)");
  for (const fs::path& file : files_) {
    if (file.extension() != ".md") continue;
    const std::string text = readText(file);
    for (const std::smatch& match : matchesOf(text, link)) {
      const fs::path target = match[1].length() == 0 ? file : file.parent_path() / match[1].str();
      if (!fs::exists(target) || (match[2].matched && !headingsOf(target).contains(match[2])))
        wrong(file, match.str());
    }
  }
  EXPECT_THAT(wrong_, IsEmpty());
}

TEST_F(Documentation, PathsExist) {
  static const std::regex path(
      "(^|[^\\w./-])((core|shaders|chunks|scenegraph|materials|loaders|fitter|programs|samples|tests|"
      "scripts|cmake|docs)/[\\w./-]*\\w)");
  for (const fs::path& file : files_) {
    if (file.extension() != ".md") continue;
    const std::string text = readText(file);
    for (const std::smatch& match : matchesOf(text, path))
      if (!fs::exists(root_ / match[2].str())) wrong(file, match[2]);
  }
  EXPECT_THAT(wrong_, IsEmpty());
}

TEST_F(Documentation, FilesAndHeadingsThatCommentsNameExist) {
  static const std::regex comment("//[^\\n]*");
  static const std::regex named(
      "\\b([A-Z]\\w+\\.(?:h|cpp)|[a-z_]{2,}\\.(?:glsl|frag|vert)|[a-z-]{2,}\\.md)\\b(, \"([^\"]+)\")?");
  std::set<std::string> names{"model.glsl"};  // an alias
  for (const fs::path& file : files_) names.insert(file.filename().string());
  for (const fs::path& file : files_) {
    if (file.extension() == ".md" || file.filename() == "DocumentationTest.cpp") continue;
    const std::string text = readText(file);
    for (const std::smatch& line : matchesOf(text, comment)) {
      const std::string words = line.str();
      for (const std::smatch& match : matchesOf(words, named))
        if (!names.contains(match[1]) ||
            (match[3].matched && !headingsOf(root_ / "docs" / match[1].str()).contains(match[3])))
          wrong(file, match.str());
    }
  }
  EXPECT_THAT(wrong_, IsEmpty());
}

TEST_F(Documentation, ProgramsExist) {
  static const std::regex program("`(weft-[a-z]+)");
  std::set<std::string> names{"weft-something"};
  for (const fs::path& file : files_) names.insert(file.stem().string());
  for (const fs::path& file : files_) {
    if (file.extension() != ".md") continue;
    const std::string text = readText(file);
    for (const std::smatch& match : matchesOf(text, program))
      if (!names.contains(match[1])) wrong(file, match[1]);
  }
  EXPECT_THAT(wrong_, IsEmpty());
}

}  // namespace
}  // namespace weft
