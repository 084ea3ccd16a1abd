#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "TestSupport.h"
#include "TextFile.h"

// Who may include whom is the table in docs/architecture.md; this test keeps the sources to it.

namespace weft {
namespace {

namespace fs = std::filesystem;
using test::readText;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

struct Library {
  fs::path folder;
  std::set<std::string> mayInclude;
};
using Libraries = std::map<std::string, Library>;

const std::set<std::string> kLibrariesWithGl{"chunks", "scenegraph", "materials", "scene_io"};

std::vector<std::string> split(const std::string& text, const std::string& separator) {
  std::vector<std::string> parts;
  const std::regex pattern("\\s*" + separator + "\\s*");
  std::copy(std::sregex_token_iterator(text.begin(), text.end(), pattern, -1), std::sregex_token_iterator(),
            std::back_inserter(parts));
  return parts;
}

// Rows are "| library | folder | holds | may include |".
Libraries librariesOf(const std::string& architecture) {
  Libraries libraries;
  std::istringstream lines(architecture);
  for (std::string line; std::getline(lines, line);) {
    const std::vector<std::string> cells = split(line, "\\|");
    if (cells.size() != 5 || cells[1] == "library" || cells[1].starts_with("---")) continue;
    Library& library = libraries[cells[1]];
    library.folder = cells[2];
    for (const std::string& other : split(cells[4], ","))
      if (other != "-") library.mayInclude.insert(other);
  }
  return libraries;
}

std::vector<fs::path> sourcesBelow(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> sourcesOf(const fs::path& root, const std::string& name, const Library& library) {
  const fs::path sources = root / library.folder / "src";
  std::vector<fs::path> files = sourcesBelow(root / library.folder / "include" / "weft" / name);
  const std::vector<fs::path> own = sourcesBelow(fs::is_directory(sources / name) ? sources / name : sources);
  files.insert(files.end(), own.begin(), own.end());
  return files;
}

std::vector<std::string> includesOf(const fs::path& file) {
  static const std::regex pattern(R"(#\s*include\s*[<"]([^>"]+)[>"])");
  const std::string text = readText(file);
  std::vector<std::string> includes;
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    includes.push_back((*match)[1]);
  return includes;
}

bool isGlHeader(const std::string& include) {
  static const std::regex pattern("(epoxy|GL|EGL|GLES[123]?|GLFW|KHR)/.*");
  return std::regex_match(include, pattern);
}

// Every line is "FILE includes HEADER".
std::vector<std::string> wrongIncludes(const fs::path& root, const Libraries& libraries) {
  static const std::regex ours("weft/([^/]+)/.*");
  std::vector<std::string> wrong;
  for (const auto& [name, library] : libraries)
    for (const fs::path& file : sourcesOf(root, name, library))
      for (const std::string& include : includesOf(file)) {
        std::smatch match;
        const bool isOurs = std::regex_match(include, match, ours);
        const bool allowed = isOurs ? match[1] == name || library.mayInclude.contains(match[1])
                                    : !isGlHeader(include) || kLibrariesWithGl.contains(name);
        if (!allowed) wrong.push_back(file.lexically_relative(root).string() + " includes " + include);
      }
  return wrong;
}

// A header that defines classes is named after one of them, or after what they are: Light.h holds
// PointLight.
std::vector<std::string> wrongHeaderNames(const fs::path& root, const Libraries& libraries) {
  static const std::regex definition(R"((?:^|\n)class (\w+)[^;{]*\{)");
  std::vector<std::string> wrong;
  for (const auto& [name, library] : libraries)
    for (const fs::path& file : sourcesBelow(root / library.folder / "include" / "weft" / name)) {
      const std::string text = readText(file);
      std::set<std::string> classes;
      for (std::sregex_iterator match(text.begin(), text.end(), definition), end; match != end; ++match)
        classes.insert((*match)[1]);
      const auto isNamed = [&](const std::string& c) { return c.find(file.stem().string()) != c.npos; };
      if (!classes.empty() && std::none_of(classes.begin(), classes.end(), isNamed))
        wrong.push_back(file.lexically_relative(root).string() + " defines class " + *classes.begin());
    }
  return wrong;
}

Libraries weftLibraries() {
  return librariesOf(readText(test::sourceFolder() / "docs" / "architecture.md"));
}

TEST(IncludeDirection, FollowsTheTable) {
  EXPECT_THAT(wrongIncludes(test::sourceFolder(), weftLibraries()), IsEmpty());
}

TEST(IncludeDirection, HeadersAreNamedAfterTheirClass) {
  EXPECT_THAT(wrongHeaderNames(test::sourceFolder(), weftLibraries()), IsEmpty());
}

TEST(IncludeDirection, TheTableNamesEveryLibrary) {
  const Libraries libraries = weftLibraries();
  std::set<std::string> documented;
  for (const auto& [name, library] : libraries) documented.insert(name);
  std::set<std::string> onDisk;
  for (const fs::path& root : {test::sourceFolder(), test::sourceFolder() / "programs"})
    for (const auto& folder : fs::directory_iterator(root))
      if (const fs::path headers = folder.path() / "include" / "weft"; fs::is_directory(headers))
        for (const auto& entry : fs::directory_iterator(headers))
          onDisk.insert(entry.path().filename().string());
  EXPECT_EQ(documented, onDisk);
  for (const auto& [name, library] : libraries)
    EXPECT_THAT(sourcesOf(test::sourceFolder(), name, library), testing::Not(IsEmpty())) << name;
}

TEST(IncludeDirection, ProgramsThatDrawNothingKnowNoGl) {
  for (const fs::path& file : sourcesBelow(test::sourceFolder() / "programs")) {
    const auto folder = file.parent_path().filename();
    if (folder == "render" || folder == "view" || folder == "info") continue;
    for (const std::string& include : includesOf(file)) {
      EXPECT_FALSE(isGlHeader(include)) << file << include;
      for (const std::string& library : kLibrariesWithGl)
        EXPECT_FALSE(include.starts_with("weft/" + library + "/")) << file << include;
    }
  }
}

// The checker itself, on a tree with one fault of every kind.
TEST(IncludeDirection, FindsWrongIncludes) {
  const fs::path root = test::testFolder();
  const auto write = [&](const fs::path& file, const std::string& text) {
    fs::create_directories((root / file).parent_path());
    std::ofstream(root / file) << text;
  };
  write("base/include/weft/base/Thing.h", "#pragma once\n#include <vector>\nclass Thing {\n};\n");
  write("base/src/Thing.cpp", "#include \"weft/base/Thing.h\"\n#include \"weft/upper/Window.h\"\n");
  write("pair/include/weft/lower/A.h", "#include \"weft/base/Thing.h\"\nclass B : Thing {\n};\nclass C;\n");
  write("pair/src/lower/A.cpp", "  #  include <weft/upper/Window.h>\n#include \"epoxy/gl.h\"\n");
  write("pair/src/upper/Window.cpp",
        "#include \"weft/lower/A.h\"\n#include <GL/gl.h>\n#include \"weft/none/X.h\"\n");
  const Libraries libraries = librariesOf(
      "| library | folder | holds | may include |\n| --- | --- | --- | --- |\n"
      "| base | base | things, of all kinds | - |\n| lower | pair | a | base |\n| upper | pair | w | base, "
      "lower |\n"
      "\n| another | table |\n");
  ASSERT_EQ(libraries.size(), 3u);
  EXPECT_THAT(
      wrongIncludes(root, libraries),
      ElementsAre("base/src/Thing.cpp includes weft/upper/Window.h",
                  "pair/src/lower/A.cpp includes weft/upper/Window.h",
                  "pair/src/lower/A.cpp includes epoxy/gl.h", "pair/src/upper/Window.cpp includes GL/gl.h",
                  "pair/src/upper/Window.cpp includes weft/none/X.h"));
  EXPECT_THAT(wrongHeaderNames(root, libraries), ElementsAre("pair/include/weft/lower/A.h defines class B"));
}

}  // namespace
}  // namespace weft
