#include "weft/chunks/ShaderSource.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>

#include "weft/shaders/EmbeddedShaders.h"

namespace weft {

namespace {

/// Follows the includes of one stage.
class Assembler {
 public:
  explicit Assembler(const ShaderSource& source) : source_(source) {}

  Result<void> add(const std::string& file, const std::string& includedFrom) {
    if (std::find(result_.files.begin(), result_.files.end(), file) != result_.files.end()) return {};
    WEFT_TRY(const std::string text, load(file, includedFrom));
    const std::size_t number = result_.files.size();
    result_.files.push_back(file);
    if (number > 0) append(fmt::format("#line 1 {}", number));

    std::istringstream lines(text);
    std::string line;
    for (int lineNumber = 1; std::getline(lines, line); ++lineNumber)
      WEFT_TRY_VOID(addLine(line, lineNumber, number));
    return {};
  }

  ShaderText take() { return std::move(result_); }

 private:
  Result<std::string> load(const std::string& file, const std::string& includedFrom) const {
    if (!source_.overrideFolder.empty()) {
      std::ifstream stream(source_.overrideFolder / file, std::ios::binary);
      std::ostringstream text;
      if (stream && text << stream.rdbuf()) return text.str();
    }
    for (const EmbeddedShader& shader : embeddedShaders())
      if (shader.name == file) return std::string(shader.text);
    return fail(fmt::format("there is no shader file \"{}\"", file), includedFrom);
  }

  Result<void> addLine(const std::string& line, int lineNumber, std::size_t fileNumber) {
    const std::string resume = fmt::format("#line {} {}", lineNumber + 1, fileNumber);
    const std::size_t start = std::min(line.find_first_not_of(" \t"), line.size());
    const std::string_view code = std::string_view(line).substr(start);
    if (code.starts_with("#include")) {
      const std::string place = fmt::format("{}:{}", result_.files[fileNumber], lineNumber);
      const std::size_t open = code.find('"');
      const std::size_t close = code.rfind('"');
      if (open == close) return fail("expected #include \"FILE\"", place);
      const std::string name(code.substr(open + 1, close - open - 1));
      const auto alias = source_.includeAliases.find(name);
      WEFT_TRY_VOID(add(alias == source_.includeAliases.end() ? name : alias->second, place));
      append(resume);
      return {};
    }
    append(line);
    if (code.starts_with("#version")) {
      for (const auto& [name, value] : source_.defines) append(fmt::format("#define {} {}", name, value));
      append(resume);
    }
    return {};
  }

  void append(std::string_view line) {
    result_.text += line;
    result_.text += '\n';
  }

  const ShaderSource& source_;
  ShaderText result_;
};

/// The number at the front of `text`, which is removed; false without one.
bool takeNumber(std::string_view& text, std::size_t& number) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return false;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

}  // namespace

std::string ShaderText::withFileNames(std::string_view log, std::string& firstPlace) const {
  std::string named;
  while (!log.empty()) {
    const std::size_t length = std::min(log.find('\n'), log.size());
    std::string_view line = log.substr(0, length);
    log.remove_prefix(std::min(length + 1, log.size()));

    // Mesa and NVIDIA write "STRING:LINE(COLUMN): error" and "STRING(LINE) : error", others "ERROR:
    // STRING:LINE: ".
    if (line.starts_with("ERROR: ")) line.remove_prefix(7);
    std::string_view rest = line;
    std::size_t file = 0, lineNumber = 0;
    if (takeNumber(rest, file) && file < files.size() && (rest.starts_with(':') || rest.starts_with('('))) {
      const std::string_view afterFile = rest;
      rest.remove_prefix(1);
      if (takeNumber(rest, lineNumber) && firstPlace.empty())
        firstPlace = fmt::format("{}:{}", files[file], lineNumber);
      named += files[file];
      line = afterFile;
    }
    named += line;
    if (!log.empty()) named += '\n';
  }
  return named;
}

Result<ShaderText> assembleShader(const ShaderSource& source, const std::string& file) {
  Assembler assembler(source);
  WEFT_TRY_VOID(assembler.add(file, {}));
  return assembler.take();
}

}  // namespace weft
