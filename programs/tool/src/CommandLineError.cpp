#include "CommandLineError.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <cstdlib>

#include "Suggestion.h"

namespace weft {
namespace {

using Words = std::vector<std::string>;

Words optionNames(CLI::App& app) {
  Words names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    for (const std::string& name : option->get_snames()) names.push_back("-" + name);
  }
  return names;
}

std::optional<std::string> unknownOption(CLI::App& app) {
  for (const std::string& word : app.remaining()) {
    if (!word.starts_with('-')) continue;
    const std::string name = word.substr(0, word.find('='));
    return fmt::format("there is no option {}{}", name, didYouMean(name, optionNames(app)));
  }
  return std::nullopt;
}

/// "{a,b}" as its words; none where it is something else.
Words wordsOfSet(const std::string& description) {
  if (!description.starts_with('{') || !description.ends_with('}')) return {};
  return CLI::detail::split(description.substr(1, description.size() - 2), ',');
}

/// "FLOAT in [0 - 1]" for people.
std::string rangeText(const std::string& description) {
  if (description == "POSITIVE") return "a number above 0";
  const std::size_t from = description.find(" in ["), to = description.find(" - ");
  if (from == std::string::npos || to == std::string::npos || !description.ends_with(']')) return {};
  return fmt::format("{} from {} to {}", description.starts_with("FLOAT") ? "a number" : "a whole number",
                     description.substr(from + 5, to - from - 5),
                     description.substr(to + 3, description.size() - to - 4));
}

/// What an option takes, in the words of one of its checks; empty where those are unknown.
std::string takes(const std::string& check) {
  const Words words = wordsOfSet(check);
  return words.empty() ? rangeText(check) : fmt::format("one of {}", fmt::join(words, ", "));
}

std::vector<const CLI::Validator*> validatorsOf(CLI::Option& option) {
  std::vector<const CLI::Validator*> validators;
  try {
    for (int i = 0;; ++i) validators.push_back(option.get_validator(i));
  } catch (const CLI::OptionNotFound&) {  // how CLI11 tells their number
    return validators;
  }
}

bool passes(const CLI::Validator& validator, const std::string& value) {
  try {
    return validator(value).empty();
  } catch (const CLI::ValidationError&) {
    return false;
  }
}

/// The value that a check of some option did not let pass.
std::optional<std::string> refusedValue(CLI::App& app) {
  for (CLI::Option* option : app.get_options())
    for (const CLI::Validator* validator : validatorsOf(*option))
      for (const std::string& value : option->results()) {
        const std::string check = validator->get_description(), wanted = takes(check);
        if (wanted.empty() || passes(*validator, value)) continue;
        return fmt::format("{} takes {}, not \"{}\"{}", option->get_name(), wanted, value,
                           didYouMean(value, wordsOfSet(check)));
      }
  return std::nullopt;
}

bool isNumber(const std::string& text) {
  char* end = nullptr;
  std::strtod(text.c_str(), &end);
  return !text.empty() && *end == '\0';
}

bool takesFloats(const CLI::Option& option) {
  return option.get_type_name().starts_with("FLOAT");
}

/// The first word among the values of numeric options that is no number of their kind.
std::optional<std::string> notConverted(CLI::App& app, const std::string& message) {
  for (const CLI::Option* option : app.get_options()) {
    if (message.find(": " + option->get_name() + " = ") == std::string::npos) continue;
    const bool floats = takesFloats(*option);
    for (const std::string& value : option->results())
      if (!isNumber(value) || (!floats && value.find_first_of(".eE") != std::string::npos))
        return fmt::format("{} takes {}, not \"{}\"", option->get_name(),
                           floats ? "numbers" : "whole numbers", value);
  }
  return std::nullopt;
}

}  // namespace

std::string explain(CLI::App& app, const CLI::ParseError& error) {
  // whatever else is missing follows from it
  if (const auto text = unknownOption(app)) return *text;
  if (dynamic_cast<const CLI::ValidationError*>(&error))
    if (const auto text = refusedValue(app)) return *text;
  if (dynamic_cast<const CLI::ConversionError*>(&error))
    if (const auto text = notConverted(app, error.what())) return *text;
  return error.what();
}

std::optional<std::string> findNotANumber(CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    for (const std::string& value : option->results())
      if (takesFloats(*option) && std::isnan(std::strtod(value.c_str(), nullptr)))
        return fmt::format("{} takes numbers, not \"{}\"", option->get_name(), value);
  return std::nullopt;
}

}  // namespace weft
