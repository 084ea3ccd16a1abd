#include "weft/shaders/ShaderSource.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <set>
#include <sstream>

#include "weft/shaders/EmbeddedShaders.h"

namespace weft {

namespace {

/// Follows the includes of one stage. Without `#line`: Mesa loses the file number of most errors.
class Assembler {
 public:
  explicit Assembler(const ShaderSource& source) : source_(source) {}

  Result<void> add(const std::string& file, const std::string& includedFrom) {
    if (!added_.insert(file).second) return {};
    WEFT_TRY(const std::string text, load(file, includedFrom));
    std::istringstream lines(text);
    std::string line;
    for (int number = 1; std::getline(lines, line); ++number)
      WEFT_TRY_VOID(addLine(line, fmt::format("{}:{}", file, number)));
    return {};
  }

  ShaderText take() { return std::move(result_); }

 private:
  Result<std::string> load(const std::string& file, const std::string& includedFrom) const {
    if (const auto given = source_.texts.find(file); given != source_.texts.end()) return given->second;
    if (!source_.overrideFolder.empty()) {
      std::ifstream stream(source_.overrideFolder / file, std::ios::binary);
      std::ostringstream text;
      if (stream && text << stream.rdbuf()) return text.str();
    }
    for (const EmbeddedShader& shader : embeddedShaders())
      if (shader.name == file) return std::string(shader.text);
    return fail(fmt::format("there is no shader file \"{}\"", file), includedFrom);
  }

  Result<void> addLine(const std::string& line, const std::string& place) {
    const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
    const std::string_view code = std::string_view(line).substr(start);
    if (code.starts_with("#include")) return include(code, place);
    append(line, place);
    if (code.starts_with("#version"))
      for (const auto& [name, value] : source_.defines)
        append(fmt::format("#define {} {}", name, value), "the define " + name);
    return {};
  }

  Result<void> include(std::string_view code, const std::string& place) {
    const std::size_t open = code.find('"');
    const std::size_t close = code.rfind('"');
    if (open == close) return fail("expected #include \"FILE\"", place);
    const std::string name(code.substr(open + 1, close - open - 1));
    const auto alias = source_.includeAliases.find(name);
    return add(alias == source_.includeAliases.end() ? name : alias->second, place);
  }

  void append(std::string_view line, std::string place) {
    result_.text += line;
    result_.text += '\n';
    result_.places.push_back(std::move(place));
  }

  const ShaderSource& source_;
  ShaderText result_;
  std::set<std::string> added_;
};

/// The number at the front of `text`, which is removed; false without one.
bool takeNumber(std::string_view& text, std::size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

std::string ShaderText::withPlaces(std::string_view log, std::string& firstPlace) const {
  std::string placed;
  while (!log.empty()) {
    const std::size_t length = std::min(log.find('\n'), log.size());
    std::string_view line = log.substr(0, length);
    log.remove_prefix(std::min(length + 1, log.size()));

    // Mesa writes "0:LINE(COLUMN): error", NVIDIA "0(LINE) : error", others "ERROR: 0:LINE: ".
    std::string_view rest = line.starts_with("ERROR: ") ? line.substr(7) : line;
    if (rest.starts_with("0:") || rest.starts_with("0(")) {
      const std::string_view afterNumber = rest.starts_with("0(") ? ")" : "";
      rest.remove_prefix(2);
      std::size_t number = 0;
      if (takeNumber(rest, number) && number >= 1 && number <= places.size() &&
          rest.starts_with(afterNumber)) {
        placed += places[number - 1];
        line = rest.substr(afterNumber.size());
        if (firstPlace.empty()) firstPlace = places[number - 1];
      }
    }
    placed += line;
    if (!log.empty()) placed += '\n';
  }
  return placed;
}

Result<ShaderText> assembleShader(const ShaderSource& source, const std::string& file) {
  Assembler assembler(source);
  WEFT_TRY_VOID(assembler.add(file, {}));
  return assembler.take();
}

}  // namespace weft
