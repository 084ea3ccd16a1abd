#pragma once

#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "weft/core/Result.h"

namespace weft {

/// A value of an option: a whole number, or one of the words that there are to choose from.
using OptionValue = std::variant<int, std::string>;

/// "2" or "per-view", for people.
std::string textOf(const OptionValue& value);

/// An option that a type of model declares. Manifests, command lines, labels and the fingerprints
/// of fits walk the declarations; nothing else knows which options there are.
struct ModelOption {
  struct Word {
    std::string word;
    std::string label;  ///< what ModelOptions::label() says where it is chosen; empty: nothing
  };

  std::string name;      ///< letters, digits and '_': "rho_d", which is --rho-d on command lines
  std::string help;      ///< what it sets
  OptionValue standard;  ///< what it is where nobody says
  int smallest = 0;      ///< of a whole number
  int largest = 0;
  std::vector<Word> words{};  ///< of a word; the first is the standard

  static ModelOption number(std::string name, std::string help, int standard, int smallest, int largest);
  static ModelOption choice(std::string name, std::string help, std::vector<Word> words);
  /// `color`: whether the numbers describe luminance, which the texel's base colour turns into RGB,
  /// or each colour channel by itself, as multiples of the base colour. ReflectanceModel knows it.
  static ModelOption color();

  /// The values that it may have: "1 to 4", "shared, per-view".
  std::string range() const;
  bool accepts(const OptionValue& value) const;
  /// The value that a text means, which accepts() may refuse: a text that is no number remains one.
  OptionValue valueFrom(const std::string& text) const;
};

/// What a file or a command line says of a model; ModelRegistry makes the model from it.
struct ModelDescription {
  std::string name = "rfnl";
  /// by name; those that are left out have their standard
  std::map<std::string, OptionValue> options{};

  bool operator==(const ModelDescription&) const = default;
};

/// The options of one model, declared ones only, each with a value in its range: what models are
/// made from.
class ModelOptions {
 public:
  /// Fails on an option that is not declared, naming those that are, and on a value out of range.
  static Result<ModelOptions> create(const ModelDescription& description,
                                     std::span<const ModelOption> declared);

  /// The model's name, and every declared option.
  const ModelDescription& description() const { return description_; }
  bool has(const std::string& option) const { return description_.options.contains(option); }
  /// The value of a declared option of that kind.
  int number(const std::string& option) const;
  const std::string& word(const std::string& option) const;
  /// For people: "rfnl, 2 lobes, rho_d per view".
  const std::string& label() const { return label_; }

 private:
  ModelDescription description_;
  std::string label_;
};

}  // namespace weft
