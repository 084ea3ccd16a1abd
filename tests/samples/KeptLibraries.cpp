#ifdef WEFT_SANITIZE

#include <dlfcn.h>

// Instead of the C library's: GLX unloads Mesa's driver with its last context, and the driver's own
// globals with it, so that LeakSanitizer finds what these pointed at and cannot say whose it was.
extern "C" int dlclose(void*) noexcept {
  return 0;
}

#endif
