#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "weft/fitter/FieldFitter.h"
#include "weft/fitter/TexelFitter.h"

namespace weft {

/// Makes fitters by model name; the counterpart of ModelRegistry.
class FitterRegistry {
 public:
  using Factory = Result<std::unique_ptr<FieldFitter>> (*)(const FitProblem&);
  using TexelFactory = Result<std::unique_ptr<TexelFitter>> (*)(const FitProblem&);

  static FitterRegistry builtin();
  void add(std::string model, Factory factory);
  /// The same for a model whose texels share nothing.
  void add(std::string model, TexelFactory factory);
  std::vector<std::string> names() const;
  /// Fails on an unknown model and on measurements that do not determine its numbers.
  Result<std::unique_ptr<FieldFitter>> create(const FitProblem& problem) const;

 private:
  using AnyFactory = std::function<Result<std::unique_ptr<FieldFitter>>(const FitProblem&)>;
  std::vector<std::pair<std::string, AnyFactory>> factories_;
};

}  // namespace weft
