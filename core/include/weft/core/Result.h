#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace weft {

/// An expected failure (input, I/O, shader, fit): what went wrong, where, and what the user can do
/// about it.
struct Error {
  std::string what;   ///< one clause, no full stop: "the image is truncated"
  std::string where;  ///< a file, with an offset, line or entry where that is known; may be empty
  std::string hint;   ///< what to do; may be empty

  /// "WHERE: WHAT (HINT)", one line for people; printable(), whatever the members quote.
  std::string message() const;
};

/// A value or an Error: the return type of everything that can fail for reasons outside the
/// program.
template <class T>
class [[nodiscard]] Result : public tl::expected<T, Error> {
 public:
  using tl::expected<T, Error>::expected;
};

/// Makes the failed side of any Result<T>.
inline tl::unexpected<Error> fail(std::string what, std::string where = {}, std::string hint = {}) {
  return tl::unexpected<Error>(Error{std::move(what), std::move(where), std::move(hint)});
}

/// Passes the failure of another Result on.
template <class T>
tl::unexpected<Error> failureOf(Result<T>&& result) {
  return tl::unexpected<Error>(std::move(result).error());
}

}  // namespace weft

/// Declares `variable` with the value of a Result, or returns its failure from the enclosing
/// function.
#define WEFT_TRY(variable, ...)                                           \
  auto WEFT_JOIN(weftResult, __LINE__) = (__VA_ARGS__);                   \
  if (!WEFT_JOIN(weftResult, __LINE__))                                   \
    return ::weft::failureOf(std::move(WEFT_JOIN(weftResult, __LINE__))); \
  variable = std::move(*WEFT_JOIN(weftResult, __LINE__))

/// The same for a Result<void>, or where the value is not wanted.
#define WEFT_TRY_VOID(...)                                                                             \
  do {                                                                                                 \
    if (auto weftResult = (__VA_ARGS__); !weftResult) return ::weft::failureOf(std::move(weftResult)); \
  } while (false)

#define WEFT_JOIN_TOKENS(a, b) a##b
#define WEFT_JOIN(a, b) WEFT_JOIN_TOKENS(a, b)
