#include "weft/io/FileName.h"

#include <utf8proc.h>

#include <cstdlib>
#include <memory>

namespace weft {
namespace {

struct Free {
  void operator()(utf8proc_uint8_t* memory) const { std::free(memory); }
};

std::string mapped(std::string_view name, int options) {
  utf8proc_uint8_t* memory = nullptr;
  const utf8proc_ssize_t size = utf8proc_map(
      reinterpret_cast<const utf8proc_uint8_t*>(name.data()), static_cast<utf8proc_ssize_t>(name.size()),
      &memory, static_cast<utf8proc_option_t>(UTF8PROC_STABLE | UTF8PROC_COMPOSE | options));
  const std::unique_ptr<utf8proc_uint8_t, Free> result(memory);
  if (size < 0) return std::string(name);
  return std::string(reinterpret_cast<const char*>(result.get()), static_cast<std::size_t>(size));
}

}  // namespace

std::string composedName(std::string_view name) {
  return mapped(name, 0);
}

std::string foldedName(std::string_view name) {
  return mapped(name, UTF8PROC_CASEFOLD);
}

}  // namespace weft
