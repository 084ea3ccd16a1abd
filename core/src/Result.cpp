#include "weft/core/Result.h"

#include "weft/core/PrintableText.h"

namespace weft {

std::string Error::message() const {
  std::string text = where.empty() ? what : where + ": " + what;
  if (!hint.empty()) text += " (" + hint + ")";
  return printable(text);  // it may quote damaged files
}

}  // namespace weft
