#include "weft/reflectance/ModelOptions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>

#include "weft/core/Contract.h"

namespace weft {
namespace {

// What a label says of a value: "1 lobe", "2 lobes", a word's own label.
std::string labelOf(const ModelOption& option, const OptionValue& value) {
  if (const int* number = std::get_if<int>(&value)) {
    const bool single = *number == 1 && option.name.ends_with('s');
    return fmt::format("{} {}", *number, option.name.substr(0, option.name.size() - (single ? 1 : 0)));
  }
  return std::ranges::find(option.words, std::get<std::string>(value), &ModelOption::Word::word)->label;
}

Result<void> checkDeclared(const ModelDescription& description, std::span<const ModelOption> declared) {
  for (const auto& [name, value] : description.options) {
    if (std::ranges::find(declared, name, &ModelOption::name) != declared.end()) continue;
    std::vector<std::string> names;
    for (const ModelOption& option : declared) names.push_back(option.name);
    return fail(
        fmt::format("the model '{}' has no option '{}'", description.name, name), {},
        names.empty() ? "it has no options" : fmt::format("its options are {}", fmt::join(names, ", ")));
  }
  return {};
}

}  // namespace

std::string textOf(const OptionValue& value) {
  const int* number = std::get_if<int>(&value);
  return number ? std::to_string(*number) : std::get<std::string>(value);
}

ModelOption ModelOption::number(std::string name, std::string help, int standard, int smallest, int largest) {
  return {std::move(name), std::move(help), standard, smallest, largest};
}

ModelOption ModelOption::choice(std::string name, std::string help, std::vector<Word> words) {
  WEFT_EXPECT(!words.empty(), "an option has words to choose from");
  OptionValue standard = words.front().word;
  return {std::move(name), std::move(help), std::move(standard), 0, 0, std::move(words)};
}

ModelOption ModelOption::color() {
  return choice("color",
                "fit luminance, which a base colour a texel turns into RGB, or each colour channel (three "
                "times the numbers)",
                {{"luminance", ""}, {"rgb", "RGB"}});
}

std::string ModelOption::range() const {
  if (words.empty()) return fmt::format("{} to {}", smallest, largest);
  std::vector<std::string> names;
  for (const Word& word : words) names.push_back(word.word);
  return fmt::format("{}", fmt::join(names, ", "));
}

bool ModelOption::accepts(const OptionValue& value) const {
  const int* number = std::get_if<int>(&value);
  if (words.empty()) return number && *number >= smallest && *number <= largest;
  return !number && std::ranges::find(words, std::get<std::string>(value), &Word::word) != words.end();
}

OptionValue ModelOption::valueFrom(const std::string& text) const {
  int number = 0;
  const char* end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (words.empty() && parsed.ec == std::errc() && parsed.ptr == end) return number;
  return text;
}

Result<ModelOptions> ModelOptions::create(const ModelDescription& description,
                                          std::span<const ModelOption> declared) {
  WEFT_TRY_VOID(checkDeclared(description, declared));
  ModelOptions options;
  options.description_.name = options.label_ = description.name;
  for (const ModelOption& option : declared) {
    const auto given = description.options.find(option.name);
    const OptionValue& value = given == description.options.end() ? option.standard : given->second;
    if (!option.accepts(value))
      return fail(
          fmt::format("'{}' of the model '{}' cannot be {}", option.name, description.name, textOf(value)),
          {}, option.range());
    options.description_.options[option.name] = value;
    if (const std::string label = labelOf(option, value); !label.empty()) options.label_ += ", " + label;
  }
  return options;
}

int ModelOptions::number(const std::string& option) const {
  const auto found = description_.options.find(option);
  WEFT_EXPECT(found != description_.options.end() && std::holds_alternative<int>(found->second),
              "the model declares this number");
  return std::get<int>(found->second);
}

const std::string& ModelOptions::word(const std::string& option) const {
  const auto found = description_.options.find(option);
  WEFT_EXPECT(found != description_.options.end() && std::holds_alternative<std::string>(found->second),
              "the model declares this choice");
  return std::get<std::string>(found->second);
}

}  // namespace weft
